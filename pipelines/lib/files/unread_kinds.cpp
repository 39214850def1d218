// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/unread_kinds.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "lib/files/file_names.hpp"
#include "lib/files/tiff_pages.hpp"
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

// Why a TIFF file is not read; "" if it is, and for another file.
std::string tiff_problem(const fs::path& file) {
  const std::vector<TiffPage> pages = first_tiff_pages(file);
  if (pages.empty()) return {};
  const TiffPage& first = pages.front();
  if (first.orientation > 1 && first.orientation <= 8) {
    return "is turned or mirrored when it is shown, as its orientation tag states: store the "
           "images of both views turned (mogrify -auto-orient FILES)";
  }
  // A second image of another size is a preview.
  const bool equal = pages.size() > 1 && pages[1].width == first.width &&
                     pages[1].height == first.height && first.width > 0;
  return equal ? "has several images, of which only the first is read: write each one to a file "
                 "(magick FILE view-%06d.png)"
               : "";
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
  if (std::string problem = tiff_problem(file); !problem.empty()) return problem;
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
