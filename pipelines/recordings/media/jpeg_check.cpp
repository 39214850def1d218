// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/jpeg_check.hpp"

#include <gst/gst.h>

#include <csetjmp>
#include <cstdio>

// Needs the types of the standard library above.
#include <jerror.h>
#include <jpeglib.h>

namespace mtstereo::run {
namespace {

// The library leaves a function at an error by its handler, and does not return.
struct JpegCheck {
  jpeg_error_mgr errors{};
  jpeg_decompress_struct decoder{};
  std::jmp_buf at_error{};
  char text[JMSG_LENGTH_MAX] = {};  // of the first report
};

void take_text(j_common_ptr decoder) {
  auto* const check = static_cast<JpegCheck*>(decoder->client_data);
  if (check->text[0] == '\0') decoder->err->format_message(decoder, check->text);
}

void on_error(j_common_ptr decoder) {
  take_text(decoder);
  std::longjmp(static_cast<JpegCheck*>(decoder->client_data)->at_error, 1);
}

// Whether a warning is about the kind of the file, or about bytes that fill the end of the data, as
// some cameras write them.
bool is_harmless(const jpeg_error_mgr& errors) {
  constexpr int kMostFill = 16;  // [bytes]
  constexpr int kEnd = 0xd9;     // marker
  switch (errors.msg_code) {
    case JWRN_ADOBE_XFORM:
    case JWRN_JFIF_MAJOR:
      return true;
    case JWRN_EXTRANEOUS_DATA:
      return errors.msg_parm.i[0] <= kMostFill && errors.msg_parm.i[1] == kEnd;
    default:
      return false;
  }
}

// A level below 0 is a warning.
void on_message(j_common_ptr decoder, int level) {
  if (level < 0 && !is_harmless(*decoder->err)) take_text(decoder);
}

// Has no objects with destructors: on_error() leaves it.
void read_coefficients(JpegCheck& check, const unsigned char* bytes, unsigned long size) {
  if (setjmp(check.at_error) != 0) return;
  jpeg_create_decompress(&check.decoder);
  check.decoder.client_data = &check;
  jpeg_mem_src(&check.decoder, bytes, size);
  jpeg_read_header(&check.decoder, TRUE);
  jpeg_read_coefficients(&check.decoder);
}

}  // namespace

std::string damage_of_jpeg(std::string_view bytes) {
  JpegCheck check;
  check.decoder.err = jpeg_std_error(&check.errors);
  check.errors.error_exit = on_error;
  check.errors.emit_message = on_message;
  check.decoder.client_data = &check;
  read_coefficients(check, reinterpret_cast<const unsigned char*>(bytes.data()),
                    static_cast<unsigned long>(bytes.size()));
  jpeg_destroy_decompress(&check.decoder);
  return check.text;
}

std::string damage_of_jpeg(GstBuffer* buffer) {
  GstMapInfo map;
  if (gst_buffer_map(buffer, &map, GST_MAP_READ) == FALSE) return "";
  std::string damage =
      damage_of_jpeg(std::string_view(reinterpret_cast<const char*>(map.data), map.size));
  gst_buffer_unmap(buffer, &map);
  return damage;
}

}  // namespace mtstereo::run
