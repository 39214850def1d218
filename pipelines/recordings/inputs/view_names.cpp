// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/view_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

struct Words {
  std::string_view left, right;
  bool whole;  // not a part of a longer word or number
};

constexpr std::array<Words, 12> kWords{{{"left", "right", false},
                                        {"Left", "Right", false},
                                        {"LEFT", "RIGHT", false},
                                        {"l", "r", true},
                                        {"L", "R", true},
                                        {"cam0", "cam1", true},
                                        {"cam_0", "cam_1", true},
                                        {"camera0", "camera1", true},
                                        {"image_00", "image_01", true},
                                        {"image_02", "image_03", true},
                                        {"image_0", "image_1", true},
                                        {"image_2", "image_3", true}}};

bool is_word_character(char each) { return std::isalnum(static_cast<unsigned char>(each)) != 0; }

bool is_whole(const std::string& name, std::size_t at, std::size_t length) {
  const std::size_t end = at + length;
  return (at == 0 || !is_word_character(name[at - 1])) &&
         (end >= name.size() || !is_word_character(name[end]));
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

}  // namespace

std::vector<Partner> partners_of(const std::string& left) {
  std::vector<Partner> partners;
  for (const Words& words : kWords) {
    const std::size_t length = words.left.size();
    for (std::size_t at = left.find(words.left); at != std::string::npos;
         at = left.find(words.left, at + 1)) {
      if (words.whole && !is_whole(left, at, length)) continue;
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
    for (const Partner& partner : partners_of(name)) {
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

}  // namespace mtstereo::run
