// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/image_lists.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "lib/files/file_names.hpp"
#include "lib/files/unread_kinds.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/name_times.hpp"
#include "recordings/inputs/view_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& file, std::int64_t from_end, std::size_t count) {
  std::ifstream stream(file, std::ios::binary);
  if (from_end > 0) {
    stream.seekg(0, std::ios::end);
    stream.seekg(-std::min<std::int64_t>(from_end, stream.tellg()), std::ios::end);
  }
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

using Numbers = std::vector<std::int64_t>;

// The numbers of images, if they increase.
Numbers numbers_of(const std::vector<fs::path>& images) {
  Numbers numbers;
  for (const fs::path& image : images) {
    const std::optional<std::int64_t> number = frame_number(image);
    if (!number || (!numbers.empty() && *number <= numbers.back())) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

// The numbers before the last ones, which may be those of the camera or an exposure.
Numbers inner_numbers_of(const std::vector<fs::path>& images) {
  std::vector<fs::path> beginnings;
  for (const fs::path& image : images) {
    const std::string last = files::last_digits(image), stem = image.stem().string();
    if (last.empty()) return {};
    beginnings.emplace_back(stem.substr(0, stem.rfind(last)) + ".");
  }
  return numbers_of(beginnings);
}

struct NumberedLess {
  bool operator()(const std::string& a, const std::string& b) const {
    return files::numbered_less(a, b);
  }
};

// Names without numbers: the place of each name among all of them. `by_view`: without the words
// left and right.
std::pair<Numbers, Numbers> places_of(const std::vector<fs::path>& left,
                                      const std::vector<fs::path>& right, bool by_view) {
  std::map<std::string, std::int64_t, NumberedLess> places;
  const auto name_of = [by_view](const fs::path& image, bool is_right) {
    const std::string stem = image.stem().string();
    return by_view ? name_without_view(stem, is_right) : stem;
  };
  for (const fs::path& image : left) places[name_of(image, false)] = 0;
  for (const fs::path& image : right) places[name_of(image, true)] = 0;
  std::int64_t place = 0;
  for (auto& each : places) each.second = place++;
  const auto place_of = [&](const std::vector<fs::path>& images, bool is_right) {
    Numbers numbers;
    for (const fs::path& image : images) numbers.push_back(places[name_of(image, is_right)]);
    return numbers;
  };
  return {place_of(left, false), place_of(right, true)};
}

std::size_t count_common(const std::pair<Numbers, Numbers>& numbers) {
  const std::set<std::int64_t> in_left(numbers.first.begin(), numbers.first.end());
  return static_cast<std::size_t>(
      std::count_if(numbers.second.begin(), numbers.second.end(),
                    [&in_left](std::int64_t number) { return in_left.contains(number); }));
}

// Whether more than half of the frames of the shorter list are in the other one.
bool fit(const std::pair<Numbers, Numbers>& numbers) {
  return 2 * count_common(numbers) > std::min(numbers.first.size(), numbers.second.size());
}

bool increase(const Numbers& numbers) {
  return std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) ==
         numbers.end();
}

bool successive(const Numbers& numbers) {
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] != numbers[i - 1] + 1) return false;
  }
  return true;
}

// The numbers from 0 on, with the distance of 1 that most data sets have, also if only each tenth
// frame was stored.
void normalize(Numbers& left, Numbers& right) {
  const std::int64_t left_least = *std::min_element(left.begin(), left.end());
  const std::int64_t least =
      right.empty() ? left_least
                    : std::min(left_least, *std::min_element(right.begin(), right.end()));
  std::int64_t step = 0;
  for (const Numbers* numbers : {&left, &right}) {
    for (const std::int64_t number : *numbers) step = std::gcd(step, number - least);
  }
  for (Numbers* numbers : {&left, &right}) {
    for (std::int64_t& number : *numbers)
      number = (number - least) / std::max<std::int64_t>(step, 1);
  }
}

// Replaces numbers whose times 64 bits cannot count by their places among all of them.
void shorten(Recording& recording, Numbers& left, Numbers& right, double frame_rate) {
  constexpr double kLongest = 9e9;  // [s]
  std::set<std::int64_t> all(left.begin(), left.end());
  all.insert(right.begin(), right.end());
  if (all.empty() || static_cast<double>(*all.rbegin()) / frame_rate < kLongest) return;
  for (Numbers* numbers : {&left, &right}) {
    for (std::int64_t& number : *numbers) number = std::distance(all.begin(), all.find(number));
  }
  recording.remarks.push_back(
      "The numbers in the names are too far apart for frames: the images follow each other at the "
      "frame rate.");
}

std::vector<Nanoseconds> times_of(const Numbers& numbers, double frame_rate) {
  std::vector<Nanoseconds> times;
  times.reserve(numbers.size());
  for (const std::int64_t number : numbers) {
    times.push_back(std::llround(static_cast<double>(number) * kSecond / frame_rate));
  }
  return times;
}

