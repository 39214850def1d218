// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container_matroska.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

extern "C" {
#include <libavutil/crc.h>
}

#include "recordings/media/matroska_format.hpp"

namespace mtstereo::run {
namespace {

using ebml::Element, ebml::kCluster, ebml::kSegment, ebml::kUnknown;
constexpr std::uint32_t kChecksum = 0xBF;
// A cluster has a time, blocks, groups of blocks, and few others (RFC 9559, section 5.1.3).
constexpr std::array<std::uint32_t, 9> kInClusters{0xE7, 0xA3, 0xA0,   0xAB,     0xA7,
                                                   0xAF, 0xEC, 0x5854, kChecksum};

std::optional<Element> element_at(Bytes& bytes, std::uint64_t position) {
  const auto start = ebml::start_of(bytes.up_to(position, 12));
  if (!start) return std::nullopt;
  return Element{start->id, position + start->bytes, start->length};
}

std::uint32_t checksum_of(Bytes& bytes, std::uint64_t from, std::uint64_t to) {
  constexpr std::uint64_t kAtOnce = 1 << 20;
  const AVCRC* const table = av_crc_get_table(AV_CRC_32_IEEE_LE);
  std::uint32_t sum = ~std::uint32_t{0};
  for (; from < to; from += kAtOnce) {
    const std::string part = bytes.up_to(from, std::min(kAtOnce, to - from));
    sum = av_crc(table, sum, reinterpret_cast<const std::uint8_t*>(part.data()), part.size());
  }
  return ~sum;
}

// Up to the first damage in the cluster.
void check_cluster(Bytes& bytes, const Element& cluster, DamagedParts& damage) {
  const std::optional<Element> first = element_at(bytes, cluster.content);
  if (first && first->id == kChecksum && first->length == 4 && first->end() <= cluster.end()) {
    const std::uint64_t stated = little_endian(bytes.at(first->content, 4));
    if (stated == checksum_of(bytes, first->end(), cluster.end())) return;
    return damage.add(cluster.content, "a cluster does not have the checksum that it states");
  }
  for (std::uint64_t at = cluster.content; at < cluster.end();) {
    const std::optional<Element> part = element_at(bytes, at);
    const bool known =
        part && std::find(kInClusters.begin(), kInClusters.end(), part->id) != kInClusters.end();
    if (!known || part->end() > cluster.end()) {
      return damage.add(at, "a cluster has something else than blocks");
    }
    at = part->end();
  }
}

// One or two wrong bits in the name: programs skip all of its frames.
bool was_cluster(std::uint32_t name) {
  return name != kCluster && std::popcount(name ^ kCluster) <= 2;
}

}  // namespace

// Segments, and clusters of unknown length, are entered; other elements are skipped.
std::string missing_of_matroska(Bytes& bytes) {
  for (std::uint64_t start = 0; start < bytes.size();) {
    if (bytes.at(start, 1) == std::string(1, '\0')) break;  // what follows is not of the container
    const std::optional<Element> element = element_at(bytes, start);
    if (!element) return "it ends within the header of an element";
    const bool known = element->length != kUnknown;
    if (known && exceeds(element->content, element->length, bytes.size())) {
      return lacks(element->length - (bytes.size() - std::min(element->content, bytes.size())),
                   element->id == kSegment ? "its segment" : "an element");
    }
    start = element->id == kSegment || !known ? element->content : element->end();
  }
  return "";
}

DamagedParts damage_of_matroska(Bytes& bytes) {
  DamagedParts damage;
  std::uint64_t segment_end = 0;
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::optional<Element> element = element_at(bytes, start);
    if (!element) {
      if (start < segment_end) damage.add(start, "there is no element of Matroska");
      break;
    }
    const bool known = element->length != kUnknown;
    if (known && exceeds(element->content, element->length, bytes.size())) {
      if (element->id != kSegment) break;  // missing_of_matroska() states it
    } else if (known && element->id == kCluster) {
      check_cluster(bytes, *element, damage);
    } else if (was_cluster(element->id)) {
      damage.add(start, "the name of a cluster is wrong");
    }
    if (element->id == kSegment && known) segment_end = element->end();
    start = element->id == kSegment || !known ? element->content : element->end();
  }
  return damage;
}

}  // namespace mtstereo::run
