#include "engine/replication/message.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <zstd.h>

namespace septet::replication {
namespace {

constexpr int packing_level = 1;
constexpr std::size_t worth_packing = 200;

enum Packing : std::uint8_t { plain, zstd };

void put_commands(ByteWriter& out, const Bytes& commands) {
  if (commands.size() >= worth_packing) {
    Bytes packed(ZSTD_compressBound(commands.size()));
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), commands.data(), commands.size(), packing_level);
    if (!ZSTD_isError(size) && size < commands.size()) {
      out.put(static_cast<std::uint8_t>(zstd));
      out.put_varint(commands.size());
      out.put_bytes(std::span(packed).first(size));
      return;
    }
  }
  out.put(static_cast<std::uint8_t>(plain));
  out.put_bytes(commands);
}

Bytes get_commands(ByteReader& in) {
  const auto packing = in.get<std::uint8_t>();
  if (packing > zstd) in.fail();
  const std::size_t raw_size = packing == zstd ? in.get_count(max_batch_bytes) : in.remaining();
  const auto bytes = in.take(in.remaining());
  if (!in.ok() || raw_size > max_batch_bytes) return in.fail(), Bytes{};
  if (packing == plain) return {bytes.begin(), bytes.end()};
  Bytes commands(raw_size);
  // The sender's stated size bounds the output; anything but exactly that many bytes is refused.
  if (ZSTD_decompress(commands.data(), commands.size(), bytes.data(), bytes.size()) != raw_size)
    return in.fail(), Bytes{};
  return commands;
}

std::string_view beginning(const std::string& text, std::size_t bytes) {
  return std::string_view(text).substr(0, bytes);
}

Refusal get_refusal(ByteReader& in) {
  Refusal refusal;
  refusal.others = in.get_varint();
  const std::size_t told = in.get_count(most_failures_told);
  if (told == 0) in.fail();
  refusal.failures.reserve(told);
  for (std::size_t i = 0; i < told && in.ok(); ++i) {
    Failure failed;
    failed.index = in.get_varint(), failed.node = in.get_string(max_failed_name_bytes);
    failed.why = in.get_string(max_refusal_bytes);
    refusal.failures.push_back(std::move(failed));
  }
  return refusal;
}

struct Put {
  ByteWriter& out;
  void operator()(const Hello& m) const { out.put(m.token), out.put_varint(m.received); }
  void operator()(const Welcome& m) const {
    out.put(m.token), out.put(static_cast<std::uint8_t>(m.resumed)), out.put_varint(m.received),
        out.put_varint(m.first_id);
  }
  void operator()(const CommandBatch& m) const {
    out.put_varint(m.sequence), out.put_varint(m.received), out.put_varint(m.tick);
    out.put(static_cast<std::uint8_t>(m.goes_on)), put_commands(out, m.commands);
  }
  void operator()(const Complete& m) const { out.put_varint(m.revision), out.put_varint(m.answered); }
  void operator()(const Received& m) const { out.put_varint(m.sequence); }
  void operator()(const Refused& m) const {
    const std::size_t told = std::min(m.refusal.failures.size(), most_failures_told);
    out.put_varint(m.sequence), out.put_varint(m.refusal.others + (m.refusal.failures.size() - told));
    out.put_varint(told);
    for (const Failure& failed : std::span(m.refusal.failures).first(told))
      out.put_varint(failed.index), out.put_string(beginning(failed.node, max_failed_name_bytes)),
          out.put_string(beginning(failed.why, max_refusal_bytes));
  }
  void operator()(const Done& m) const { out.put_varint(m.sequence), out.put_varint(m.tick); }
};

Message get(ByteReader& in, std::uint8_t kind) {
  switch (kind) {
    case 0: {
      Hello m;
      m.token = in.get<std::uint64_t>(), m.received = in.get_varint();
      return m;
    }
    case 1: {
      Welcome m;
      m.token = in.get<std::uint64_t>();
      const auto resumed = in.get<std::uint8_t>();
      if (resumed > 1) in.fail();
      m.resumed = resumed == 1, m.received = in.get_varint();
      const std::uint64_t first_id = in.get_varint();
      if (first_id > std::numeric_limits<scene::NodeId>::max() - ids_per_session) in.fail();
      m.first_id = static_cast<scene::NodeId>(first_id);
      return m;
    }
    case 2: {
      CommandBatch m;
      m.sequence = in.get_varint(), m.received = in.get_varint(), m.tick = in.get_varint();
      const auto goes_on = in.get<std::uint8_t>();
      if (goes_on > 1) in.fail();
      m.goes_on = goes_on == 1;
      m.commands = get_commands(in);
      return m;
    }
    case 3: {
      Complete m;
      m.revision = in.get_varint(), m.answered = in.get_varint();
      return m;
    }
    case 4:
      return Received{in.get_varint()};
    case 5: {
      Refused m;
      m.sequence = in.get_varint(), m.refusal = get_refusal(in);
      return m;
    }
    case 6: {
      Done m;
      m.sequence = in.get_varint(), m.tick = in.get_varint();
      return m;
    }
    default:
      in.fail();
      return Hello{};
  }
}

}  // namespace

Bytes encode(const Message& message) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(message_version);
  out.put(static_cast<std::uint8_t>(message.index()));
  std::visit(Put{out}, message);
  return bytes;
}

Expected<Message> decode(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  const auto version = in.get<std::uint8_t>();
  if (!in.ok() || version != message_version)
    return failure(fmt::format("replication speaks version {} and not {}", version, message_version),
                   "replication message", "run the same release of Septet on both ends");
  Message message = get(in, in.get<std::uint8_t>());
  if (!in.ok() || !in.at_end())
    return failure("the bytes are none of a message", "replication message", "see REPLICATION.md for the format");
  return message;
}

}  // namespace septet::replication
