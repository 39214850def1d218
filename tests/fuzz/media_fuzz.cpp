// SPDX-License-Identifier: LGPL-2.1-or-later
// What mtstereo-run reads of files without a decoder: sizes and kinds of images, the structure of
// containers, the coded data of JPEG. The first byte selects the reader, the rest is the file.

#include <algorithm>
#include <string>

#include "fuzz_folder.hpp"
#include "fuzz_input.hpp"
#include "lib/files/unread_kinds.hpp"
#include "recordings/inputs/image_sizes.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/jpeg_check.hpp"

namespace mtstereo::fuzz {
namespace {

bool is_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  return cross > 0 && cross + 1 < text.size() &&
         text.find_first_not_of("0123456789x") == std::string::npos &&
         std::count(text.begin(), text.end(), 'x') == 1;
}

void read_size(FuzzInput& input) {
  const std::string size = run::stated_size(folder().write("view.png", input.rest()));
  require(size.empty() || is_size(size), "a size is two numbers");
}

void read_kind(FuzzInput& input) {
  constexpr std::array kNames = {"view.tif", "view.png", "view.h264"};
  const char* const name = input.one_of(kNames);
  const std::string kind = files::unread_kind(folder().write(name, input.rest()));
  require(kind.empty() || kind.starts_with("is ") || kind.starts_with("has "),
          "a kind that is not read is a clause");
}

void read_container(FuzzInput& input) {
  const std::filesystem::path file = folder().write("view.bin", input.rest());
  const std::string damage = run::damaged_parts(file);
  require(damage.empty() || damage.starts_with("the file is damaged in "), "damage is a clause");
  require(run::missing_end(file) == run::missing_end(file), "an end is found again");
  require(!(run::is_avi(file) && run::is_matroska(file)), "a file has one container");
  require(!run::has_second_view(file) || !run::is_matroska(file), "MP4 alone has a second view");
  run::may_lack_end(file);
}

/// Its sizes are limited, since the library allocates the coefficients of the size in the header.
void read_jpeg(FuzzInput& input) {
  std::string bytes(input.rest());
  for (std::size_t at = 0; at + 9 <= bytes.size(); ++at) {
    const bool frame = bytes[at] == '\xff' && (bytes[at + 1] & 0xf0) == 0xc0;
    if (frame) bytes[at + 5] = bytes[at + 7] = 0;
  }
  require(run::damage_of_jpeg(bytes) == run::damage_of_jpeg(bytes), "damage is found again");
}

}  // namespace
}  // namespace mtstereo::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  mtstereo::fuzz::folder();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mtstereo::fuzz;
  constexpr std::array kReaders = {read_size, read_kind, read_container, read_jpeg};
  FuzzInput input(data, size);
  input.one_of(kReaders)(input);
  return 0;
}
