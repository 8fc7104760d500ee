#pragma once
/// Fingerprints of what a tick's edits do to each node: by them a reader finds the tick and node of an edit that was altered, where the
/// digest of the whole (session_digest.hpp) tells only that there is one. Like it, they protect against damage and slips,
/// not against forgery.

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/hash.hpp"
#include "engine/scene/node.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// The node that a command's bytes are about.
scene::NodeId edited_node(std::span<const std::byte> command);

/// Of one row of `scene_edits`, or a part of it.
class EditFingerprints {
 public:
  /// The row's next command.
  void add(Tick tick, std::span<const std::byte> command);
  bool is_empty() const { return nodes_.empty(); }
  /// By rising ids: the node's id as difference from the one before (varint), 32 bits of the hash (FORMAT.md).
  Bytes to_bytes() const;
  /// A node whose commands are not those that these bytes, of unknown origin, are of; no_node where the bytes are none. Empty: all
  /// agree.
  std::optional<scene::NodeId> altered_node(std::span<const std::byte> bytes) const;

 private:
  std::map<scene::NodeId, StateHash> nodes_;
};

}  // namespace septet::logging
