// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/formats/opencv_structure.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "geometry/calibration_checks.hpp"

namespace mtstereo::formats {
namespace {

/// What the values of an entry can be.
enum class Shape { kOther, kCamera, kLens, kRotation, kVector };

/// An entry with numbers.
struct Numbers {
  Entry entry;
  std::vector<double> values;
  Shape shape = Shape::kOther;
};

/// K has a last row of 0 0 1 and focal lengths that no rotation has.
bool is_camera_matrix(const std::vector<double>& v) {
  constexpr double kShortestFocal = 10;  // [px]
  return v.size() == 9 && v[0] > kShortestFocal && v[4] > kShortestFocal && v[3] == 0 &&
         v[6] == 0 && v[7] == 0 && v[8] == 1;
}

bool is_rotation(const std::vector<double>& v) {
  if (v.size() != 9) return false;
  Matrix3 matrix{};
  std::copy(v.begin(), v.end(), matrix.begin());
  return rotation_problem(matrix).empty();
}

/// P1 and P2 have as many values as a lens can have coefficients.
bool is_projection(const std::vector<double>& v) {
  return v.size() == 12 && v[8] == 0 && v[9] == 0 && v[10] == 1;
}

Shape shape_of(const std::vector<double>& v) {
  if (is_camera_matrix(v)) return Shape::kCamera;
  if (is_rotation(v)) return Shape::kRotation;
  if (is_projection(v)) return Shape::kOther;
  if (is_coefficient_count(LensModel::kPlumbBob, v.size())) return Shape::kLens;
  return v.size() == 3 ? Shape::kVector : Shape::kOther;
}

std::string last_part(const std::string& name) {
  return plain_name(name.substr(name.rfind('.') + 1));
}

/// Whether a name is that of distortion coefficients.
bool names_lens(const Entry& entry) {
  const std::string name = plain_name(entry.name());
  return name.find("dist") != std::string::npos || name.find("coef") != std::string::npos ||
         last_part(entry.name()).substr(0, 1) == "d";
}

/// Whether four numbers are those of a part of the image, of a rotation, or fx, fy, cx, cy, unless
/// the name is that of a lens.
bool is_other_four(const Entry& entry) {
  constexpr std::size_t kFour = 4;
  return entry.numbers().size() == kFour && !names_lens(entry) &&
         last_part(entry.name()).substr(0, 1) != "k";
}

/// The entries that are lists of numbers or matrices.
std::vector<Numbers> numbers_of(const std::vector<Entry>& entries) {
  std::vector<Numbers> numbers;
  for (const Entry& entry : entries) {
    try {
      std::vector<double> values = entry.numbers();
      const bool no_distortion = values.empty() && !entry.is_scalar() && names_lens(entry);
      if (values.size() < 2 && !no_distortion) continue;
      const Shape shape = no_distortion ? Shape::kLens : shape_of(values);
      numbers.push_back({entry, std::move(values), shape});
    } catch (const FileError&) {
      continue;  // a text
    }
  }
  return numbers;
}

bool contains(Names names, const std::string& name) {
  return (" " + std::string(names) + " ").find(" " + name + " ") != std::string::npos;
}

/// Of several candidates those that a word in their names distinguishes.
template <typename Preferred>
void keep_preferred(std::vector<Entry>& candidates, std::size_t count, const Preferred& preferred) {
  if (candidates.size() <= count) return;
  std::vector<Entry> kept;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(kept), preferred);
  if (kept.size() == count) candidates = std::move(kept);
}

/// The side that a name states: 0 left, 1 right, or -1.
int stated_side(const std::string& name) {
  const std::string plain = plain_name(name);
  const bool left = plain.find("left") != std::string::npos;
  const bool right = plain.find("right") != std::string::npos;
  if (left != right) return right ? 1 : 0;
  return -1;
}

/// The same for names that end in L and R, or l and r, and are equal otherwise.
bool are_left_and_right(const std::string& a, const std::string& b) {
  const std::string first = plain_name(a);
  const std::string second = plain_name(b);
  const std::size_t stem = first.size() - 1;
  return first.size() > 1 && first.size() == second.size() && first.back() == 'l' &&
         second.back() == 'r' && first.compare(0, stem, second, 0, stem) == 0;
}

/// The first number in a name, or -1.
int number_in(const std::string& name) {
  const std::size_t at = name.find_first_of("0123456789");
  return at == std::string::npos ? -1 : name[at] - '0';
}

/// Puts two candidates into the order left, right; false if their names do not state it.
bool put_in_order(std::vector<Entry>& two) {
  const auto order = [&](int a, int b) {
    if (a < 0 || b < 0 || a == b) return false;
    if (a > b) std::swap(two[0], two[1]);
    return true;
  };
  const std::string& a = two[0].name();
  const std::string& b = two[1].name();
  if (order(stated_side(a), stated_side(b)) || order(number_in(a), number_in(b))) return true;
  if (are_left_and_right(b, a)) std::swap(two[0], two[1]);
  if (are_left_and_right(two[0].name(), two[1].name())) return true;
  // The same names in two files: LEFT,RIGHT.
  return a == b && two[0].file() != two[1].file();
}

std::vector<Entry> of_shape(const std::vector<Numbers>& numbers, Shape shape) {
  std::vector<Entry> entries;
  for (const Numbers& candidate : numbers) {
    if (candidate.shape == shape) entries.push_back(candidate.entry);
  }
  return entries;
}

/// Whether a name states the place of a camera on something else than the other camera.
bool is_on_body(const std::string& name) {
  const std::string plain = plain_name(name);
  constexpr std::array<std::string_view, 8> kBodies = {"imu",      "body",  "lidar", "velo",
                                                       "baselink", "world", "robot", "gravity"};
  return std::any_of(kBodies.begin(), kBodies.end(),
                     [&](std::string_view body) { return plain.find(body) != std::string::npos; });
}

/// Sets the entries of both cameras, if one is missing and there are two of the shape.
void complete_both(std::vector<Entry> candidates, std::optional<Entry>& left,
                   std::optional<Entry>& right) {
  if ((left && right) || candidates.size() != 2 || !put_in_order(candidates)) return;
  left.emplace(candidates[0]);
  right.emplace(candidates[1]);
}

void complete_one(std::vector<Entry> candidates, Names names, std::optional<Entry>& entry) {
  if (entry) return;
  std::erase_if(candidates, [](const Entry& candidate) { return is_on_body(candidate.name()); });
  keep_preferred(candidates, 1, [&](const Entry& candidate) {
    return contains(names, last_part(candidate.name()));
  });
  if (candidates.size() == 1) entry.emplace(candidates[0]);
}

}  // namespace

