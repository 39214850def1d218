// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace mtstereo::run {

/// A file of which parts are read.
class Bytes {
 public:
  explicit Bytes(const std::filesystem::path& file);

  std::uint64_t size() const { return size_; }
  /// Exactly so many bytes; empty if there are not so many.
  std::string at(std::uint64_t position, std::size_t count);
  /// So many bytes, or those up to the end of the file.
  std::string up_to(std::uint64_t position, std::size_t count);

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

std::uint64_t big_endian(std::string_view bytes);
std::uint64_t little_endian(std::string_view bytes);

/// Whether a part that starts at `start`, and states that it has `length` bytes, does not fit into
/// a file of `size` bytes.
bool exceeds(std::uint64_t start, std::uint64_t length, std::uint64_t size);
/// "9 bytes of PART are missing".
std::string lacks(std::uint64_t bytes, const std::string& part);

/// Places in a file where its container is damaged.
struct DamagedParts {
  std::int64_t count = 0;
  std::uint64_t first = 0;  ///< the position of the first one
  std::string reason;       ///< of the first one

  void add(std::uint64_t position, const std::string& why);
  /// A clause; empty without such a place.
  std::string text() const;
};

}  // namespace mtstereo::run
