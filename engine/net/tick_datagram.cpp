#include "engine/net/tick_datagram.hpp"

#include <algorithm>
#include <cstring>

#include "engine/core/check.hpp"
#include "engine/net/tick_publisher.hpp"

namespace septet::net {
namespace {

constexpr std::uint32_t magic = 0x31545053;  // "SPT1"
constexpr std::string_view domain = "septet tick 1";
constexpr std::size_t signed_header_bytes = 56;

template <std::size_t N>
void put_array(ByteWriter& writer, const std::array<std::uint8_t, N>& array) {
  writer.put_bytes(as_bytes_of(array));
}

template <std::size_t N>
void get_array(ByteReader& reader, std::array<std::uint8_t, N>& array) {
  const auto bytes = reader.take(N);
  if (!bytes.empty()) std::memcpy(array.data(), bytes.data(), N);
}

void put_header(ByteWriter& writer, const TickHeader& header) {
  put_array(writer, header.session);
  writer.put(header.sequence);
  writer.put(header.tick);
  writer.put(header.payload_bytes);
  writer.put(header.fragments);
  writer.put(header.fragment_bytes);
  put_array(writer, header.root);
}

Hash16 node_hash(const Hash16& left, const Hash16& right) {
  static constexpr std::byte tag[] = {std::byte{1}};
  return hash16({tag, as_bytes_of(left), as_bytes_of(right)});
}

std::size_t fragment_count(std::size_t payload_bytes, std::size_t fragment_bytes) {
  return std::max<std::size_t>(1, (payload_bytes + fragment_bytes - 1) / fragment_bytes);
}

std::size_t levels_above_leaves(std::size_t fragments) {
  std::size_t levels = 0;
  while (fragments > 1) {
    fragments = (fragments + 1) / 2;
    ++levels;
  }
  return levels;
}

}  // namespace

std::size_t path_length(std::size_t index, std::size_t fragments) {
  std::size_t length = 0;
  for (; fragments > 1; index /= 2, fragments = (fragments + 1) / 2)
    if ((index ^ 1) < fragments) ++length;
  return length;
}

std::size_t choose_fragment_bytes(std::size_t payload_bytes, std::size_t max_datagram_bytes) {
  for (std::size_t levels = 0; levels <= 10; ++levels) {
    const std::size_t overhead = tick_header_bytes + levels * sizeof(Hash16);
    SEPTET_CHECK(overhead < max_datagram_bytes, "datagram limit of {} bytes", max_datagram_bytes);
    const std::size_t room = std::min<std::size_t>(max_datagram_bytes - overhead, 65535);
    if (levels_above_leaves(fragment_count(payload_bytes, room)) <= levels) return room;
  }
  SEPTET_CHECK(false, "{} bytes in datagrams of {}", payload_bytes, max_datagram_bytes);
}

TickDatagramFault read_tick_datagram(std::span<const std::byte> bytes, TickDatagram& out) {
  ByteReader reader(bytes);
  const bool ours = reader.get<std::uint32_t>() == magic;
  const auto repetition = reader.get<std::uint8_t>();
  TickHeader& header = out.header;
  get_array(reader, header.session);
  header.sequence = reader.get<std::uint64_t>();
  header.tick = reader.get<std::uint64_t>();
  header.payload_bytes = reader.get<std::uint32_t>();
  header.fragments = reader.get<std::uint16_t>();
  header.fragment_bytes = reader.get<std::uint16_t>();
  get_array(reader, header.root);
  get_array(reader, out.signature);
  out.index = reader.get<std::uint16_t>();
  if (!reader.ok() || !ours || repetition > 1) return TickDatagramFault::malformed;
  out.repetition = repetition == 1;

  if (header.payload_bytes > max_tick_bytes || header.fragments > max_fragments) return TickDatagramFault::oversized;
  if (header.sequence == 0 || header.fragment_bytes == 0 || out.index >= header.fragments ||
      header.fragments != fragment_count(header.payload_bytes, header.fragment_bytes))
    return TickDatagramFault::malformed;
  out.path_length = path_length(out.index, header.fragments);
  for (std::size_t i = 0; i < out.path_length; ++i) get_array(reader, out.path[i]);
  const std::size_t offset = std::size_t{out.index} * header.fragment_bytes;
  const std::size_t length = std::min<std::size_t>(header.fragment_bytes, header.payload_bytes - offset);
  out.fragment = reader.take(length);
  return reader.ok() && reader.at_end() ? TickDatagramFault::none : TickDatagramFault::malformed;
}

void write_tick_datagram(const TickDatagram& datagram, Bytes& out) {
  ByteWriter writer(out);
  writer.put(magic);
  writer.put(static_cast<std::uint8_t>(datagram.repetition));
  put_header(writer, datagram.header);
  put_array(writer, datagram.signature);
  writer.put(datagram.index);
  for (std::size_t i = 0; i < datagram.path_length; ++i) put_array(writer, datagram.path[i]);
  writer.put_bytes(datagram.fragment);
}

std::array<std::byte, 69> signed_text(const TickHeader& header) {
  static_assert(domain.size() + signed_header_bytes == 69);
  Bytes bytes;
  bytes.reserve(69);
  ByteWriter writer(bytes);
  writer.put_bytes(std::as_bytes(std::span(domain)));
  put_header(writer, header);
  std::array<std::byte, 69> text;
  std::copy(bytes.begin(), bytes.end(), text.begin());
  return text;
}

Hash16 leaf_hash(std::uint16_t index, std::span<const std::byte> fragment) {
  const std::byte tag[] = {std::byte{0}, static_cast<std::byte>(index & 0xff), static_cast<std::byte>(index >> 8)};
  return hash16({tag, fragment});
}

std::vector<std::vector<Hash16>> build_tree(std::span<const std::span<const std::byte>> fragments) {
  std::vector<std::vector<Hash16>> levels(1);
  for (std::size_t i = 0; i < fragments.size(); ++i)
    levels[0].push_back(leaf_hash(static_cast<std::uint16_t>(i), fragments[i]));
  while (levels.back().size() > 1) {
    const std::vector<Hash16>& below = levels.back();
    std::vector<Hash16> level;
    for (std::size_t i = 0; i < below.size(); i += 2)
      level.push_back(i + 1 < below.size() ? node_hash(below[i], below[i + 1]) : below[i]);
    levels.push_back(std::move(level));
  }
  return levels;
}

Hash16 root_of(const TickDatagram& datagram) {
  Hash16 hash = leaf_hash(datagram.index, datagram.fragment);
  std::size_t index = datagram.index, used = 0;
  for (std::size_t count = datagram.header.fragments; count > 1; index /= 2, count = (count + 1) / 2) {
    if ((index ^ 1) >= count) continue;
    const Hash16& sibling = datagram.path[used++];
    hash = index % 2 == 0 ? node_hash(hash, sibling) : node_hash(sibling, hash);
  }
  return hash;
}

}  // namespace septet::net
