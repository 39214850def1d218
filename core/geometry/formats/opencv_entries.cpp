// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/opencv_entries.hpp"

#include <algorithm>
#include <utility>

#include "geometry/formats/opencv_structure.hpp"

namespace mtstereo::formats {
namespace {

constexpr Names kLeftMatrix =
    "m1 k1 cameramatrix1 camera1matrix cm1 intrinsics1 mtx1 cameramatrixl "
    "cameramatrixleft leftcameramatrix kl kleft leftk ml mleft mtxl mtxleft";
constexpr Names kRightMatrix =
    "m2 k2 cameramatrix2 camera2matrix cm2 intrinsics2 mtx2 cameramatrixr "
    "cameramatrixright rightcameramatrix kr kright rightk mr mright mtxr mtxright";
constexpr Names kLeftLens =
    "d1 distcoeffs1 distcoeff1 distortioncoefficients1 distortion1 dist1 distcoeffsl "
    "distcoeffsleft leftdistcoeffs leftdistortioncoefficients dl dleft leftd distl "
    "distleft dleftfe";
constexpr Names kRightLens =
    "d2 distcoeffs2 distcoeff2 distortioncoefficients2 distortion2 dist2 distcoeffsr "
    "distcoeffsright rightdistcoeffs rightdistortioncoefficients dr dright rightd distr "
    "distright drightfe";

constexpr Names kLeftXi = "xi1 xil xileft leftxi";
constexpr Names kRightXi = "xi2 xir xiright rightxi";

bool is_one_of(std::string_view plain, Names names) {
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find(' '));
    if (name == plain) return true;
    names.remove_prefix(std::min(name.size() + 1, names.size()));
  }
  return false;
}

bool is_matrix(const Value& value) {
  return std::find(value.names.begin(), value.names.end(), "data") != value.names.end();
}

/// Adds the entries of a map; a nested map that is no matrix is replaced by its entries.
void flatten(const Entry& map, std::vector<Entry>& entries) {
  const Value& value = map.value();
  for (std::size_t i = 0; i < value.names.size() && i < value.items.size(); ++i) {
    std::string name = map.name().empty() ? "" : map.name() + ".";
    name += printable(value.names[i]);
    entries.emplace_back(value.items[i], map.file(), std::move(name));
    const Entry& entry = entries.back();
    if (!entry.is_map() || is_matrix(entry.value())) continue;
    const Entry inner = entry;
    entries.pop_back();
    flatten(inner, entries);
  }
}

}  // namespace

OpenCvEntries::OpenCvEntries(const std::vector<Entry>& files) : files_(files) {
  for (const Entry& file : files_) {
    if (file.is_map()) flatten(file, entries_);
  }
}

std::optional<Entry> OpenCvEntries::find(Names names) const {
  std::optional<Entry> found;
  for (const Entry& entry : entries_) {
    if (!is_one_of(plain_name(entry.name()), names)) continue;
    const bool same_file = found && found->file() == entry.file();
    if (same_file && found->name() == entry.name()) {
      entry.fail("appears twice; remove one of them");
    }
    if (found && !(found->value() == entry.value())) {
      entry.fail(same_file ? "has another value than " + found->name() + "; remove one of them"
                           : "has another value in " + found->file() + "; remove one of them");
    }
    if (!found) found = entry;
  }
  return found;
}

std::optional<Entry> OpenCvEntries::find_matrix(Names names) const {
  std::optional<Entry> found = find(names);
  const bool single =
      found && found->is_scalar() && found->text().find_first_of(" \t\n") == std::string::npos;
  return single ? std::nullopt : found;
}

std::optional<Entry> OpenCvEntries::find_xi(Names names, const std::optional<Entry>& lens) const {
  std::optional<Entry> found = find(names);
  for (const Entry& entry : entries_) {
    const bool alone = !found && lens && entry.file() == lens->file();
    if (alone && plain_name(entry.name()) == "xi") found = entry;
  }
  return found;
}

PairEntries OpenCvEntries::find_pair() const {
  PairEntries pair;
  pair.left_matrix = find(kLeftMatrix);
  pair.right_matrix = find(kRightMatrix);
  pair.left_lens = find(kLeftLens);
  pair.right_lens = find(kRightLens);
  pair.rotation = find_matrix(kRotationNames);
  pair.translation = find_matrix(kTranslationNames);
  complete_by_structure(entries_, pair);
  pair.left_xi = find_xi(kLeftXi, pair.left_lens);
  pair.right_xi = find_xi(kRightXi, pair.right_lens);
  if (!pair.rotation && pair.left_xi) pair.rotation = find_matrix("rvec om");
  return pair;
}

int OpenCvEntries::single_cameras() const {
  return static_cast<int>(std::count_if(files_.begin(), files_.end(), [](const Entry& file) {
    const OpenCvEntries own({file});
    return !own.find(kLeftMatrix) && !own.find(kRightMatrix) &&
           (own.find_matrix(kOneCamera) || count_camera_matrices(own.entries_) == 1);
  }));
}

bool OpenCvEntries::has_projections_only() const {
  return find_matrix("p1") && find_matrix("p2") && !find("p0") &&
         count_camera_matrices(entries_) == 0;
}

bool OpenCvEntries::is_opencv() const {
  const auto is_known = [&](const Entry& entry) {
    const std::string name = plain_name(entry.name());
    for (const Names& names : {kLeftMatrix, kRightMatrix, kLeftLens, kRightLens, kOneCamera}) {
      if (is_one_of(name, names)) return true;
    }
    const Value& value = entry.value();
    return is_matrix(value) && entry.find("rows") && entry.find("dt");
  };
  if (std::any_of(entries_.begin(), entries_.end(), is_known)) return true;
  if (find(kRotationNames) && find(kTranslationNames)) return true;
  if (has_projections_only()) return true;
  return count_camera_matrices(entries_) > 0 || !transposed_matrix(entries_).empty();
}

void OpenCvEntries::fail_without(const char* name, const char* meaning) const {
  std::string what = std::string("there is no entry ") + name + " (" + meaning + ")";
  if (files_.size() == 1) {
    what += "; if it is in another file, give both, separated by a comma";
  } else {
    for (std::size_t i = 1; i < files_.size(); ++i) what += ", nor in " + files_[i].file();
  }
  const std::string found = matrices_text(entries_);
  what += found.empty() ? ". No matrices were found" : ". Matrices found: " + found;
  const std::string transposed = transposed_matrix(entries_);
  if (!transposed.empty()) {
    what += ". " + transposed +
            " is transposed, as MATLAB states it; transpose it, and the rotation of camera 2";
  }
  files_.front().fail(what + ". Names needed: M1, D1, M2, D2, R, T");
}

}  // namespace mtstereo::formats
