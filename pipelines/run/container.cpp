// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/container.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "outputs/printable.hpp"

namespace mtstereo::run {

namespace fs = std::filesystem;

namespace {

/// A file of which parts are read.
class Bytes {
 public:
  explicit Bytes(const fs::path& file) : stream_(file, std::ios::binary) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    size_ = error || !stream_ ? 0 : size;
  }

  std::uint64_t size() const { return size_; }

  /// Exactly so many bytes; empty if there are not so many.
  std::string at(std::uint64_t position, std::size_t count) {
    if (position > size_ || count > size_ - position) return {};
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(position));
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    return stream_ ? bytes : std::string();
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char each : bytes) value = value << 8 | static_cast<unsigned char>(each);
  return value;
}

std::string lacks(std::uint64_t bytes, const std::string& part) {
  return std::to_string(bytes) + " bytes of " + part + " are missing";
}

// A part that starts at `start`, states that it has `length` bytes, and is in a file of `size`.
bool exceeds(std::uint64_t start, std::uint64_t length, std::uint64_t size) {
  return length > size - std::min(start, size);
}

// MP4 and QuickTime: a sequence of boxes with length and name.
std::string missing_of_mp4(Bytes& bytes) {
  bool has_index = false;
  for (std::uint64_t start = 0; start < bytes.size();) {
    const std::string head = bytes.at(start, 8);
    if (head.empty()) return "it ends within the header of a box";
    const std::string name = head.substr(4);
    has_index |= name == "moov";
    std::uint64_t length = big_endian(head.substr(0, 4));
    if (length == 0) break;  // to the end of the file
    if (length == 1) {
      const std::string large = bytes.at(start + 8, 8);
      if (large.empty()) return "it ends within the header of a box";
      length = big_endian(large);
    }
    if (length < 8) return "it has a box with an impossible length";
    if (exceeds(start, length, bytes.size())) {
      return lacks(length - (bytes.size() - start), "its box '" + outputs::printable(name) + "'");
    }
    start += length;
  }
  return has_index ? "" : "its index (box 'moov') is missing: the recorder has not closed it";
}

// A number of Matroska, whose first byte states its length. Names keep the mark of the length.
struct Number {
  std::uint64_t value = 0;
  std::size_t length = 0;
};

std::optional<Number> number_at(Bytes& bytes, std::uint64_t position, bool is_name) {
  const std::string first = bytes.at(position, 1);
  if (first.empty()) return std::nullopt;
  const auto head = static_cast<unsigned char>(first[0]);
  const auto length = static_cast<std::size_t>(std::countl_zero(head)) + 1;
  const std::string all = bytes.at(position, length);
  if (length > 8 || all.empty()) return std::nullopt;
  const std::uint64_t whole = big_endian(all);
  const std::uint64_t bits = (std::uint64_t{1} << (7 * length)) - 1;
  if (is_name) return Number{whole, length};
  const bool unknown = (whole & bits) == bits;
  return Number{unknown ? std::numeric_limits<std::uint64_t>::max() : whole & bits, length};
}

// Matroska and WebM: nested elements with name and length. Segments, and clusters of unknown
// length, are entered; others are skipped.
std::string missing_of_matroska(Bytes& bytes) {
  constexpr std::uint64_t kSegment = 0x18538067;
  constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  for (std::uint64_t start = 0; start < bytes.size();) {
    if (bytes.at(start, 1) == std::string(1, '\0')) break;  // what follows is not of the container
    const std::optional<Number> name = number_at(bytes, start, true);
    const std::optional<Number> length =
        name ? number_at(bytes, start + name->length, false) : std::nullopt;
    if (!length) return "it ends within the header of an element";
    const std::uint64_t data = start + name->length + length->length;
    if (length->value != kUnknown && exceeds(data, length->value, bytes.size())) {
      return lacks(length->value - (bytes.size() - std::min(data, bytes.size())),
                   name->value == kSegment ? "its segment" : "an element");
    }
    const bool enter = name->value == kSegment || length->value == kUnknown;
    start = enter ? data : data + length->value;
  }
  return "";
}

std::string missing_of_avi(Bytes& bytes) {
  for (std::uint64_t start = 0; start + 8 <= bytes.size();) {
    std::string head = bytes.at(start + 4, 4);
    if (bytes.at(start, 4) != "RIFF") break;  // what follows is not of the container
    std::reverse(head.begin(), head.end());
    const std::uint64_t length = big_endian(head);
    if (exceeds(start + 8, length, bytes.size())) {
      return lacks(length - (bytes.size() - start - 8), "its RIFF chunk");
    }
    start += 8 + length + length % 2;
  }
  return "";
}

// The length of the packets of MPEG-TS, and where the first one starts.
struct Packets {
  std::uint64_t length = 0, start = 0;
};

std::optional<Packets> packets_of(Bytes& bytes) {
  constexpr char kSync = 0x47;
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
  constexpr std::uint64_t kPidMask = 0x1fff, kHead = 6;  // [bytes] before what a PES counts
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
  constexpr std::size_t kPacket = 188;
  const std::uint64_t count = bytes.size() / kind.length;
  const std::uint64_t first = count - std::min(count, kTail / kind.length);
  const std::string tail = bytes.at(first * kind.length, (count - first) * kind.length);
  std::map<std::uint64_t, StreamPacket> streams;
  for (std::size_t at = kind.start; at + kPacket <= tail.size(); at += kind.length) {
    add_packet(std::string_view(tail).substr(at, kPacket), streams);
  }
  return streams;
}

std::string missing_of_transport_stream(Bytes& bytes, const Packets& kind) {
  if (bytes.size() % kind.length != 0) return "it ends within a packet";
  for (const auto& [id, packet] : last_packets(bytes, kind)) {
    if (packet.found >= packet.stated) continue;
    return lacks(packet.stated - packet.found, "the stream with PID " + std::to_string(id));
  }
  return "";
}

}  // namespace

bool is_avi(const fs::path& file) { return Bytes(file).at(0, 4) == "RIFF"; }

bool is_matroska(const fs::path& file) { return Bytes(file).at(0, 4) == "\x1a\x45\xdf\xa3"; }

bool may_lack_end(const fs::path& file) {
  Bytes bytes(file);
  const std::optional<Packets> kind = packets_of(bytes);
  if (!kind) return false;
  const std::map<std::uint64_t, StreamPacket> streams = last_packets(bytes, *kind);
  return std::any_of(streams.begin(), streams.end(), [](const auto& stream) {
    return stream.second.stated == 0 && !stream.second.padded;
  });
}

std::string missing_end(const fs::path& file) {
  Bytes bytes(file);
  if (const std::optional<Packets> packets = packets_of(bytes)) {
    return missing_of_transport_stream(bytes, *packets);
  }
  if (bytes.at(0, 4) == "\x1a\x45\xdf\xa3") return missing_of_matroska(bytes);
  if (bytes.at(0, 4) == "RIFF") return missing_of_avi(bytes);
  const std::string box = bytes.at(4, 4);
  for (const char* name : {"ftyp", "moov", "mdat", "wide", "free", "skip"}) {
    if (box == name) return missing_of_mp4(bytes);
  }
  return "";
}

}  // namespace mtstereo::run
