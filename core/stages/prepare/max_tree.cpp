// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/max_tree.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "mtstereo/parameters.hpp"

#define HWY_TARGET_INCLUDE "stages/prepare/max_tree.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Sets bit x of `bits` if level[x + 1] differs from level[x], and clears it otherwise, for all x
/// below `width` rounded up to 64. The reads past the end of the row are in the padding of an
/// Image.
void find_changes(const std::uint8_t* level, int width, std::uint8_t* bits) {
  const hn::CappedTag<std::uint8_t, 64> d8;
  const int lanes = static_cast<int>(hn::Lanes(d8));
  for (int x = 0; x < width; x += 64) {
    for (int part = 0; part < 64; part += lanes) {
      const auto here = hn::LoadU(d8, level + x + part);
      const auto next = hn::LoadU(d8, level + x + part + 1);
      hn::StoreMaskBits(d8, hn::Ne(here, next), bits + (x + part) / 8);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(find_changes);

namespace {

constexpr int kWord = 64;  // [bits]

/// Capacity for the leaves of a row: one more than there can be, since build_row() writes a
/// candidate before it knows whether that is a leaf.
constexpr int leaf_capacity(int width) { return most_leaves(width) + 1; }

/// The columns at which the level of a row changes.
class Changes {
 public:
  Changes(const std::uint8_t* level, int width) : words_((width + kWord - 1) / kWord) {
    HWY_DYNAMIC_DISPATCH(find_changes)(level, width, bits_);
    // Clears the bits of the padding and that of the change from the last pixel to it.
    const int last = (width - 1) % kWord;
    const std::uint64_t kept = (std::uint64_t{1} << last) - 1;
    for (int byte = 0; byte < 8; ++byte) {
      bits_[8 * (words_ - 1) + byte] &= static_cast<std::uint8_t>(kept >> 8 * byte);
    }
  }

  /// Calls body(x) for each column x whose level differs from that of x - 1, from left to right.
  template <typename Body>
  void for_each(Body&& body) const {
    for (int i = 0; i < words_; ++i) {
      for (std::uint64_t left = word(i); left != 0; left &= left - 1) {
        body(i * kWord + std::countr_zero(left) + 1);
      }
    }
  }

 private:
  std::uint64_t word(int i) const {
    std::uint64_t word;
    std::memcpy(&word, bits_ + 8 * i, sizeof(word));
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
    return word;
  }

  int words_;
  // One word more than the row needs.
  alignas(kAlignment) std::uint8_t bits_[(kLargestImageSide + kWord) / 8];
};

/// The output of one row.
struct RowNodes {
  std::uint16_t* begin;
  std::uint16_t* end;
  std::uint16_t* parent;
  std::uint16_t* leaf;
  int count = 0;
  int leaves = 0;
};

/// Builds one row's tree from left to right. The open nodes, whose end is not known yet, form a
/// stack of rising levels; the top has the level of the current pixel. A fall of the level closes
/// nodes. A node that a fall closes right after a rise is a leaf.
///
/// Whether the level rises or falls cannot be predicted, so both cases run the same code without a
/// branch, as if the last node were closed. If it stays open, its entries are overwritten when it
/// is closed.
void build_row(const std::uint8_t* level, int width, RowNodes& nodes) {
  struct Open {
    std::int16_t level;
    std::uint16_t node;
    std::uint16_t begin;
  };
  // Levels have 8 bits, so at most 256 nodes are open. The entry below them has a level that no
  // pixel falls to; the one above them may be written without being opened.
  Open stack[1 + 256 + 1];
  stack[0] = {-1, kNoNode, 0};
  stack[1] = {level[0], 0, 0};
  Open* top = stack + 1;
  nodes.begin[0] = 0;
  int count = 1;
  int leaves = 0;
  int rose = 1;  // 1 after a rise, else 0

  Changes(level, width).for_each([&](int x) {
    const int now = level[x];
    const int falls = now < level[x - 1];
    const auto last = static_cast<std::uint16_t>(x - 1);
    std::uint16_t closed = top->node;
    // The first column of a new node: after a fall that of the closed node, else x.
    std::uint16_t begin = static_cast<std::uint16_t>(x ^ ((x ^ top->begin) & -falls));
    nodes.end[closed] = last;
    nodes.leaf[leaves] = closed;
    leaves += falls & rose;
    rose = 1 - falls;
    top -= falls;
    for (; top->level > now; --top) {
      nodes.parent[closed] = top->node;
      closed = top->node;
      begin = top->begin;
      nodes.end[closed] = last;
    }
    // After a fall the component continues at the new level: as the next open node, or as a new
    // one.
    const int opens = top->level < now;
    top[1] = {static_cast<std::int16_t>(now), static_cast<std::uint16_t>(count), begin};
    nodes.begin[count] = begin;
    count += opens;
    top += opens;
    nodes.parent[closed] = top->node;
  });
  nodes.leaf[leaves] = top->node;
  leaves += rose;
  for (; top != stack; --top) {
    nodes.end[top->node] = static_cast<std::uint16_t>(width - 1);
    nodes.parent[top->node] = top[-1].node;
  }
  nodes.count = count;
  nodes.leaves = leaves;
}

}  // namespace

void MaxTrees::resize(int view_width, int view_height) {
  width = view_width;
  height = view_height;
  // Every node begins at a change of level of its own, so a row has at most one node per pixel.
  const std::size_t nodes = static_cast<std::size_t>(view_width) * view_height;
  for (Buffer<std::uint32_t>* row : {&first, &first_leaf}) row->resize(view_height);
  for (Buffer<int>* row : {&count, &leaf_count}) row->resize(view_height);
  for (Buffer<std::uint16_t>* column : {&begin, &end, &parent}) column->resize(nodes);
  leaf.resize(static_cast<std::size_t>(leaf_capacity(view_width)) * view_height);
}

void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees) {
  std::uint32_t first = static_cast<std::uint32_t>(y0) * trees.width;
  std::uint32_t first_leaf = static_cast<std::uint32_t>(y0) * leaf_capacity(trees.width);
  for (int y = y0; y < y1; ++y) {
    RowNodes nodes = {trees.begin.data() + first, trees.end.data() + first,
                      trees.parent.data() + first, trees.leaf.data() + first_leaf};
    build_row(level.row(y), trees.width, nodes);
    trees.first[y] = first;
    trees.count[y] = nodes.count;
    trees.first_leaf[y] = first_leaf;
    trees.leaf_count[y] = nodes.leaves;
    first += nodes.count;
    first_leaf += nodes.leaves;
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE
