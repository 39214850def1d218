// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/container_transport.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace mtstereo::run {
namespace {

constexpr std::size_t kPacket = 188;
constexpr char kSync = 0x47;
constexpr std::uint64_t kPidMask = 0x1fff;

// A packet of a stream of elements (PES), of which packets of MPEG-TS have the parts.
struct StreamPacket {
  std::uint64_t stated = 0;  // its length; 0: it ends where the next one starts
  std::uint64_t found = 0;   // of it
  bool padded = false;       // its last part does not fill its packet of MPEG-TS
};

// Whether an adaptation field has bytes that only fill the packet, or may have some.
bool has_padding(std::string_view packet) {
  const std::uint64_t length = big_endian(packet.substr(4, 1));
  if (length == 0) return true;
  const std::uint64_t flags = big_endian(packet.substr(5, 1));
  const std::uint64_t clocks = ((flags & 0x10) != 0 ? 6 : 0) + ((flags & 0x08) != 0 ? 6 : 0);
  return (flags & 0x07) != 0 || flags == 0 || length > 1 + clocks;
}

// Adds a packet of MPEG-TS.
void add_packet(std::string_view packet, std::map<std::uint64_t, StreamPacket>& streams) {
  constexpr std::uint64_t kHead = 6;  // [bytes] before what a PES counts
  const std::uint64_t id = big_endian(packet.substr(1, 2)), kinds = big_endian(packet.substr(3, 1));
  const bool starts = (id & 0x4000) != 0, has_field = (kinds & 0x20) != 0;
  if ((kinds & 0x10) == 0) return;
  const std::uint64_t field = has_field ? 1 + big_endian(packet.substr(4, 1)) : 0;
  if (4 + field > packet.size()) return;
  const std::string_view part = packet.substr(4 + field);
  auto stream = streams.find(id & kPidMask);
  if (starts) {
    if (stream != streams.end()) streams.erase(stream);
    if (part.size() < kHead || part.substr(0, 3) != std::string_view("\0\0\1", 3)) return;
    const std::uint64_t length = big_endian(part.substr(4, 2));
    stream = streams.emplace(id & kPidMask, StreamPacket{length > 0 ? length + kHead : 0}).first;
  }
  if (stream == streams.end()) return;
  stream->second.found += part.size();
  stream->second.padded = has_field && has_padding(packet);
}

// The last packet of each stream, by PID.
std::map<std::uint64_t, StreamPacket> last_packets(Bytes& bytes, const Packets& kind) {
  constexpr std::uint64_t kTail = 1 << 24;  // [bytes]; a frame is shorter
  const std::uint64_t count = bytes.size() / kind.length;
  const std::uint64_t first = count - std::min(count, kTail / kind.length);
  const std::string tail = bytes.at(first * kind.length, (count - first) * kind.length);
  std::map<std::uint64_t, StreamPacket> streams;
  for (std::size_t at = kind.start; at + kPacket <= tail.size(); at += kind.length) {
    add_packet(std::string_view(tail).substr(at, kPacket), streams);
  }
  return streams;
}

// What is before the data of a packet.
struct PacketHead {
  explicit PacketHead(std::string_view packet)
      : id(big_endian(packet.substr(1, 2)) & kPidMask),
        marked((packet[1] & 0x80) != 0),
        starts((packet[1] & 0x40) != 0),
        has_data((packet[3] & 0x10) != 0),
        counter(packet[3] & 0x0f) {
    const bool has_field = (packet[3] & 0x20) != 0;
    const std::uint64_t length = has_field ? big_endian(packet.substr(4, 1)) : 0;
    restarts = length > 0 && (packet[5] & 0x80) != 0;
    const std::uint64_t begin = 4 + (has_field ? 1 + length : 0);
    if (has_data && begin + 4 <= kPacket) data = packet.substr(begin);
  }

  bool starts_video() const {
    return starts && data.starts_with(std::string_view("\0\0\1", 3)) && (data[3] & 0xf0) == 0xe0;
  }