void complete_by_structure(const std::vector<Entry>& entries, PairEntries& pair) {
  if (pair.left_matrix && pair.right_matrix && pair.left_lens && pair.right_lens && pair.rotation &&
      pair.translation) {
    return;
  }
  const std::vector<Numbers> numbers = numbers_of(entries);
  complete_both(of_shape(numbers, Shape::kCamera), pair.left_matrix, pair.right_matrix);
  std::vector<Entry> lenses = of_shape(numbers, Shape::kLens);
  std::erase_if(lenses, is_other_four);
  keep_preferred(lenses, 2, names_lens);
  complete_both(lenses, pair.left_lens, pair.right_lens);
  // R1 and R2 turn the views: without R they are no rotation between the cameras.
  complete_one(of_shape(numbers, Shape::kRotation), kRotationNames, pair.rotation);
  std::vector<Entry> vectors = of_shape(numbers, Shape::kVector);
  // A rotation vector is no translation, even if it is the only vector.
  vectors.erase(std::remove_if(vectors.begin(), vectors.end(),
                               [](const Entry& vector) {
                                 const std::string name = last_part(vector.name());
                                 return name.find("rot") != std::string::npos ||
                                        name.find("rvec") != std::string::npos;
                               }),
                vectors.end());
  complete_one(vectors, kTranslationNames, pair.translation);
}

std::string transposed_matrix(const std::vector<Entry>& entries) {
  for (const Numbers& numbers : numbers_of(entries)) {
    const std::vector<double>& v = numbers.values;
    if (v.size() != 9) continue;
    const std::vector<double> back = {v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]};
    if (!is_camera_matrix(v) && is_camera_matrix(back)) return printable(numbers.entry.name());
  }
  return {};
}

std::size_t count_camera_matrices(const std::vector<Entry>& entries) {
  return of_shape(numbers_of(entries), Shape::kCamera).size();
}

std::string matrices_text(const std::vector<Entry>& entries) {
  constexpr std::size_t kMost = 8;
  std::string text;
  std::size_t count = 0;
  for (const Numbers& numbers : numbers_of(entries)) {
    if (++count > kMost) return text + " and others";
    text += (text.empty() ? "" : ", ") + printable(numbers.entry.name()) + " (" +
            std::to_string(numbers.values.size()) + " values)";
  }
  return text;
}

}  // namespace mtstereo::formats
