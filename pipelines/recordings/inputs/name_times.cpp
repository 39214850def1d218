// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/name_times.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "lib/files/file_names.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

// The last digits of a name that are a time in seconds, such as 1403636579.763556, or in ms, such
// as 1403636579763.556 (rs-convert), in ns.
std::optional<Nanoseconds> seconds_in(std::string stem) {
  stem.resize(stem.find_last_of("0123456789") + 1);
  constexpr std::size_t kEpoch = 10, kMilli = 13, kMicro = 6, kNano = 9;  // digits
  const std::size_t point = stem.find_last_not_of("0123456789");
  if (point == std::string::npos || point == 0 || stem[point] != '.') return std::nullopt;
  const std::size_t before = stem.find_last_not_of("0123456789", point - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::string fraction = stem.substr(point + 1);
  const std::size_t whole = point - begin;
  const bool is_time = whole == kEpoch ? !fraction.empty() && fraction.size() <= kNano
                                       : fraction.size() == kMicro || fraction.size() == kNano;
  const bool is_milli = whole == kMilli && !fraction.empty();
  if (!is_milli && (!is_time || whole == 0 || whole > kEpoch)) return std::nullopt;
  fraction.resize(is_milli ? kMicro : kNano, '0');
  const std::string digits = stem.substr(begin, whole) + fraction;
  Nanoseconds time = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), time);
  return error == std::errc() ? std::optional(time) : std::nullopt;
}

// The date and time in a name, in ns since 1970.
std::optional<Nanoseconds> date_in(const fs::path& image) {
  static const std::regex form(
      "(?:^|.*\\D)((?:19|20)\\d\\d)\\D?(\\d\\d)\\D?(\\d\\d)\\D?(\\d\\d)\\D?(\\d\\d)\\D?(\\d\\d)\\D?"
      "(\\d{3}|\\d{6}|\\d{9})\\D*");
  const std::string stem = image.stem().string();
  std::smatch found;
  if (!std::regex_match(stem, found, form)) return std::nullopt;
  const auto number = [&found](int group) { return std::stoi(found[group].str()); };
  const auto two = [&number](int group) { return static_cast<unsigned>(number(group)); };
  const std::chrono::year_month_day day{std::chrono::year(number(1)), std::chrono::month(two(2)),
                                        std::chrono::day(two(3))};
  if (!day.ok() || number(4) > 23 || number(5) > 59 || number(6) > 59) return std::nullopt;
  std::string fraction = found[7].str();
  fraction.resize(9, '0');
  const std::int64_t days = std::chrono::sys_days(day).time_since_epoch().count();
  return ((days * 24 + number(4)) * 60 + number(5)) * 60 * kSecond + number(6) * kSecond +
         std::stoi(fraction);
}

// The images in the order of their times by a function, and these; none if two are equal. By their
// names, 9.1235 follows 9.12349.
template <typename Read>
Source in_order_of_times(const Source& source, Read read) {
  std::vector<std::pair<Nanoseconds, fs::path>> timed;
  for (const fs::path& image : source.images) {
    const std::optional<Nanoseconds> time = read(image);
    if (!time) return {};
    timed.emplace_back(*time, image);
  }
  std::sort(timed.begin(), timed.end());
  Source sorted;
  for (auto& [time, image] : timed) {
    if (!sorted.times.empty() && time <= sorted.times.back()) return {};
    sorted.times.push_back(time);
    sorted.images.push_back(std::move(image));
  }
  return sorted;
}

// Whether what follows the date is the fraction of the second. Otherwise it may be the number of an
// image in a recording that began at the date.
bool has_fractions(const std::vector<Nanoseconds>& times) {
  if (times.empty() || times.front() / kSecond == times.back() / kSecond) return false;
  return std::any_of(times.begin(), times.end(),
                     [](Nanoseconds time) { return time % kSecond >= kSecond / 10; });
}

}  // namespace

std::optional<std::int64_t> frame_number(const fs::path& image) {
  const std::string digits = files::last_digits(image);
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

std::optional<Nanoseconds> time_in_name(const fs::path& image) {
  if (const std::optional<Nanoseconds> time = seconds_in(image.stem().string())) return time;
  const std::optional<std::int64_t> number = frame_number(image);
  const std::string digits = files::last_digits(image);
  if (!number || digits.starts_with('0')) return std::nullopt;
  switch (digits.size()) {
    case 19:
      return number;
    case 18:  // of a clock that began later than 1970; .NET counts 100 ns from the year 1
      return digits.starts_with("63") || digits.starts_with("64") ? std::nullopt : number;
    case 16:
      return *number * 1000;
    case 13:
      return *number * 1'000'000;
    default:
      return std::nullopt;
  }
}

bool set_times_of_names(Source& left, Source& right) {
  Source a = in_order_of_times(left, date_in), b = in_order_of_times(right, date_in);
  if (!has_fractions(a.times) || (!right.images.empty() && !has_fractions(b.times))) {
    a = in_order_of_times(left, time_in_name);
    b = in_order_of_times(right, time_in_name);
  }
  if (a.images.empty() || b.images.empty() != right.images.empty()) return false;
  left.images = std::move(a.images);
  left.times = std::move(a.times);
  right.images = std::move(b.images);
  right.times = std::move(b.times);
  Nanoseconds first = left.times.front();
  if (!right.times.empty()) first = std::min(first, right.times.front());
  for (Source* source : {&left, &right}) {
    for (Nanoseconds& time : source->times) time -= first;
  }
  return true;
}

}  // namespace mtstereo::run
