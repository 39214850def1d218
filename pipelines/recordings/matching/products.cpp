// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/products.hpp"

#include <algorithm>

namespace mtstereo::run {

const char* product_name(Product product) {
  switch (product) {
    case Product::kDisparity:
      return "disparity";
    case Product::kDepth:
      return "depth";
    case Product::kColor:
      return "color";
    case Product::kConfidence:
      return "confidence";
    case Product::kRectifiedLeft:
      return "rectified-left";
    case Product::kRectifiedRight:
      return "rectified-right";
    case Product::kCloud:
      break;
  }
  return "cloud";
}

bool makes(const WorkOptions& options, Product product) {
  return std::find(options.products.begin(), options.products.end(), product) !=
         options.products.end();
}

}  // namespace mtstereo::run
