// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace mtstereo::fuzz {

/// Ends the program with a message if `condition` does not hold, so that the fuzzer reports the
/// input.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "requirement not met: %s\n", what);
  std::abort();
}

/// Takes values from the bytes of a fuzzer, from the first to the last. After the last one all
/// values are 0.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ == size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  bool flag() { return (byte() & 1) != 0; }

  /// A little-endian integer.
  std::uint64_t bits(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= static_cast<std::uint64_t>(byte()) << (8 * i);
    return value;
  }
  /// An integer of `least` .. `most`, which are both possible.
  int between(int least, int most) {
    const auto count = static_cast<std::uint64_t>(static_cast<std::int64_t>(most) - least + 1);
    const int bytes = count <= 256 ? 1 : count <= 65536 ? 2 : 4;
    return static_cast<int>(least + static_cast<std::int64_t>(bits(bytes) % count));
  }
  template <typename T, std::size_t kCount>
  const T& one_of(const std::array<T, kCount>& choices) {
    return choices[byte() % kCount];
  }
  /// The bytes up to the next line feed, which is skipped, or up to the end.
  std::string_view line() {
    const std::string_view all = rest();
    const std::size_t end = all.find('\n');
    if (end != std::string_view::npos) at_ -= all.size() - end - 1;
    return all.substr(0, end);
  }
  /// All remaining bytes.
  std::string_view rest() {
    const std::size_t begin = at_;
    at_ = size_;
    if (begin == size_) return {};
    return {reinterpret_cast<const char*>(data_) + begin, size_ - begin};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace mtstereo::fuzz

/// Called once before the first input, with the arguments of main().
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
/// Called for every input. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
