#pragma once
/// Commands to bytes and back, as specified in COMMANDS.md.
///
/// The decoder trusts no input: it is bounded in time and memory (COMMANDS.md), refuses values out of range, not finite
/// or over a limit, and trailing bytes, and never stops the program. Vertices, polygons or reals that all lie on a grid
/// of 2^-k are sent as small integers, so meshes snapped to a grid are about a third of the size.

#include <cstddef>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/command_limits.hpp"

namespace septet::scene {

/// Appends one command.
void encode(const Command& command, Bytes& out);

/// Reads one command; on bad bytes the reader is in its failed state and the error gives the reason.
Expected<Command> decode(ByteReader& in);

/// The one command that fills `bytes` exactly.
Expected<Command> decode(std::span<const std::byte> bytes);

}  // namespace septet::scene
