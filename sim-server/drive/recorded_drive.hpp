#pragma once
/// A driven session as what it takes to run it again: its model, the driver's inputs, an operator's commands.

#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/state.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/drive_loader.hpp"

namespace septet::server {

/// An operator's change during the drive.
struct LoggedCommand {
  Tick before = 0;  ///< First tick that it affects.
  simulation::OperatorCommand command;
};

struct RecordedDrive {
  LoadedDrive loaded;
  std::string traffic = "own";               ///< Engine of its traffic (traffic_choice.hpp).
  std::vector<logging::InputRecord> inputs;  ///< Ascending ticks; at least one.
  std::vector<LoggedCommand> commands;       ///< In their order.
  /// True if the inputs are the driven ones, by the hash at the log's end; empty if the log was not closed.
  std::optional<bool> inputs_are_original;
};

/// Error: a session without driver inputs, or one that was altered.
Expected<RecordedDrive> read_recorded_drive(const logging::SessionReader& session);

/// Does the commands that come before the state's next tick, from `next` on, which is moved past them. Events are
/// appended. Error: one cannot be done again; `where` is the session.
Expected<void> repeat_commands(const RecordedDrive& recorded, const std::string& where, std::size_t& next,
                               simulation::State& state, std::vector<simulation::Event>& events);

/// Index of the first command that affects a tick after this one.
std::size_t first_command_after(const RecordedDrive& recorded, Tick tick);

/// Cause of a tick's wrong hash, as far as the log tells.
std::string cause_of_other_hash(const logging::SessionInfo& info, bool input_is_altered);

}  // namespace septet::server
