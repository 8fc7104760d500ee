#pragma once
/// Rows of `scene_edits`: commands of one tick, packed together (FORMAT.md).
///
/// A world begins with a hundred thousand commands of mostly 30 to 300 bytes, whose likeness a row each would waste. Packer:
/// the writer's thread. A row's bytes are untrusted: unpacking ends in the commands or an error, in bounded memory.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "logging/session/edit_fingerprints.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// A row.
struct SceneRun {
  Tick tick = 0;
  Bytes data;
  /// EditFingerprints of its commands; empty for the world before any edit, and in a session of an earlier build.
  std::optional<Bytes> fingerprints{};
};

class SceneRunPacker {
 public:
  bool is_empty() const { return commands_.empty(); }
  /// A run holds one tick, and ends with the command that makes it large.
  bool has_room_for(const SceneEdit& edit) const;
  /// There is room for it.
  void add(const SceneEdit& edit);
  /// The run so far, at least one command; afterwards the packer is empty.
  SceneRun take();

 private:
  Tick tick_ = 0;
  Bytes commands_;
  EditFingerprints fingerprints_;
};

/// The commands of a session, from its rows in their order.
class SceneUnpacker {
 public:
  /// Rows of formats 1 and 2 hold one command each, as it is.
  explicit SceneUnpacker(int session_format) : session_format_(session_format) {}
  /// Appends the commands of `run`. Error: damaged bytes, more memory than a scene may take, or an edit that is not the one
  /// that was made, with its tick and node.
  Expected<void> unpack(const SceneRun& run, std::vector<SceneEdit>& out);

 private:
  Expected<void> append(Tick tick, std::span<const std::byte> command, std::vector<SceneEdit>& out);

  int session_format_;
  std::size_t held_bytes_ = 0;
};

}  // namespace septet::logging
