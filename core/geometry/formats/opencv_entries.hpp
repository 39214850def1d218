// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include "geometry/formats/opencv_names.hpp"
#include "geometry/formats/value.hpp"

// The entries of OpenCV's FileStorage. Programs give the same matrices many names, and some put
// them into maps.

namespace mtstereo::formats {

/// K of a file with one camera.
inline constexpr Names kOneCamera = "cameramatrix k mtx intrinsicmatrix";

/// The entries of one to three files. Those of maps have the names of both: left.K.
class OpenCvEntries {
 public:
  explicit OpenCvEntries(const std::vector<Entry>& files);

  std::optional<Entry> find(Names names) const;
  /// A matrix; a single number or word with such a name has another meaning.
  std::optional<Entry> find_matrix(Names names) const;
  /// The matrices of a pair by their names, and what has other names by its structure, where that
  /// is unambiguous.
  PairEntries find_pair() const;
  /// Fails because an entry is missing; names what is there and what is needed.
  [[noreturn]] void fail_without(const char* name, const char* meaning) const;

  const Entry& file() const { return files_.front(); }
  /// How many files have one camera: a camera matrix that is neither the left nor the right one.
  int single_cameras() const;
  /// Whether the files have P1 and P2, but no camera matrix. P0 is of KITTI.
  bool has_projections_only() const;
  /// Whether the files have a matrix of OpenCV, or a camera matrix.
  bool is_opencv() const;

 private:
  /// The xi of a camera: by these names, or in the file of its coefficients.
  std::optional<Entry> find_xi(Names names, const std::optional<Entry>& lens) const;

  std::vector<Entry> files_;
  std::vector<Entry> entries_;
};

}  // namespace mtstereo::formats
