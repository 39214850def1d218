// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/pair_cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mtstereo {
namespace {

constexpr float kUnknown = -1;     // not computed yet
constexpr float kImpossible = -2;  // returned for a pair with impossible disparities

NodePair node_pair(const NodeLevel& left, const NodeLevel& right, int y, int i, int j) {
  const std::ptrdiff_t l = left.first[y] + i;
  const std::ptrdiff_t r = right.first[y] + j;
  return {left.begin[l], left.end[l], right.begin[r], right.end[r]};
}

}  // namespace

float intensity_cost(const CostVolume& volume, int y, const NodePair& pair) {
  const int step = 1 << volume.shift;
  const int slope = disparity_slope(pair) * step;
  const std::uint16_t* row = volume.row(y);
  int disparity = (pair.begin_disparity() << kSlopeBits) + (1 << (kSlopeBits - 1));
  std::uint64_t sum = 0;
  int samples = 0;
  for (int x = pair.left_begin; x <= pair.left_end; x += step) {
    sum += row[(disparity >> kSlopeBits) * volume.stride + (x >> volume.shift)];
    disparity += slope;
    ++samples;
  }
  return static_cast<float>(sum) / static_cast<float>(samples * kCostScale);
}

float context_cost(const MaxTrees& left, const MaxTrees& right, int y, int left_node,
                   int right_node) {
  constexpr float kGrayScale = 225;
  const std::uint16_t* left_begin = left.begin.data() + left.first[y];
  const std::uint16_t* left_end = left.end.data() + left.first[y];
  const std::uint16_t* left_parent = left.parent.data() + left.first[y];
  const std::uint16_t* right_begin = right.begin.data() + right.first[y];
  const std::uint16_t* right_end = right.end.data() + right.first[y];
  const std::uint16_t* right_parent = right.parent.data() + right.first[y];
  float sum = 0;
  int steps = 0;
  std::uint16_t l = static_cast<std::uint16_t>(left_node);
  std::uint16_t r = static_cast<std::uint16_t>(right_node);
  while (l != kNoNode && r != kNoNode) {
    const int left_area = left_end[l] - left_begin[l] + 1;
    const int right_area = right_end[r] - right_begin[r] + 1;
    // |aL / (aL + aR) - 1/2| = |aL - aR| / (2 (aL + aR))
    sum += static_cast<float>(std::abs(left_area - right_area)) /
           static_cast<float>(2 * (left_area + right_area));
    ++steps;
    l = left_parent[l];
    r = right_parent[r];
  }
  return sum / static_cast<float>(steps) * kGrayScale;
}

void PairCosts::resize(int width, int disparities, int max_neighbors) {
  const int rows = 2 * max_neighbors + 1;
  if (rows > row_capacity_) {
    rows_ = std::make_unique<Row[]>(rows);
    row_capacity_ = rows;
  }
  row_count_ = rows;
  max_neighbors_ = max_neighbors;
  disparities_ = disparities;
  // At least one pixel separates the nodes of a row, so at most every second column begins one.
  const std::size_t nodes = (width + 1) / 2;
  const std::size_t partners = std::min<std::size_t>(nodes, disparities / 2 + 1);
  for (int i = 0; i < rows; ++i) {
    rows_[i].candidates.resize(nodes);
    rows_[i].offset.resize(nodes);
    rows_[i].costs.resize(nodes * partners);
  }
}

void PairCosts::start(const PairCostInput& input) {
  input_ = &input;
  next_row_ = -1;
}

void PairCosts::move_to(int y) {
  if (next_row_ < 0) next_row_ = std::max(y - max_neighbors_, 0);
  for (const int last = std::min(y + max_neighbors_, input_->left.height - 1); next_row_ <= last;
       ++next_row_) {
    prepare(next_row_);
  }
}

void PairCosts::prepare(int y) {
  const NodeLevel& left = input_->left;
  const NodeLevel& right = input_->right;
  Row& row = this->row(y);
  const int right_count = right.count[y];
  std::size_t size = 0;
  // Nodes are sorted from left to right, so the candidate ranges of successive left nodes are too.
  int first = 0;
  int last = 0;
  for (int i = 0; i < left.count[y]; ++i) {
    const auto too_far = [&](int j) {
      const NodePair pair = node_pair(left, right, y, i, j);
      return pair.begin_disparity() >= disparities_ || pair.end_disparity() >= disparities_;
    };
    const auto in_reach = [&](int j) {
      const NodePair pair = node_pair(left, right, y, i, j);
      return pair.begin_disparity() >= 0 && pair.end_disparity() >= 0;
    };
    while (first < right_count && too_far(first)) ++first;
    while (last < right_count && in_reach(last)) ++last;
    row.candidates[i] = {first, std::max(first, last)};
    row.offset[i] = size;
    size += std::max(last - first, 0);
  }
  std::fill_n(row.costs.data(), size, kUnknown);
}

float PairCosts::operator()(int y, int i, int j) {
  Row& row = this->row(y);
  const Candidates range = row.candidates[i];
  if (j < range.first || j >= range.last) return kImpossible;
  float& cost = row.costs[row.offset[i] + (j - range.first)];
  if (cost == kUnknown) cost = compute(y, i, j);
  return cost;
}

float PairCosts::compute(int y, int i, int j) const {
  const NodeLevel& left = input_->left;
  const NodeLevel& right = input_->right;
  const float alpha = input_->intensity_weight;
  const NodePair pair = node_pair(left, right, y, i, j);
  const float intensity = intensity_cost(input_->volume, y, pair);
  if (alpha == 1) return intensity;
  const float context = context_cost(input_->left_trees, input_->right_trees, y,
                                     left.node[left.first[y] + i], right.node[right.first[y] + j]);
  return alpha * intensity + (1 - alpha) * context;
}

}  // namespace mtstereo
