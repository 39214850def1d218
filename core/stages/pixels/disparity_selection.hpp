// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "stages/pixels/cost_lanes.hpp"
#include "stages/pixels/selection_data.hpp"

namespace mtstereo {

/// The last part of guided pixel matching: selects each pixel's disparity of least cost and checks
/// it. For each row: call start_selection(), then offer_costs() for its pixels in any order, then
/// finish_selection().

/// The offset of the peak ratio for one path [bits of one pixel].
inline constexpr int kRatioOffset = 10;

/// Maps the best cost to the least cost that is sufficient for its runner-up.
using RunnerUpTable = std::array<std::uint16_t, kCostLimit>;
RunnerUpTable runner_up_table(double confidence);

/// Starts a row.
void start_selection(SelectionScratch& scratch);

/// Passes the costs of the columns begin .. end - 1: the cost of column x and disparity d is at
/// (x - begin) * cost_lanes() + d. Costs are below kCostLimit; cells d >= D have kCostLimit - 1.
/// Pixels with low > high have no expected range. `windows` has one per tile of the row, nullptr =
/// all lanes; disparities outside of them do not exist.
void offer_costs(const std::uint16_t* costs, int begin, int end, int width,
                 const SelectionOptions& options, const std::uint16_t* low,
                 const std::uint16_t* high, const CostWindow* windows, SelectionScratch& scratch);

/// Writes the row of the disparity map [1 / kDisparityOne px] and of the peak ratios (0 for pixels
/// without a disparity). Of equal costs the smallest disparity is the best. The runner-up is the
/// least cost of the disparities that differ from the best by more than 1. A pixel without a
/// runner-up or with low > high gets no disparity.
void finish_selection(int width, const SelectionOptions& options, const std::uint16_t* low,
                      const std::uint16_t* high, const RunnerUpTable& runner_up,
                      SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio);

}  // namespace mtstereo