// The frames of two lists of which some have the same number.
std::pair<Numbers, Numbers> common_numbers(Recording& recording, const std::vector<fs::path>& left,
                                           const std::vector<fs::path>& right) {
  std::pair<Numbers, Numbers> numbers{numbers_of(left), numbers_of(right)};
  const std::pair<Numbers, Numbers> inner{inner_numbers_of(left), inner_numbers_of(right)};
  if (fit(numbers)) return count_common(inner) > count_common(numbers) ? inner : numbers;
  for (const bool by_view : {false, true}) {
    numbers = places_of(left, right, by_view);
    if (increase(numbers.first) && increase(numbers.second) && fit(numbers)) return numbers;
  }
  if (fit(inner)) return inner;
  numbers.first.resize(left.size());
  numbers.second.resize(right.size());
  std::iota(numbers.first.begin(), numbers.first.end(), 0);
  std::iota(numbers.second.begin(), numbers.second.end(), 0);
  if (left.size() == 1 && right.size() == 1) return numbers;
  recording.remarks.push_back(
      "The names of the left and right images have no numbers in common: the n-th of both are a "
      "pair" +
      (left.size() == right.size() ? "."
                                   : ", with " + std::to_string(left.size()) + " left and " +
                                         std::to_string(right.size()) + " right images."));
  return numbers;
}

// Names with several kinds, such as 1.png and 1_mask.png, may not all be those of views.
void note_kinds(Recording& recording, const std::vector<fs::path>& images) {
  std::map<std::string, fs::path> kinds;
  for (const fs::path& image : images) {
    kinds.emplace(name_without_numbers(image.filename().string()), image);
  }
  if (kinds.size() < 2 || 2 * kinds.size() > images.size()) return;
  recording.remarks.push_back(
      "The names of images differ in more than their numbers: " + kinds.begin()->second.string() +
      " and " + std::next(kinds.begin())->second.filename().string() +
      " are both taken as views. A pattern takes some of them only.");
}

// Removes what cannot be read, and what has no later time than its predecessor.
void remove_broken(Recording& recording, Source& source) {
  Source good;
  for (std::size_t i = 0; i < source.images.size(); ++i) {
    std::string problem = image_problem(source.images[i]);
    if (problem.empty() && !good.times.empty() && source.times[i] <= good.times.back()) {
      problem = "has no later time than its predecessor";
    }
    if (problem.empty()) {
      good.images.push_back(source.images[i]);
      good.times.push_back(source.times[i]);
    } else {
      recording.remarks.push_back(source.images[i].string() + " is left out: it " + problem + ".");
    }
  }
  const std::size_t left_out = source.images.size() - good.images.size();
  if (left_out > 0) {
    good.damage = std::to_string(left_out) + " of " + std::to_string(source.images.size()) +
                  (left_out == 1 ? " images is left out" : " images are left out");
  }
  if (good.images.empty() && !source.images.empty()) {
    throw UserError(source.images.front().parent_path().string() +
                    ": no image can be read: the first one " +
                    image_problem(source.images.front()));
  }
  source = std::move(good);
}

}  // namespace

std::string image_problem(const fs::path& image) {
  const std::string head = bytes_of(image, 0, 8);
  if (head.empty()) return "is empty or cannot be read";
  if (const std::string kind = files::unread_kind(image); !kind.empty()) return kind;
  const std::string extension = files::extension_of(image);
  if (extension == ".png") {
    if (!head.starts_with("\x89PNG")) return "is no PNG file";
    if (bytes_of(image, 64, 64).find("IEND") == std::string::npos) return "is truncated";
  }
  if (files::is_jpeg(image)) {
    if (!head.starts_with("\xff\xd8")) return "is no JPEG file";
    constexpr std::size_t kEnd = 4096;  // some cameras write more after the end of the image
    if (bytes_of(image, kEnd, kEnd).find("\xff\xd9") == std::string::npos) return "is truncated";
  }
  return "";
}

void set_images(Recording& recording, const std::vector<fs::path>& left,
                const std::vector<fs::path>& right, double frame_rate) {
  if (!(frame_rate > 0)) throw UserError("the frame rate of images must be above 0");
  Source left_source{{}, left, {}}, right_source{{}, right, {}};
  bool needs_times = true;
  note_kinds(recording, left.size() >= right.size() ? left : right);
  if (!set_times_of_names(left_source, right_source)) {
    auto [left_numbers, right_numbers] = right.empty() ? std::pair(numbers_of(left), Numbers())
                                                       : common_numbers(recording, left, right);
    if (left_numbers.empty()) {
      left_numbers.resize(left.size());
      std::iota(left_numbers.begin(), left_numbers.end(), 0);
    }
    normalize(left_numbers, right_numbers);
    shorten(recording, left_numbers, right_numbers, frame_rate);
    needs_times = !successive(left_numbers) || left_numbers.front() != 0 ||
                  (!right.empty() && left_numbers != right_numbers);
    left_source.times = times_of(left_numbers, frame_rate);
    right_source.times = times_of(right_numbers, frame_rate);
  }
  set_timed_images(recording, left_source, right_source);
  needs_times |=
      recording.left.images.size() != left.size() || recording.right.images.size() != right.size();
  if (needs_times) return;
  recording.left.times.clear();
  recording.right.times.clear();
  recording.frame_rate = frame_rate;
}

void set_timed_images(Recording& recording, const Source& left, const Source& right) {
  recording.left = left;
  recording.right = right;
  remove_broken(recording, recording.left);
  remove_broken(recording, recording.right);
}

}  // namespace mtstereo::run
