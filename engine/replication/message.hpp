#pragma once
/// The messages between a replication server and its clients (REPLICATION.md).

#include <cstdint>
#include <span>
#include <variant>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"

namespace septet::replication {

inline constexpr std::uint8_t message_version = 1;
inline constexpr std::size_t max_batch_bytes = 2u << 20;

struct Hello {
  std::uint64_t token = 0;
  std::uint64_t received = 0;
};
struct Welcome {
  std::uint64_t token = 0;
  bool resumed = false;
  std::uint64_t received = 0;
};
/// Numbered from 1 in each direction of a session.
struct CommandBatch {
  std::uint64_t sequence = 0;
  std::uint64_t received = 0;
  Bytes commands;  ///< Commands as encoded by command_codec.hpp, one after another; packed only on the wire.
};
struct Complete {
  std::uint64_t revision = 0;
  std::uint64_t answered = 0;
};
struct Received {
  std::uint64_t sequence = 0;
};

/// Numbered as on the wire.
using Message = std::variant<Hello, Welcome, CommandBatch, Complete, Received>;

Bytes encode(const Message& message);
Expected<Message> decode(std::span<const std::byte> bytes);

}  // namespace septet::replication
