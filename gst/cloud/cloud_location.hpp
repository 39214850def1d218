// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mtstereo/geometry/point_cloud.hpp"
#include "mtstereo/result.hpp"

namespace mtstereo::plugin {

/// The names of the files of mtcloud.
class CloudLocation {
 public:
  /// `pattern`: the path, with at most one number such as %d or %05d; %% is a percent sign.
  /// `format`: std::nullopt selects it by the extension, .ply or .pcd.
  static Result<CloudLocation> parse(const std::string& pattern, std::optional<CloudFormat> format);

  /// The path of a file.
  std::string path(std::uint64_t number) const;
  /// False if all files have the same name.
  bool numbered() const { return digits_.has_value(); }
  CloudFormat format() const { return format_; }

 private:
  std::string before_;         ///< the number
  std::string after_;          ///< the number
  std::optional<int> digits_;  ///< at least so many, with leading zeros or spaces; none: no number
  char fill_ = ' ';
  CloudFormat format_ = CloudFormat::kPly;
};

/// A path as the text of a message, which must be UTF-8: if it is not, its other bytes and its
/// backslashes are written as \xff with their two hexadecimal digits.
std::string utf8_path(const std::string& path);

}  // namespace mtstereo::plugin
