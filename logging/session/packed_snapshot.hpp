#pragma once
/// Bytes of a snapshot in the session file: the wire's except for the participants, which are packed more tightly
/// (FORMAT.md, `snapshots`).
///
/// For 200 vehicles the wire needs 2.2 KB a tick, the file 0.75. Each field is coded as its difference to a prediction,
/// where the wire assumes uniform motion; position and orientation also assume the previous tick's prediction error,
/// since bends and rounding make that persist. The differences lie field by field, where most are 0 or ±1, and are
/// deflated (RFC 1951). Lossless to the last bit.
///
/// Packer and unpacker remember the last snapshot's prediction error: one of each per file, and its snapshots in their
/// order. A snapshot without a baseline needs no memory. One thread each. Bytes are untrusted: unpacking always ends in
/// a snapshot or an error.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/wire_snapshot.hpp"

namespace septet::logging {

/// A participant's prediction error, in steps of the wire: position, index and rest of the orientation.
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
  /// Reads bytes of either kind: packed, or the wire's, as stored by earlier builds. `baseline` is the snapshot that
  /// `read_stored_header` names, unpacked just before.
  Expected<WireSnapshot> unpack(std::span<const std::byte> bytes, const WireSnapshot* baseline);

 private:
  ExpectationErrors errors_;
  Bytes columns_;
};

/// From bytes of either kind.
Expected<SnapshotHeader> read_stored_header(std::span<const std::byte> bytes);

}  // namespace septet::logging
