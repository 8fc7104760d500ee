#pragma once
/// The state of a drive at a tick as bytes, to go on from there as if nothing had been: the same hashes, tick for tick.
///
/// The bytes are those of one build and one drive: they name the build's revision, and by a hash the texts and the seed that the model
/// was made from. Restoring refuses any other, and bytes that were cut off or changed, with one message; they may come from anywhere.
/// What is outside of the state is not in them: the driver and the device that he holds.

#include <memory>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Changes whenever the meaning of the bytes does within a revision's name, as in a tree that is being worked on.
inline constexpr std::uint32_t saved_state_version = 5;
/// No larger state is saved or restored. A tunnel full of smoke takes a few megabytes.
inline constexpr std::size_t most_saved_bytes = std::size_t{64} << 20;

/// Error: traffic that another program moves, or more than most_saved_bytes.
Expected<Bytes> save_state(const Model& model, const State& state);

/// `traffic` is an engine as it was made for the drive, and becomes part of the state. `where` names the bytes in errors.
Expected<State> restore_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                              std::span<const std::byte> bytes, std::string_view where);

/// The same, whatever state hash the bytes tell: who alters them can tell the right one too. For tests of what else refuses them.
Expected<State> restore_altered_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                                      std::span<const std::byte> bytes, std::string_view where);

}  // namespace septet::simulation
