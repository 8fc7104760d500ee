#pragma once
/// Layout of a tick datagram (PROTOCOL.md, "Tick lane") and the hash tree that ties its fragment to the signature.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/crypto.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

inline constexpr std::size_t max_fragments = 1024;
/// Length of a tick datagram without path and fragment.
inline constexpr std::size_t tick_header_bytes = 127;
/// Offset of the byte that marks a repetition.
inline constexpr std::size_t repetition_offset = 4;

/// The signed fields.
struct TickHeader {
  SessionId session{};
  std::uint64_t sequence = 0;
  std::uint64_t tick = 0;
  std::uint32_t payload_bytes = 0;
  std::uint16_t fragments = 0;
  std::uint16_t fragment_bytes = 0;
  Hash16 root{};

  bool operator==(const TickHeader&) const = default;
};

struct TickDatagram {
  bool repetition = false;
  TickHeader header;
  Signature signature{};
  std::uint16_t index = 0;
  std::array<Hash16, 10> path{};
  std::size_t path_length = 0;
  std::span<const std::byte> fragment;  ///< Part of the datagram that was read.
};

enum class TickDatagramFault : std::uint8_t { none, malformed, oversized };

/// Length of the path of fragment `index` of `fragments`.
std::size_t path_length(std::size_t index, std::size_t fragments);
/// Longest fragment with which a payload fits datagrams of `max_datagram_bytes`.
std::size_t choose_fragment_bytes(std::size_t payload_bytes, std::size_t max_datagram_bytes);

/// Reads without allocating; makes every check that needs no key.
TickDatagramFault read_tick_datagram(std::span<const std::byte> bytes, TickDatagram& out);
void write_tick_datagram(const TickDatagram& datagram, Bytes& out);

/// The text that is signed.
std::array<std::byte, 69> signed_text(const TickHeader& header);

/// All levels of the tree, leaves first; the last level holds the root.
std::vector<std::vector<Hash16>> build_tree(std::span<const std::span<const std::byte>> fragments);
Hash16 leaf_hash(std::uint16_t index, std::span<const std::byte> fragment);
/// Root that the datagram's fragment and path lead to.
Hash16 root_of(const TickDatagram& datagram);

}  // namespace septet::net
