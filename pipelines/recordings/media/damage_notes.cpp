// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/damage_notes.hpp"

#include <charconv>
#include <sstream>

#include "lib/outputs/printable.hpp"

namespace mtstereo::run {
namespace {

constexpr const char* kNoteLine = "damaged";
constexpr const char* kNoTime = "-";

}  // namespace

void add_damage(std::string& damage, const std::string& clause) {
  constexpr std::size_t kMost = 2'000;
  const std::string more = "; and more";
  if (clause.empty() || damage.find(clause) != std::string::npos || damage.ends_with(more)) return;
  const bool fits = damage.empty() || damage.size() + clause.size() <= kMost;
  damage += fits ? (damage.empty() ? "" : "; ") + clause : more;
}

std::string title_of_side(int side, bool two_sources) {
  if (!two_sources) return "recording";
  return side == 0 ? "left view" : "right view";
}

std::string damage_text(const std::vector<DamageNote>& notes, bool two_sources) {
  std::string text;
  for (const int side : {0, 1}) {
    std::vector<DamagedFrame> frames;
    for (const DamageNote& note : notes) {
      if (note.side == side) frames.push_back(note.frame);
    }
    add_damage(text, damage_text(frames, title_of_side(side, two_sources)));
  }
  return text;
}

std::string line_of(const DamageNote& note) {
  return std::string(kNoteLine) + " " + std::to_string(note.side) + " " +
         (note.frame.time ? std::to_string(*note.frame.time) : kNoTime) + " " +
         outputs::printable(note.frame.reason) + "\n";
}

bool parse_line(const std::string& line, DamageNote& note) {
  std::istringstream in(line);
  std::string name, time;
  if (!(in >> name >> note.side >> time) || name != kNoteLine) return false;
  if (note.side != 0 && note.side != 1) return false;
  note.frame.time.reset();
  if (time != kNoTime) {
    Nanoseconds value = 0;
    const char* const end = time.data() + time.size();
    const auto result = std::from_chars(time.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return false;
    note.frame.time = value;
  }
  return static_cast<bool>(std::getline(in >> std::ws, note.frame.reason));
}

}  // namespace mtstereo::run
