// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/unread_kinds.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/outputs/user_error.hpp"

namespace mtstereo::files {

namespace fs = std::filesystem;

namespace {

// Extensions with blanks around them, and what is wrong with their files.
struct Kind {
  std::string_view extensions;
  const char* what;
  bool recording = false;  // of both views
  bool photo = false;
};

constexpr std::array<Kind, 16> kKinds{
    {{" .heic .heif .avif ", "is a kind of image that is not read: convert it to PNG", false, true},
     {" .tga .pam .pcx .sgi .dpx .jxl ",
      "is a kind of image that is not read: convert it to PNG (ffmpeg -i FILE view.png)"},
     {" .exr .hdr ",
      "has light without an upper limit: apply the same curve to both views, and write 16-bit PNG "
      "(of EXR: ffmpeg -apply_trc iec61966_2_1 -i FILE -pix_fmt rgb48be view.png)"},
     {" .fits .fit .czi .nd2 .lif .dcm .img .vic .cub ",
      "has scientific images (FITS, PDS, microscopes), which are not read: write each view as "
      "16-bit PNG or TIFF (Fiji, gdal_translate)"},
     {" .nut ",
      "is a kind of video that stops its reader: rewrite it (ffmpeg -i FILE -c copy view.mkv)"},
     {" .m3u8 .m3u .mpd ",
      "is a list of the parts of a video: write its video to one file (ffmpeg -i FILE -c copy "
      "view.mkv)"},
     {" .cr2 .cr3 .nef .arw .raf .rw2 .orf .dng .gpr .pef .srw ",
      "is raw data of a camera: develop both views with the same settings to 16-bit PNG or TIFF",
      false, true},
     {" .mpo ",
      "has one image after the other: the left view is the first one (cp FILE left.jpg), the right "
      "one the second (exiftool -b -mpimage2 FILE > right.jpg)"},
     {" .bag .db3 .mcap ",
      "is a recording of ROS: write the images of both cameras to two folders, with their times "
      "[ns] as names, and give the folders",
      true},
     {" .svo .svo2 ",
      "is a recording of a ZED camera: export both views side by side as a video (ZED_SVO_Export)",
      true},
     {" .oni .klg ", "is a recording of a depth camera, which has no two views"},
     {" .npy .npz .h5 .hdf5 .mat .pkl .tfrecord .feather ",
      "is a file of arrays: write its views as PNG images, or as two videos"},
     {" .raw .yuv .nv12 .bayer ",
      "has frames without their size and format: convert it (ffmpeg -f rawvideo -pixel_format "
      "yuv420p -video_size 1280x720 -framerate 30 -i FILE -c:v ffv1 view.mkv)"},
     {" .zip .tar .gz .tgz .bz2 .xz .zst .7z .rar ", "is an archive: unpack it"},
     {" .pfm .flo ", "has values instead of an image, such as disparities: give the views"},
     {" .ply .pcd .las ", "has points instead of an image: give the views"}}};

const Kind* kind_of(const fs::path& file) {
  const std::string extension = " " + extension_of(file) + " ";
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& each) {
    return each.extensions.find(extension) != std::string_view::npos;
  });
  return kind == kKinds.end() ? nullptr : &*kind;
}

// A PNG file whose first chunks announce an animation.
bool is_animated_png(const fs::path& file) {
  std::string head(256, '\0');
  std::ifstream(file, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.starts_with("\x89PNG") && head.find("acTL") != std::string::npos;
}

// Whether a file begins with these bytes.
bool begins_with(const fs::path& file, std::string_view bytes) {
  std::string head(bytes.size(), '\0');
  std::ifstream(file, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == bytes;
}

// The bytes of a TIFF file as numbers.
class TiffNumbers {
 public:
  explicit TiffNumbers(const fs::path& file) : stream_(file, std::ios::binary) {
    std::string head(4, '\0');
    stream_.read(head.data(), 4);
    big_ = head == std::string_view("MM\0*", 4);
    is_tiff_ = big_ || head == std::string_view("II*\0", 4);
  }

  bool is_tiff() const { return is_tiff_; }
  void go_to(std::uint32_t place) { stream_.seekg(place); }

  std::uint32_t next(int bytes) {
    std::uint32_t number = 0;
    for (int i = 0; i < bytes; ++i) {
      const auto byte = static_cast<std::uint32_t>(static_cast<unsigned char>(stream_.get()));
      number |= byte << 8 * (big_ ? bytes - 1 - i : i);
    }
    return stream_ ? number : 0;
  }

 private:
  std::ifstream stream_;
  bool big_ = false, is_tiff_ = false;
};

// Width and height of the image of a directory, whose end has the place of the next one.
std::pair<std::uint32_t, std::uint32_t> next_tiff_size(TiffNumbers& numbers) {
  constexpr std::uint32_t kWidth = 256, kHeight = 257, kShort = 3;
  std::pair<std::uint32_t, std::uint32_t> size;
  for (std::uint32_t entries = numbers.next(2); entries > 0; --entries) {
    const std::uint32_t tag = numbers.next(2), type = numbers.next(2);
    numbers.next(4);  // how many values
    const std::uint32_t value = numbers.next(type == kShort ? 2 : 4);
    if (type == kShort) numbers.next(2);
    if (tag == kWidth) size.first = value;
    if (tag == kHeight) size.second = value;
  }
  return size;
}

// A TIFF file with two images of the same size: the second one is no preview.
bool has_pages(const fs::path& file) {
  TiffNumbers numbers(file);
  if (!numbers.is_tiff()) return false;
  numbers.go_to(numbers.next(4));
  const auto first = next_tiff_size(numbers);
  const std::uint32_t second = numbers.next(4);
  if (second == 0) return false;
  numbers.go_to(second);
  return first == next_tiff_size(numbers) && first.first > 0;
}

}  // namespace

std::string unread_kind(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  if (begins_with(file, "version https://git-lfs")) {
    return "is a pointer of Git LFS without the data: get it (git lfs pull)";
  }
  // Animations that repeat have no end.
  if (begins_with(file, "GIF8")) {
    return "is a GIF, which repeats without an end: convert it to a video or to PNG images (ffmpeg "
           "-i FILE view.mkv)";
  }
  if (is_animated_png(file)) {
    return "is an animated PNG, of which only the first image is read: convert it to a video or to "
           "PNG images (ffmpeg -i FILE view.mkv)";
  }
  if (const Kind* const kind = kind_of(file)) return kind->what;
  if (has_pages(file)) {
    return "has several images, of which only the first is read: write each one to a file (magick "
           "FILE view-%06d.png)";
  }
  if (!is_image(file) && begins_with(file, "\xff\xd8\xff")) {
    return "has JPEG images without times: state their rate (ffmpeg -framerate 30 -f mjpeg -i FILE "
           "-c copy view.mkv), or name it FILE.jpg if it is one image";
  }
  return {};
}

std::string first_unread(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const std::string kind = unread_kind(file);
    if (!kind.empty()) return file.string() + ": " + kind;
  }
  return {};
}

std::vector<fs::path> unread_recordings(std::vector<fs::path> files) {
  std::erase_if(files, [](const fs::path& file) {
    const Kind* const kind = kind_of(file);
    return kind == nullptr || !kind->recording;
  });
  return files;
}

bool is_unread_photo(const fs::path& file) {
  const Kind* const kind = kind_of(file);
  return kind != nullptr && kind->photo;
}

void refuse_unread(const fs::path& file) {
  const std::string problem = first_unread({file});
  if (!problem.empty()) throw UserError(problem);
}

}  // namespace mtstereo::files
