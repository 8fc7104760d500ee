#include "engine/net/scene_frames.hpp"

#include <cmath>

namespace septet::net {
namespace {

void read_ranges(ByteReader& reader, PacketRanges& out) {
  std::uint64_t last = reader.get_varint();
  const std::size_t count = reader.get<std::uint8_t>();
  if (count == 0 || count > PacketRanges::limit) return reader.fail();
  for (out.count = 0; out.count < count;) {
    const std::uint64_t received = reader.get_varint();
    if (received == 0 || received - 1 > last) return reader.fail();
    const std::uint64_t first = last - (received - 1);
    out.ranges[out.count++] = {last, first};
    if (out.count == count) return;
    const std::uint64_t missing = reader.get_varint();
    if (missing == 0 || missing >= first) return reader.fail();
    last = first - missing - 1;
  }
}

void write_ranges(const PacketRanges& received, ByteWriter& writer) {
  writer.put_varint(received.ranges[0].last);
  writer.put(static_cast<std::uint8_t>(received.count));
  for (std::size_t i = 0; i < received.count; ++i) {
    const auto& range = received.ranges[i];
    writer.put_varint(range.last - range.first + 1);
    if (i + 1 < received.count) writer.put_varint(range.first - received.ranges[i + 1].last - 1);
  }
}

}  // namespace

bool read_frame(ByteReader& reader, Frame& out) {
  if (!reader.ok() || reader.at_end()) return false;
  const auto kind = reader.get<std::uint8_t>();
  out.kind = static_cast<FrameKind>(kind);
  switch (out.kind) {
    case FrameKind::acknowledge:
      read_ranges(reader, out.received);
      break;
    case FrameKind::fragment: {
      out.message = reader.get_varint();
      out.message_bytes = reader.get_varint();
      out.offset = reader.get_varint();
      out.bytes = reader.take(reader.get_count(reader.remaining()));
      if (out.offset > out.message_bytes || out.bytes.size() > out.message_bytes - out.offset) reader.fail();
      break;
    }
    case FrameKind::unreliable:
      out.bytes = reader.take(reader.get_count(reader.remaining()));
      break;
    case FrameKind::ping:
      out.sent_s = reader.get_double();
      break;
    case FrameKind::pong:
      out.sent_s = reader.get_double();
      out.answered_s = reader.get_double();
      if (!std::isfinite(out.answered_s)) reader.fail();
      break;
    case FrameKind::goodbye:
      out.bytes = reader.take(reader.get_count(max_goodbye_bytes));
      break;
    default:
      reader.fail();
  }
  return reader.ok();
}

void write_frame(const Frame& frame, ByteWriter& writer) {
  writer.put(static_cast<std::uint8_t>(frame.kind));
  switch (frame.kind) {
    case FrameKind::acknowledge:
      write_ranges(frame.received, writer);
      break;
    case FrameKind::fragment:
      writer.put_varint(frame.message);
      writer.put_varint(frame.message_bytes);
      writer.put_varint(frame.offset);
      [[fallthrough]];
    case FrameKind::unreliable:
    case FrameKind::goodbye:
      writer.put_varint(frame.bytes.size());
      writer.put_bytes(frame.bytes);
      break;
    case FrameKind::ping:
      writer.put(frame.sent_s);
      break;
    case FrameKind::pong:
      writer.put(frame.sent_s);
      writer.put(frame.answered_s);
      break;
  }
}

std::size_t varint_bytes(std::uint64_t value) {
  std::size_t bytes = 1;
  for (; value >= 0x80; value >>= 7) ++bytes;
  return bytes;
}

std::size_t fragment_overhead(std::uint64_t message, std::uint64_t message_bytes, std::uint64_t offset,
                              std::size_t length) {
  return 1 + varint_bytes(message) + varint_bytes(message_bytes) + varint_bytes(offset) + varint_bytes(length);
}

}  // namespace septet::net
