// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/frame_index.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/images/images.hpp"
#include "lib/media/decoding_problem.hpp"
#include "lib/median.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/damage_notes.hpp"
#include "recordings/media/video_times.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

Nanoseconds median_period(const std::vector<Nanoseconds>& times) {
  std::vector<Nanoseconds> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return median(std::move(steps));
}

// What is missing, by the container, by the demultiplexer, and by the decoder.
std::string missing_of(const fs::path& file, const VideoTimes& coded, const VideoTimes& shown,
                       bool by_order) {
  const Nanoseconds end = shown.times.back() + median_period(shown.times);
  const std::string where = " after " + seconds_text(end);
  if (const std::string reason = missing_end(file); !reason.empty()) {
    return "the file is truncated" + where + ": " + reason;
  }
  if (!shown.error.empty()) return "the file is damaged" + where + ": " + shown.error;
  if (!coded.error.empty()) return "the file is damaged" + where + ": " + coded.error;
  if (!has_plain_codec(coded)) return "";
  if (by_order) {
    if (coded.frames <= shown.frames) return "";
    return std::to_string(coded.frames - shown.frames) + " of " + std::to_string(coded.frames) +
           " frames cannot be decoded";
  }
  // Frames that have other times than the file states are not lost.
  const auto leading =
      std::lower_bound(coded.times.begin(), coded.times.end(), shown.times.front());
  const auto before = static_cast<std::size_t>(leading - coded.times.begin());
  if (shown.frames + before >= coded.frames) return "";
  std::vector<Nanoseconds> lost;
  std::set_difference(coded.times.begin(), coded.times.end(), shown.times.begin(),
                      shown.times.end(), std::back_inserter(lost));
  // Frames before the first keyframe are not damage: they need frames before the recording.
  std::erase_if(lost, [&](Nanoseconds time) { return time < shown.times.front(); });
  if (lost.empty()) return "";
  return std::to_string(lost.size()) + " of " + std::to_string(coded.times.size()) +
         " frames cannot be decoded, the first of them at " + seconds_text(lost.front());
}

// All that is known before the frames of the pairs are decoded.
std::string damage_of(const fs::path& file, const VideoTimes& coded, const VideoTimes& shown,
                      bool by_order) {
  std::string damage = missing_of(file, coded, shown, by_order);
  add_damage(damage, damaged_parts(file));
  return damage;
}

// Frames before the first keyframe need frames before the recording: the decoder shows remains of
// them, some with wrong times.
void remove_start_without_keyframe(VideoTimes& shown, const VideoTimes& coded) {
  if (coded.starts_with_keyframe || coded.keyframes.empty()) return;
  std::erase_if(shown.times, [&coded](Nanoseconds time) { return time < coded.keyframes.front(); });
}

bool is_increasing(const std::vector<Nanoseconds>& times) {
  return std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

// AVI and MPEG-PS state the times of some frames only, and a truncated AVI file does not state
// which ones are keyframes.
bool lacks_times(const fs::path& file, const VideoTimes& coded) {
  constexpr std::size_t kStated = 10;  // a file that states them may lack one of so many by damage
  return coded.untimed * kStated >= coded.frames || (is_avi(file) && !has_intra_codec(coded));
}

// Decoders guess the times that a file does not state, some of them equal. The frames are shown at
// the distances at which they are decoded. False if the file does not state these times either.
bool set_times_of_decoding(VideoTimes& shown, const VideoTimes& coded) {
  const std::vector<Nanoseconds>& times = coded.decoding_times;
  if (times.size() != coded.frames || shown.frames > times.size()) return false;
  if (shown.times.empty() || !is_increasing(times)) return false;
  const Nanoseconds delay = shown.times.front() - times.front();
  shown.times.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(shown.frames));
  for (Nanoseconds& time : shown.times) time += delay;
  return true;
}

void add_remarks(FrameIndex& index, const fs::path& file, const VideoTimes& coded) {
  if (coded.video_streams > 1) {
    index.remarks.push_back("The file has " + std::to_string(coded.video_streams) +
                            " streams with video: the first one, " + std::to_string(index.width) +
                            "x" + std::to_string(index.height) + " px, is used.");
  }
  if (index.damage.empty() && may_lack_end(file)) {
    index.remarks.emplace_back(
        "The file may be truncated within its last frame: the format does not state where the "
        "frame ends.");
  }
}

FrameIndex index_of_video(const fs::path& file) {
  const VideoTimes coded = read_times(file, Reading::kCoded);
  if (coded.times.empty()) {
    const std::string missing = missing_end(file);
    std::string reason = coded.error.empty() ? "it has no frame" : coded.error;
    if (!missing.empty()) reason += " (" + missing + ")";
    throw UserError(file.string() + ": the video cannot be read: " + reason);
  }
  VideoTimes shown = parser_suffices(file, coded) ? coded : read_times(file, Reading::kDecoded);
  FrameIndex index;
  index.by_order = lacks_times(file, coded) && set_times_of_decoding(shown, coded);
  if (!index.by_order) remove_start_without_keyframe(shown, coded);
  if (shown.times.empty()) {
    throw UserError(file.string() + ": no frame can be decoded: " +
                    (shown.error.empty() ? "its data is damaged" : shown.error));
  }
  index.width = shown.format.width;
  index.height = shown.format.height;
  index.codec = coded.format.codec;
  index.damage = damage_of(file, coded, shown, index.by_order);
  index.times = shown.times;
  add_remarks(index, file, coded);
  index.period = median_period(index.times);
  return index;
}

std::string name_of_format(const fs::path& image) {
  std::string name = files::extension_of(image);
  if (!name.empty()) name.erase(0, 1);
  for (char& each : name) each = static_cast<char>(std::toupper(static_cast<unsigned char>(each)));
  return name == "JPG" ? "JPEG" : name;
}

FrameIndex index_of_images(const Source& source, double frame_rate) {
  FrameIndex index;
  const cv::Mat first = images::read(source.images.front(), cv::IMREAD_UNCHANGED);
  if (first.empty()) throw UserError(media::unreadable_image(source.images.front()));
  index.width = first.cols;
  index.height = first.rows;
  index.codec = name_of_format(source.images.front());
  index.times = source.times;
  index.damage = source.damage;
  if (index.times.empty()) {
    if (!(frame_rate > 0)) {
      throw UserError(source.images.front().parent_path().string() +
                      ": images without times need a frame rate above 0");
    }
    for (std::size_t i = 0; i < source.images.size(); ++i) {
      index.times.push_back(std::llround(static_cast<double>(i) * kSecond / frame_rate));
    }
    if (index.times.size() == 1) index.period = std::llround(kSecond / frame_rate);
  }
  if (index.times.size() > 1) index.period = median_period(index.times);
  return index;
}

std::uintmax_t bytes_of(const Source& source) {
  std::uintmax_t sum = 0;
  std::vector<fs::path> files = source.images;
  if (!source.video.empty()) files.push_back(source.video);
  for (const fs::path& file : files) {
    std::error_code missing;
    const std::uintmax_t size = fs::file_size(file, missing);
    if (!missing) sum += size;
  }
  return sum;
}

}  // namespace

FrameIndex index_frames(const Source& source, double frame_rate) {
  if (source.empty()) throw UserError("there is no source");
  FrameIndex index =
      source.video.empty() ? index_of_images(source, frame_rate) : index_of_video(source.video);
  index.bytes = bytes_of(source);
  return index;
}

}  // namespace mtstereo::run
