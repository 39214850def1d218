// SPDX-License-Identifier: LGPL-2.1-or-later

// The module libmtstereo-images.so: all that is linked with OpenCV's library of image formats.

#include "lib/images/module.hpp"

#include <opencv2/imgcodecs.hpp>

extern "C" {
__attribute__((visibility("default"))) extern const mtstereo::images::Codecs mtstereo_image_codecs;

const mtstereo::images::Codecs mtstereo_image_codecs{cv::imread, cv::imdecode, cv::imencode};
}
