// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/files/tiff_pages.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace mtstereo::files {
namespace {

// The bytes of a TIFF file as numbers.
class TiffNumbers {
 public:
  explicit TiffNumbers(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
    std::string head(4, '\0');
    stream_.read(head.data(), 4);
    big_endian_ = head.starts_with("MM");
    const std::string_view kind = std::string_view(head).substr(2);
    const bool ordered = big_endian_ || head.starts_with("II");
    const auto is = [&](char number) {
      return kind == (big_endian_ ? std::string{'\0', number} : std::string{number, '\0'});
    };
    is_big_ = ordered && is('+');
    is_tiff_ = is_big_ || (ordered && is('*'));
    if (is_big_) next(4);  // the length of places
  }

  bool is_tiff() const { return is_tiff_; }
  bool good() const { return stream_.good(); }
  void go_to(std::uint64_t place) { stream_.seekg(static_cast<std::streamoff>(place)); }

  std::uint64_t next(int bytes) {
    std::uint64_t number = 0;
    for (int i = 0; i < bytes; ++i) {
      const auto byte = static_cast<std::uint64_t>(static_cast<unsigned char>(stream_.get()));
      number |= byte << 8 * (big_endian_ ? bytes - 1 - i : i);
    }
    return stream_ ? number : 0;
  }
  std::uint64_t next_place() { return next(place_bytes()); }
  std::uint64_t next_entries() { return next(is_big_ ? 8 : 2); }
  // The value of an entry, which fills the room of a place.
  std::uint64_t next_value(std::uint64_t type) {
    constexpr std::uint64_t kShort = 3, kLong = 4;
    const int bytes = type == kShort ? 2 : type == kLong ? 4 : place_bytes();
    const std::uint64_t value = next(bytes);
    next(place_bytes() - bytes);
    return value;
  }

 private:
  int place_bytes() const { return is_big_ ? 8 : 4; }

  std::ifstream stream_;
  bool big_endian_ = false, is_tiff_ = false, is_big_ = false;
};

// The image of a directory, whose end has the place of the next one.
TiffPage next_page(TiffNumbers& numbers) {
  constexpr std::uint64_t kWidth = 256, kHeight = 257, kOrientation = 274, kMostEntries = 65535;
  TiffPage page;
  std::uint64_t entries = std::min(numbers.next_entries(), kMostEntries);
  for (; entries > 0 && numbers.good(); --entries) {
    const std::uint64_t tag = numbers.next(2), type = numbers.next(2);
    numbers.next_place();  // how many values
    const std::uint64_t value = numbers.next_value(type);
    if (tag == kWidth) page.width = value;
    if (tag == kHeight) page.height = value;
    if (tag == kOrientation) page.orientation = value;
  }
  return page;
}

}  // namespace

std::vector<TiffPage> first_tiff_pages(const std::filesystem::path& file) {
  TiffNumbers numbers(file);
  if (!numbers.is_tiff()) return {};
  numbers.go_to(numbers.next_place());
  std::vector<TiffPage> pages{next_page(numbers)};
  const std::uint64_t second = numbers.next_place();
  if (second == 0) return pages;
  numbers.go_to(second);
  pages.push_back(next_page(numbers));
  return pages;
}

}  // namespace mtstereo::files
