#pragma once
/// Variants of a driven session: run again from a kept state, with the logged inputs and an operator's commands, but
/// for a change of the driver's inputs (input_change.hpp).
///
/// Traffic, scripts and lights answer the changed car, and everything random comes from the session's seed and kept
/// state, so that a variant is what would have followed from that change alone. The person who drove answers nothing:
/// his inputs are the logged ones. Before any variant runs, the logged inputs are, and each tick's state hash must be
/// the logged one.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/recorded_drive.hpp"
#include "sim-server/drive/what_if/input_change.hpp"
#include "sim-server/drive/what_if/variant_outcome.hpp"

namespace septet::server {

struct WhatIfOptions {
  double from_s = 0.0;    ///< Collisions before this simulated second are passed over.
  double seconds = 10.0;  ///< Simulated, from the first changed input on.
};

/// What all variants of a session share. Const while they run, on any number of threads.
struct WhatIf {
  RecordedDrive recorded;
  std::string where;    ///< The session, for errors.
  double from_s = 0.0;  ///< WhatIfOptions::from_s.
  logging::ParticipantNames names;
  std::optional<LoggedCollision> logged;  ///< The first collision from `from_s` on.
  Tick known_until = 0;                   ///< Its tick, else that of the last input.
  Tick begin = 0;                         ///< Of the kept state from which the logged inputs were run again.
  Tick fork = 0;                          ///< Last tick before the first changed input.
  Tick end = 0;                           ///< Last tick of a variant.
  Bytes fork_state;                       ///< The state there, as engine/simulation/saved_state.hpp keeps it.
  std::uint64_t begin_hash = 0;           ///< State hash at `begin`.
  std::uint64_t agreeing_ticks = 0;       ///< Ticks run again without a change; each has the logged hash.
  VariantOutcome as_logged;               ///< Of those ticks, from `fork` on.

  KnownInputs known() const { return {recorded.inputs, known_until}; }
};

/// Changes of one variant with their places in the log. Error: as place_change.
Expected<std::vector<PlacedChange>> place_changes(const WhatIf& what_if, std::span<const InputChange> changes);

/// Prepares the variants of a session. `extremes` are variants among which the earliest changed input of all variants
/// is. Error: the session cannot be run again (no inputs, snapshots or states, altered, of another build, moved by
/// another program), or a change has no place in it.
Expected<WhatIf> prepare_what_if(const logging::SessionReader& session,
                                 std::span<const std::vector<InputChange>> extremes, const WhatIfOptions& options);

/// Runs one variant to its first collision, else to the end, or the drive's own end.
Expected<VariantOutcome> run_variant(const WhatIf& what_if, std::span<const InputChange> changes);

/// Runs the drive of a car that goes by a table (engine/simulation/given_motion.hpp) from its start, with another table
/// within the given one's ±. Error: somebody drives in this session.
Expected<VariantOutcome> run_deviating(const WhatIf& what_if, const simulation::MotionDeviation& deviation);

}  // namespace septet::server
