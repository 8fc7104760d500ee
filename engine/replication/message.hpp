#pragma once
/// The messages between a replication server and its clients (REPLICATION.md).

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/scene/node.hpp"

namespace septet::replication {

inline constexpr std::uint8_t message_version = 2;
inline constexpr std::size_t max_batch_bytes = 2u << 20;
inline constexpr std::size_t max_refusal_bytes = 1000;  ///< Of its words.

struct Hello {
  std::uint64_t token = 0;
  std::uint64_t received = 0;
};
struct Welcome {
  std::uint64_t token = 0;
  bool resumed = false;
  std::uint64_t received = 0;
  /// The first of the ids that are this session's own (ids_per_session of them): the client names the nodes that it
  /// creates by them, so that one batch can create a node and fill it.
  scene::NodeId first_id = 0;
};
inline constexpr scene::NodeId ids_per_session = 1u << 16;
/// Numbered from 1 in each direction of a session.
struct CommandBatch {
  std::uint64_t sequence = 0;
  std::uint64_t received = 0;
  Bytes commands;  ///< Commands as encoded by command_codec.hpp, one after another; packed only on the wire.
  /// From a server: the first tick that shows them; 0: at once. From a client: the tick that is to show them first; 0, or one
  /// that is past: the next.
  std::uint64_t tick = 0;
};
struct Complete {
  std::uint64_t revision = 0;
  std::uint64_t answered = 0;
};
struct Received {
  std::uint64_t sequence = 0;
};
/// Nothing of the client's batch was done.
struct Refused {
  std::uint64_t sequence = 0;  ///< Of the batch.
  std::uint64_t index = 0;     ///< Of the command in it that could not be done, from 0.
  std::string why;             ///< What is wrong, where, and what to do.
};

/// The client's batch was done, whole.
struct Done {
  std::uint64_t sequence = 0;  ///< Of the batch.
  std::uint64_t tick = 0;      ///< The first that shows it.
};

/// Numbered as on the wire.
using Message = std::variant<Hello, Welcome, CommandBatch, Complete, Received, Refused, Done>;

Bytes encode(const Message& message);
Expected<Message> decode(std::span<const std::byte> bytes);

}  // namespace septet::replication
