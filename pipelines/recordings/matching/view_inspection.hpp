// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mtstereo/alignment.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/matching/view_checks.hpp"
#include "recordings/matching/work_options.hpp"

// What mtstereo finds in pairs from the whole recording.

namespace mtstereo::run {

/// The findings of mtstereo on the pairs, which it has inspected all. Means are over their maps.
struct ViewInspection {
  std::string field;     ///< of the rows, as alignment-field; empty: none is confirmed
  bool trusted = false;  ///< the field is confirmed
  double left_blur = 0, right_blur = 0;  ///< that make the views equally sharp [px]
  double sharpness = 0;                  ///< of the left view / the right one; 0: unknown
  std::string problems;                  ///< names, separated by commas
  double density = 0;                    ///< mean [0 .. 1]
  double median = 0;                     ///< mean of the median disparities [px]
  double near_end = 0;  ///< mean share of the disparities in the last tenth of the range

  bool has(PairProblem problem) const;
};

/// The numbers of at most twelve of so many pairs, spread evenly over the recording.
std::vector<std::int64_t> sample_pairs(std::int64_t pairs);

/// Matches these pairs, and inspects each. Throws UserError if none can be decoded.
ViewInspection inspect_views(const Work& work);

/// The correction that was found, as properties of mtstereo that hold it.
std::vector<std::pair<std::string, std::string>> correction_of(const ViewInspection& inspection);

/// Smaller displacements of the rows are not worth a sentence [px].
inline constexpr double kVisibleRows = 0.1;

/// The extreme displacements of the rows over the view; positive: the right view is lower.
struct RowExtremes {
  double least = 0, most = 0;  ///< [px]
  double largest() const;      ///< absolute value [px]
};
/// Those of the confirmed field.
RowExtremes rows_of(const ViewInspection& inspection, ViewSize size);
/// "0.9 px higher", "0.9 to 2.8 px higher", "0.9 px higher to 2.8 px lower"
std::string rows_text(const RowExtremes& rows);

/// Whether advice may suggest to compare the clocks of two recordings: they were not compared.
bool suggests_sync(const Work& work);

/// Tests what is wrong with the views, also with right views of other times. Throws UserError.
ViewDiagnosis diagnose_views(const Work& work, const ViewInspection& inspection);

}  // namespace mtstereo::run
