// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/pfm.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "lib/outputs/pfm_bytes.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/parameters.hpp"
#include "tools/eval/bytes.hpp"
#include "tools/eval/files.hpp"

namespace mtstereo::eval {
namespace {

struct Header {
  int width = 0;
  int height = 0;
  std::endian order = std::endian::little;
  std::size_t length = 0;  // [bytes]
};

// The first four words of the header. The values begin after the line with the fourth word,
// regardless of white space or a comment at the end of that line.
std::vector<std::string> header_words(const std::filesystem::path& file, std::string_view bytes,
                                      std::size_t& length) {
  constexpr std::size_t kLongestHeader = 4096;
  std::vector<std::string> words;
  std::size_t at = 0;
  while (words.size() < 4) {
    const std::size_t end = bytes.substr(0, kLongestHeader).find('\n', at);
    if (end == std::string_view::npos) throw UserError(file, "the PFM header is incomplete");
    std::string line(bytes.substr(at, end - at));
    line = line.substr(0, line.find('#'));
    std::istringstream stream(line);
    for (std::string word; stream >> word;) words.push_back(word);
    at = end + 1;
  }
  length = at;
  return words;
}

int parse_side(const std::filesystem::path& file, const std::string& word, const char* which) {
  int value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || value < 1 || value > kLargestImageSide) {
    throw UserError(file, std::string("the ") + which + " in the PFM header is '" + word +
                              "', not an integer of 1 .. " + std::to_string(kLargestImageSide));
  }
  return value;
}

Header parse_header(const std::filesystem::path& file, std::string_view bytes) {
  const std::string_view magic = bytes.substr(0, 2);
  if (magic == "PF") {
    throw UserError(file, "is a PFM with three channels (PF); a disparity map has one (Pf)");
  }
  if (magic != "Pf") throw UserError(file, "is not a PFM file: it does not begin with 'Pf'");

  Header header;
  const std::vector<std::string> words = header_words(file, bytes, header.length);
  if (words.size() != 4 || words[0] != "Pf") {
    throw UserError(file, "the PFM header is not 'Pf', width, height, scale");
  }
  header.width = parse_side(file, words[1], "width");
  header.height = parse_side(file, words[2], "height");
  char* end = nullptr;
  const double scale = std::strtod(words[3].c_str(), &end);
  if (*end != '\0' || !std::isfinite(scale) || scale == 0) {
    throw UserError(file,
                    "the scale in the PFM header is '" + words[3] + "', not a number other than 0");
  }
  header.order = scale < 0 ? std::endian::little : std::endian::big;
  return header;
}

}  // namespace

cv::Mat read_pfm(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  const Header header = parse_header(file, bytes);
  const std::size_t row = static_cast<std::size_t>(header.width) * sizeof(float);
  const std::size_t needed = row * static_cast<std::size_t>(header.height);
  const std::size_t there = bytes.size() - header.length;
  if (there < needed) {
    throw UserError(file, "ends too early: " + std::to_string(header.width) + "x" +
                              std::to_string(header.height) + " values need " +
                              std::to_string(needed) + " bytes, " + std::to_string(there) +
                              " are there");
  }
  cv::Mat values(header.height, header.width, CV_32FC1);
  for (int y = 0; y < header.height; ++y) {
    const auto from_bottom = static_cast<std::size_t>(header.height - 1 - y);
    const char* source = bytes.data() + header.length + from_bottom * row;
    auto* target = values.ptr<float>(y);
    for (int x = 0; x < header.width; ++x) {
      target[x] = load_float(source + static_cast<std::size_t>(x) * sizeof(float), header.order);
    }
  }
  return values;
}

void write_pfm(const std::filesystem::path& file, const cv::Mat& values) {
  CV_Assert(values.type() == CV_32FC1);
  write_bytes(file, outputs::pfm_bytes(values.cols, values.rows,
                                       [&](int x, int y) { return values.at<float>(y, x); }));
}

}  // namespace mtstereo::eval
