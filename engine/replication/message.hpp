#pragma once
/// The messages between a replication server and its clients (REPLICATION.md).

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/scene/node.hpp"

namespace septet::replication {

inline constexpr std::uint8_t message_version = 4;
inline constexpr std::size_t max_batch_bytes = 2u << 20;
/// Changes that a client's batch asks for: a batch is done whole between two ticks. So many take 8 to 12 ms with seven screens, which are told
/// of each, and 2.5 without (`./bench --benchmark_filter=edit_batch`); a model of the most parts has no more of what shows it.
inline constexpr std::size_t most_changes_of_batch = 4096;
/// Bytes by which the sizes that a client's batch sets let shapes grow (scene/growth.hpp): memory that is new costs 2 ms a MiB.
inline constexpr std::size_t most_grown_bytes_of_batch = 4u << 20;
/// Of a refusal: failures that are told, and bytes of the words and of the node's name of each.
inline constexpr std::size_t most_failures_told = 16, max_refusal_bytes = 1000, max_failed_name_bytes = 200;

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
  /// From a server: the next one belongs to it, so that a new node and its content are shown together or not yet.
  bool goes_on = false;
};
/// In the mask of a subscription to the index: with a type's bit, that of everything which the nodes of the type have, now and later.
constexpr std::uint32_t with_content(std::uint32_t node_types) { return node_types << 16; }
struct Complete {
  std::uint64_t revision = 0;
  std::uint64_t answered = 0;
};
struct Received {
  std::uint64_t sequence = 0;
};
/// A command that could not be done.
struct Failure {
  std::uint64_t index = 0;  ///< Its place in the batch, from 0.
  std::string node;         ///< Its node's name, or its number where it has no name; empty: the command has no node.
  std::string why;          ///< What is wrong, where, and what to do.
  bool operator==(const Failure&) const = default;
};
/// Why nothing of a batch was done.
struct Refusal {
  std::vector<Failure> failures;  ///< The first ones, in the batch's order; one at least, most_failures_told at most.
  std::uint64_t others = 0;       ///< Commands that could not be done either.
  bool operator==(const Refusal&) const = default;
};
/// Nothing of the client's batch was done.
struct Refused {
  std::uint64_t sequence = 0;  ///< Of the batch.
  Refusal refusal;
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
