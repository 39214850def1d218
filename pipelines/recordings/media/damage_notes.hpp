// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "recordings/media/decoder_reports.hpp"

namespace mtstereo::run {

/// A damaged frame, and the pair that was decoded when it was found.
struct DamageNote {
  std::int64_t pair = 0;
  int side = 0;  ///< 0: of the left view, or of both; 1: of the right view
  DamagedFrame frame;
};

/// So many notes of a piece are kept.
inline constexpr std::size_t kMostNotes = 100'000;

/// Adds a clause to the damage of a recording, unless the damage has it already. Damage that is
/// long ends with the remark that there is more.
void add_damage(std::string& damage, const std::string& clause);

/// What is decoded for the views: the left one (0) or the right one (1), or one file for both.
std::string title_of_side(int side, bool two_sources);

/// The clauses about damaged frames; empty without one.
std::string damage_text(const std::vector<DamageNote>& notes, bool two_sources);

/// A line of a journal, with its end.
std::string line_of(const DamageNote& note);
/// Reads such a line. The pair is not in it. False if it is another line.
bool parse_line(const std::string& line, DamageNote& note);

}  // namespace mtstereo::run
