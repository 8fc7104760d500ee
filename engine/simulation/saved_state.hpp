#pragma once
/// The state of a drive at a tick as bytes, to continue from there without a trace: the same hashes, tick for tick.
///
/// The bytes are those of one build and one drive: they name the build's revision, and by a hash the texts and the seed
/// from which the model was made. Restoring refuses any other, and bytes that were cut off or changed, with one
/// message; they may come from anywhere. The driver and the driver's device are outside of the state and not saved.

#include <memory>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Raised whenever the meaning of the bytes changes within one revision's name, as in a working tree.
inline constexpr std::uint32_t saved_state_version = 22;
/// Limit on saving and restoring. A tunnel full of smoke takes a few megabytes.
inline constexpr std::size_t most_saved_bytes = std::size_t{64} << 20;

/// Error: traffic moved by another program, or more than most_saved_bytes.
Expected<Bytes> save_state(const Model& model, const State& state);

/// Restores a state. `traffic` is an engine as it was made for the drive, and becomes part of the state. `where` names
/// the bytes in errors.
Expected<State> restore_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                              std::span<const std::byte> bytes, std::string_view where);

/// Restores without comparing the state hash in the bytes, which a forger could also write. For tests of the other
/// checks.
Expected<State> restore_altered_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                                      std::span<const std::byte> bytes, std::string_view where);

}  // namespace septet::simulation
