#pragma once
/// A snapshot's bytes in the session file: those of the wire but for the participants, which are packed tighter (FORMAT.md, `snapshots`).
///
/// Of 200 vehicles the wire needs 2.2 KB a tick, the file 0.75. Each field's difference goes to what was expected, where the wire expects
/// even motion; position and orientation are expected to go wrong as much as they did a tick ago, for bends and rounding make that last.
/// The differences lie field by field, where most are 0 or ±1, and are deflated (RFC 1951). What is packed comes back to the last bit.
///
/// Packer and unpacker remember the last snapshot's error of expectation: one of each a file, and its snapshots in their order. A snapshot
/// without a baseline needs no memory. One thread each. Bytes come from outside: whatever they are, unpacking ends in a snapshot or an error.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/wire_snapshot.hpp"

namespace septet::logging {

/// How far a participant was from where it had been expected, in steps of the wire: position, index and rest of the orientation.
struct ExpectationError {
  static constexpr std::size_t fields = field_velocity_x - field_position_x;
  ParticipantId id = 0;
  std::array<std::int64_t, fields> steps{};
};
using ExpectationErrors = std::vector<ExpectationError>;  ///< Ascending id.

class SnapshotPacker {
 public:
  SnapshotPacker();
  SnapshotPacker(SnapshotPacker&&) noexcept;
  SnapshotPacker& operator=(SnapshotPacker&&) noexcept;
  ~SnapshotPacker();
  /// Appends the bytes of `wire`, as a difference to `baseline`, which was packed just before, or without one.
  void pack(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out);

 private:
  struct Deflate;
  std::unique_ptr<Deflate> deflate_;
  ExpectationErrors errors_;
  Bytes rest_, columns_, escapes_;
};

class SnapshotUnpacker {
 public:
  /// Takes bytes of either kind: packed, or as earlier builds kept them, those of the wire. `baseline` is the snapshot that
  /// `read_stored_header` names, unpacked just before.
  Expected<WireSnapshot> unpack(std::span<const std::byte> bytes, const WireSnapshot* baseline);

 private:
  ExpectationErrors errors_;
  Bytes columns_;
};

/// Of bytes of either kind.
Expected<SnapshotHeader> read_stored_header(std::span<const std::byte> bytes);

}  // namespace septet::logging