  std::uint64_t id;
  bool marked;    // as damaged
  bool starts;    // a packet of the stream (PES) or a table
  bool has_data;  // the counter counts these packets
  int counter;
  bool restarts;  // its counter may be any
  std::string_view data;
};

class Continuity {
 public:
  void add(std::string_view packet, std::uint64_t position) {
    if (packet[0] != kSync) {
      if (!lost_) damage_.add(position, "there is no packet of MPEG-TS");
      lost_ = true;
      return;
    }
    lost_ = false;
    const PacketHead head(packet);
    if (head.id == kTable) add_table(head);
    Stream& stream = streams_[head.id];
    stream.video |= head.starts_video();
    if (!stream.video || !head.has_data) return;
    if (head.marked) damage_.add(position, "a packet is marked as damaged");
    if (misses_some(head, stream)) damage_.add(position, "packets before it are missing");
    stream.counter = head.counter;
    stream.tables = tables_;
  }

  const DamagedParts& damage() const { return damage_; }

 private:
  // Lists of programs, which start a file and are repeated in it.
  struct Tables {
    std::int64_t first = 0;  // with the counter of one that starts a file
    std::int64_t jumps = 0;  // that do not follow the one before
  };
  struct Stream {
    bool video = false;
    int counter = -1;  // of the last packet
    Tables tables;     // before it
  };

  static bool is_first(int counter) { return counter <= 1; }

  void add_table(const PacketHead& head) {
    if (is_first(head.counter)) ++tables_.first;
    if (head.counter != (table_ + 1) % 16) ++tables_.jumps;
    table_ = head.counter;
  }

  // A packet may be repeated once. Where files were joined, all counters start again.
  bool misses_some(const PacketHead& head, const Stream& stream) const {
    if (stream.counter < 0 || head.restarts || head.counter == stream.counter) return false;
    const bool restarts = stream.tables.first != tables_.first && is_first(head.counter);
    if (head.starts && (restarts || stream.tables.jumps != tables_.jumps)) return false;
    return head.counter != (stream.counter + 1) % 16;
  }

  static constexpr std::uint64_t kTable = 0;
  std::map<std::uint64_t, Stream> streams_;
  Tables tables_;
  int table_ = -1;  // the counter of the last one
  bool lost_ = false;
  DamagedParts damage_;
};

}  // namespace

std::optional<Packets> packets_of(Bytes& bytes) {
  constexpr std::array kKinds{Packets{188, 0}, Packets{192, 4}, Packets{204, 0}};
  for (const Packets& kind : kKinds) {
    bool fits = bytes.size() >= 3 * kind.length;
    for (std::uint64_t i = 0; i < 3 && fits; ++i) {
      fits = bytes.at(kind.start + i * kind.length, 1) == std::string(1, kSync);
    }
    if (fits) return kind;
  }
  return std::nullopt;
}

std::string missing_of_transport_stream(Bytes& bytes, const Packets& kind) {
  if (bytes.size() % kind.length != 0) return "it ends within a packet";
  for (const auto& [id, packet] : last_packets(bytes, kind)) {
    if (packet.found >= packet.stated) continue;
    return lacks(packet.stated - packet.found, "the stream with PID " + std::to_string(id));
  }
  return "";
}

bool may_lack_end(Bytes& bytes, const Packets& kind) {
  const std::map<std::uint64_t, StreamPacket> streams = last_packets(bytes, kind);
  return std::any_of(streams.begin(), streams.end(), [](const auto& stream) {
    return stream.second.stated == 0 && !stream.second.padded;
  });
}

DamagedParts damage_of_transport_stream(Bytes& bytes, const Packets& kind) {
  constexpr std::uint64_t kAtOnce = 4096;  // packets
  Continuity continuity;
  // Where packets are cut, the next one is searched for.
  for (std::uint64_t from = kind.start; from < bytes.size();) {
    const std::string part = bytes.up_to(from, kAtOnce * kind.length);
    std::size_t at = 0;
    while (at + kPacket <= part.size()) {
      continuity.add(std::string_view(part).substr(at, kPacket), from + at);
      at += part[at] == kSync ? kind.length : 1;
    }
    if (at == 0) break;
    from += at;
  }
  return continuity.damage();
}

}  // namespace mtstereo::run
