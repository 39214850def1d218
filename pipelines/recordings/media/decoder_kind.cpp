// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/decoder_kind.hpp"

#include <string_view>

namespace mtstereo::run {

namespace {

std::string_view name_of_kind(GstElement* element) {
  const GstElementFactory* factory = gst_element_get_factory(element);
  return factory != nullptr ? GST_OBJECT_NAME(factory) : "";
}

}  // namespace

bool is_video_decoder(GstElement* element) {
  constexpr GstElementFactoryListType kMedia =
      GST_ELEMENT_FACTORY_TYPE_MEDIA_VIDEO | GST_ELEMENT_FACTORY_TYPE_MEDIA_IMAGE;
  GstElementFactory* factory = gst_element_get_factory(element);
  return factory != nullptr && gst_element_factory_list_is_type(
                                   factory, GST_ELEMENT_FACTORY_TYPE_DECODER | kMedia) != FALSE;
}

bool is_libav_decoder(GstElement* element) { return name_of_kind(element).starts_with("avdec_"); }

bool is_jpeg_decoder(GstElement* element) { return name_of_kind(element) == "jpegdec"; }

}  // namespace mtstereo::run
