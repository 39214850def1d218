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

/// Sets bit x of `bits` where level[x + 1] differs from level[x], for all x of `width` rounded up
/// to 64: what is read behind the row is the padding of an Image.
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

/// Places for the leaves of a row: one more than there can be, for a node that turns out not to be
/// one.
constexpr int leaf_places(int width) { return most_leaves(width) + 1; }

/// The columns at which the level of a row changes.
class Changes {
 public:
  Changes(const std::uint8_t* level, int width) : words_((width + kWord - 1) / kWord) {
    HWY_DYNAMIC_DISPATCH(find_changes)(level, width, bits_);
    // What the padding is has no meaning, nor has the change from the last pixel to it.
    const int last = (width - 1) % kWord;
    const std::uint64_t kept = (std::uint64_t{1} << last) - 1;
    for (int byte = 0; byte < 8; ++byte) {
      bits_[8 * (words_ - 1) + byte] &= static_cast<std::uint8_t>(kept >> 8 * byte);
    }
  }

  /// Calls body(x) for the columns x whose level is not that of x - 1, from left to right.
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
  // One vector more than the words.
  alignas(kAlignment) std::uint8_t bits_[(kLargestImageSide + kWord) / 8];
};

/// Where the nodes of one row go.
struct RowNodes {
  std::uint16_t* begin;
  std::uint16_t* end;
  std::uint16_t* parent;
  std::uint16_t* leaf;
  int count = 0;
  int leaves = 0;
};

/// Builds one row's tree from left to right. The open nodes, whose end is not known yet, form a
/// stack of rising levels, the last of which is that of the current pixel; a fall of the level
/// closes nodes. Those that a fall closes right after a rise are the leaves.
///
/// Whether the level rises or falls cannot be predicted, so both go the same way: as if the last
/// node were closed. Where it stays open, what was written of it is written anew once it is not.
void build_row(const std::uint8_t* level, int width, RowNodes& nodes) {
  struct Open {
    std::int16_t level;
    std::uint16_t node;
    std::uint16_t begin;
  };
  // Levels are 8-bit, so no more than 256 nodes are open. Below them lies what no level falls to,
  // above them one that was written and not opened.
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
    // Of a new node: where the closed one does after a fall, else here.
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
    // After a fall the component goes on at the new level: as the next open node, or as one not
    // seen so far.
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
  // Every node begins at a change of level of its own.
  const std::size_t nodes = static_cast<std::size_t>(view_width) * view_height;
  for (Buffer<std::uint32_t>* row : {&first, &first_leaf}) row->resize(view_height);
  for (Buffer<int>* row : {&count, &leaf_count}) row->resize(view_height);
  for (Buffer<std::uint16_t>* column : {&begin, &end, &parent}) column->resize(nodes);
  leaf.resize(static_cast<std::size_t>(leaf_places(view_width)) * view_height);
}

void build_max_trees(const Image<std::uint8_t>& level, int y0, int y1, MaxTrees& trees) {
  std::uint32_t first = static_cast<std::uint32_t>(y0) * trees.width;
  std::uint32_t first_leaf = static_cast<std::uint32_t>(y0) * leaf_places(trees.width);
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
