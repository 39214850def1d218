// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

enum class Place {
  kAny,
  kWhole,   // not a part of a longer word or number
  kEnd,     // of a word in lower case or a number, as in imgL, imgL1 or 1L
  kNumber,  // after a number, as in 000001l
  kBefore   // a number, and not within a word, as in L0001
};

struct Words {
  std::string_view left, right;
  Place place;
};

// Words of cameras come first: left and right may be directions of both, as in lcam_left.
constexpr std::array<Words, 43> kWords{{{"lcam", "rcam", Place::kWhole},
                                        {"left", "right", Place::kAny},
                                        {"Left", "Right", Place::kAny},
                                        {"LEFT", "RIGHT", Place::kAny},
                                        {"l", "r", Place::kWhole},
                                        {"L", "R", Place::kWhole},
                                        {"L", "R", Place::kEnd},
                                        {"l", "r", Place::kNumber},
                                        {"L", "R", Place::kBefore},
                                        {"l", "r", Place::kBefore},
                                        {"LFT", "RGT", Place::kWhole},
                                        {"cam0", "cam1", Place::kWhole},
                                        {"cam_0", "cam_1", Place::kWhole},
                                        {"camera0", "camera1", Place::kWhole},
                                        {"camera_0", "camera_1", Place::kWhole},
                                        {"Camera0", "Camera1", Place::kWhole},
                                        {"Camera_0", "Camera_1", Place::kWhole},
                                        {"camera_00", "camera_01", Place::kWhole},
                                        {"camA", "camB", Place::kWhole},
                                        {"cam_a", "cam_b", Place::kWhole},
                                        {"camera_a", "camera_b", Place::kWhole},
                                        {"master", "slave", Place::kWhole},
                                        {"links", "rechts", Place::kWhole},
                                        {"gauche", "droite", Place::kWhole},
                                        {"izquierda", "derecha", Place::kWhole},
                                        {"sinistra", "destra", Place::kWhole},
                                        {"esquerda", "direita", Place::kWhole},
                                        {"левый", "правый", Place::kAny},
                                        {"левая", "правая", Place::kAny},
                                        {"左", "右", Place::kAny},
                                        {"CAM_B", "CAM_C", Place::kWhole},
                                        {"infra1", "infra2", Place::kWhole},
                                        {"infrared_1", "infrared_2", Place::kWhole},
                                        {"Infrared_1", "Infrared_2", Place::kWhole},
                                        {"Infrared 1", "Infrared 2", Place::kWhole},
                                        {"ir1", "ir2", Place::kWhole},
                                        {"fisheye1", "fisheye2", Place::kWhole},
                                        {"colored_0", "colored_1", Place::kWhole},
                                        {"Image0", "Image1", Place::kWhole},
                                        {"image_00", "image_01", Place::kWhole},
                                        {"image_02", "image_03", Place::kWhole},
                                        {"image_0", "image_1", Place::kWhole},
                                        {"image_2", "image_3", Place::kWhole}}};

// Two of many cameras: they are the left and the right view if the third one is missing.
struct CountedWords {
  std::string_view left, right, third;
};

constexpr std::array<CountedWords, 6> kCountedWords{{{"cam1", "cam2", "cam3"},
                                                     {"cam_1", "cam_2", "cam_3"},
                                                     {"camera1", "camera2", "camera3"},
                                                     {"camera_1", "camera_2", "camera_3"},
                                                     {"Camera1", "Camera2", "Camera3"},
                                                     {"camera_00", "camera_02", "camera_01"}}};

bool is_digit(char each) { return std::isdigit(static_cast<unsigned char>(each)) != 0; }

bool is_letter(char each) { return std::isalpha(static_cast<unsigned char>(each)) != 0; }

bool is_word_character(char each) { return std::isalnum(static_cast<unsigned char>(each)) != 0; }

bool is_whole(const std::string& name, std::size_t at, std::size_t length) {
  const std::size_t end = at + length;
  return (at == 0 || !is_word_character(name[at - 1])) &&
         (end >= name.size() || !is_word_character(name[end]));
}

bool is_in_place(const std::string& name, std::size_t at, std::size_t length, Place place) {
  if (place == Place::kAny) return true;
  if (place == Place::kWhole) return is_whole(name, at, length);
  const std::size_t end = at + length;
  if (place == Place::kBefore) {
    return (at == 0 || !is_word_character(name[at - 1])) && end < name.size() &&
           is_digit(name[end]);
  }
  if (place == Place::kNumber) {
    return at > 0 && is_digit(name[at - 1]) &&
           (end >= name.size() || !is_word_character(name[end]));
  }
  return at > 0 &&
         (std::islower(static_cast<unsigned char>(name[at - 1])) != 0 || is_digit(name[at - 1])) &&
         (end >= name.size() || !is_letter(name[end]));
}

bool is_separator(char each) { return each == '_' || each == '-' || each == ' ' || each == '.'; }

// The name without a word, and without one of the separators around it.
std::string without(const std::string& name, std::size_t at, std::size_t length) {
  std::string before = name.substr(0, at), after = name.substr(at + length);
  const bool ends = after.empty() || after.front() == '.';
  if (!before.empty() && is_separator(before.back()) && (ends || is_separator(after.front()))) {
    before.pop_back();
  } else if (before.empty() && !after.empty() && is_separator(after.front()) && !ends) {
    after.erase(0, 1);
  }
  return before + after;
}

