// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/media/decoding_problem.hpp"

#include <string>
#include <string_view>

#include "mtstereo/parameters.hpp"

namespace mtstereo::media {
namespace {

constexpr const char* kUnknownPixels =
    "its data is damaged, or GStreamer has no format for its pixels, such as gray of 10 or 12 "
    "bits: convert it (ffmpeg -i FILE -pix_fmt gray16le -c:v ffv1 view.mkv)";

// Also a file that has sound only: decodebin misses a plugin, without a name.
bool is_unknown_format(const GError& error) {
  if (error.domain == GST_CORE_ERROR) return error.code == GST_CORE_ERROR_MISSING_PLUGIN;
  return error.domain == GST_STREAM_ERROR && (error.code == GST_STREAM_ERROR_TYPE_NOT_FOUND ||
                                              error.code == GST_STREAM_ERROR_WRONG_TYPE);
}

}  // namespace

std::string without_plugin(const std::string& missing) {
  return "GStreamer has no " + missing +
         ": install its plugin (pipelines/install-packages.sh has those of common formats), or "
         "convert the video (ffmpeg -i FILE -c:v ffv1 view.mkv)";
}

std::string without_frames(bool decodes) {
  return decodes ? kUnknownPixels : "no video was found in it";
}

std::string unreadable_image(const std::filesystem::path& image) {
  const std::string side = std::to_string(kLargestImageSide);
  return image.string() +
         ": the image cannot be read: give PNG, JPEG or TIFF of 8 or 16 bits and at most " + side +
         "x" + side + " px";
}

std::string decoding_problem(GstMessage* message) {
  g_autoptr(GError) error = nullptr;
  g_autofree gchar* details = nullptr;
  gst_message_parse_error(message, &error, &details);
  if (is_unknown_format(*error)) {
    return "GStreamer recognizes no video in it: give a video, an image or a folder of images, or "
           "convert it (ffmpeg -i FILE -c:v ffv1 view.mkv)";
  }
  if (details != nullptr && std::string_view(details).find("not-negotiated") != std::string::npos) {
    return kUnknownPixels;
  }
  return error->message;
}

}  // namespace mtstereo::media