// Whether the numbers in the names count images instead of cameras, as image_0 to image_4 do.
bool count_images(const ViewImages& views, const std::vector<fs::path>& rest) {
  constexpr std::size_t kMostPairs = 2;  // 0 and 1, 2 and 3
  if (views.left.size() > kMostPairs) return false;
  std::string name = views.left.front().filename().string();
  const std::string right = views.right.front().filename().string();
  const auto at = std::mismatch(name.begin(), name.end(), right.begin(), right.end());
  if (at.first == name.end() || at.second == right.end() || !is_digit(*at.first)) return false;
  if (*at.second != *at.first + 1) return false;
  *at.first = '4';
  return std::any_of(rest.begin(), rest.end(),
                     [&name](const fs::path& path) { return path.filename() == name; });
}

// The images of each view by what their names share, if no name has a partner.
std::map<std::string, ViewImages> take_unpaired_views(std::vector<fs::path>& paths) {
  std::map<std::string, ViewImages> found;
  for (const fs::path& path : paths) {
    const std::string stem = path.stem().string();
    for (const bool right : {false, true}) {
      const std::string common = name_without_view(stem, right);
      if (common == stem) continue;
      ViewImages& views = found[name_without_numbers(common)];
      (right ? views.right : views.left).push_back(path);
    }
  }
  std::erase_if(found, [](const auto& each) {
    return each.second.left.empty() || each.second.right.empty();
  });
  std::set<fs::path> taken;
  for (const auto& each : found) {
    taken.insert(each.second.left.begin(), each.second.left.end());
    taken.insert(each.second.right.begin(), each.second.right.end());
  }
  std::erase_if(paths, [&taken](const fs::path& path) { return taken.contains(path); });
  return found;
}

// The partner of a name by the words of counted cameras.
std::optional<Partner> counted_partner(const std::string& left,
                                       const std::set<std::string>& names) {
  for (const CountedWords& words : kCountedWords) {
    const std::size_t at = left.find(words.left), length = words.left.size();
    if (at == std::string::npos || !is_whole(left, at, length)) continue;
    const auto with = [&](std::string_view word) {
      return std::string(left).replace(at, length, word);
    };
    if (names.contains(with(words.third))) continue;
    return Partner{with(words.right), without(left, at, length)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Partner> partners_of(const std::string& left) {
  std::vector<Partner> partners;
  for (const Words& words : kWords) {
    const std::size_t length = words.left.size();
    for (std::size_t at = left.find(words.left); at != std::string::npos;
         at = left.find(words.left, at + 1)) {
      if (!is_in_place(left, at, length, words.place)) continue;
      Partner partner{left, without(left, at, length)};
      partner.right.replace(at, length, words.right);
      partners.push_back(std::move(partner));
    }
  }
  return partners;
}

bool is_view_name(const std::string& name) {
  const std::string stem = fs::path(name).stem().string();
  const auto has = [&stem](std::string_view word) {
    const std::size_t at = stem.find(word);
    return at != std::string::npos && is_whole(stem, at, word.size());
  };
  // A name with both words is that of a file with both views.
  return std::any_of(kWords.begin(), kWords.end(),
                     [&has](const Words& words) { return has(words.left) != has(words.right); });
}

std::vector<PathPair> take_pairs(std::vector<fs::path>& paths) {
  std::set<std::string> names;
  for (const fs::path& path : paths) names.insert(path.filename().string());
  std::vector<PathPair> pairs;
  for (const fs::path& left : paths) {
    const std::string name = left.filename().string();
    if (!names.contains(name)) continue;
    std::vector<Partner> partners = partners_of(name);
    if (auto partner = counted_partner(name, names)) partners.push_back(*std::move(partner));
    for (const Partner& partner : partners) {
      if (!names.contains(partner.right)) continue;
      pairs.push_back({left, left.parent_path() / partner.right, partner.common});
      names.erase(name);
      names.erase(partner.right);
      break;
    }
  }
  std::erase_if(
      paths, [&names](const fs::path& path) { return !names.contains(path.filename().string()); });
  return pairs;
}

std::string name_without_view(const std::string& name, bool right) {
  for (const Words& words : kWords) {
    const std::string_view word = right ? words.right : words.left;
    for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
      if (is_in_place(name, at, word.size(), words.place)) return without(name, at, word.size());
    }
  }
  return name;
}

std::string name_without_numbers(const std::string& name) {
  std::string result = name;
  std::erase_if(result, is_digit);
  return result;
}

std::vector<ViewImages> take_views(std::vector<fs::path>& paths) {
  const std::vector<fs::path> all = paths;
  std::map<std::string, ViewImages> found;
  for (const PathPair& pair : take_pairs(paths)) {
    ViewImages& views = found[name_without_numbers(pair.common)];
    views.left.push_back(pair.left);
    views.right.push_back(pair.right);
  }
  for (const auto& each : found) {
    if (!count_images(each.second, paths)) continue;
    paths = all;
    return {};
  }
  if (found.empty()) found = take_unpaired_views(paths);
  std::vector<ViewImages> result;
  for (auto& [common, views] : found) {
    views.common = common;
    result.push_back(std::move(views));
  }
  return result;
}

}  // namespace mtstereo::run
