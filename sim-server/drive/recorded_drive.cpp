#include "sim-server/drive/recorded_drive.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/core/hash.hpp"
#include "engine/core/version.hpp"
#include "logging/session/input_hash.hpp"
#include "logging/session/outcome.hpp"

namespace septet::server {
namespace {

constexpr auto use_unaltered = "use an unaltered copy";

Expected<std::optional<bool>> are_original(const logging::SessionReader& session,
                                           const std::vector<logging::InputRecord>& inputs) {
  const auto row = session.info().other.find("outcome");
  if (row == session.info().other.end()) return std::optional<bool>();
  const auto outcome = logging::read_outcome(row->second, session.path().string());
  if (!outcome) return tl::unexpected(outcome.error());
  StateHash hash;
  for (const auto& input : inputs) logging::add_to_hash(input, hash);
  return std::optional(hash.value() == outcome->inputs_hash);
}

Expected<std::vector<LoggedCommand>> commands_of(const logging::SessionReader& session) {
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  std::vector<LoggedCommand> commands;
  for (const auto& event : *events) {
    if (event.kind != logging::operator_command_kind) continue;
    auto command = simulation::parse_operator_command(event.detail);
    if (!command)
      return failure(
          fmt::format("an operator's command before tick {} cannot be read: {}", event.tick, describe(command.error())),
          session.path().string(), use_unaltered);
    commands.push_back({event.tick, std::move(*command)});
  }
  return commands;
}

}  // namespace

Expected<RecordedDrive> read_recorded_drive(const logging::SessionReader& session) {
  RecordedDrive recorded;
  auto inputs = session.inputs();
  if (!inputs) return tl::unexpected(inputs.error());
  if (inputs->empty())
    return failure("the session holds no driver inputs: there is nothing to run again", session.path().string(),
                   "give a session that was driven");
  recorded.inputs = std::move(*inputs);
  auto original = are_original(session, recorded.inputs);
  if (!original) return tl::unexpected(original.error());
  recorded.inputs_are_original = *original;
  auto loaded = load_drive(session.info(), session.path().string());
  if (!loaded) return tl::unexpected(loaded.error());
  recorded.loaded = std::move(*loaded);
  const auto& other = session.info().other;
  if (const auto engine = other.find("traffic"); engine != other.end()) recorded.traffic = engine->second;
  auto commands = commands_of(session);
  if (!commands) return tl::unexpected(commands.error());
  recorded.commands = std::move(*commands);
  return recorded;
}

std::size_t first_command_after(const RecordedDrive& recorded, Tick tick) {
  const auto found = std::ranges::upper_bound(recorded.commands, tick, {}, &LoggedCommand::before);
  return static_cast<std::size_t>(found - recorded.commands.begin());
}

Expected<void> repeat_commands(const RecordedDrive& recorded, const std::string& where, std::size_t& next,
                               simulation::State& state, std::vector<simulation::Event>& events) {
  for (; next < recorded.commands.size() && recorded.commands[next].before <= state.tick + 1; ++next) {
    const LoggedCommand& command = recorded.commands[next];
    if (auto done = simulation::apply_operator_command(*recorded.loaded.model, command.command, state, events); !done)
      return failure(fmt::format("the operator's command before tick {} cannot be done again: {}", command.before,
                                 describe(done.error())),
                     where, use_unaltered);
  }
  return {};
}

std::string cause_of_other_hash(const logging::SessionInfo& info, bool input_is_altered) {
  if (input_is_altered) return "the session's driver inputs are not those that were driven with: use an unaltered copy";
  const auto compiler = info.other.find("compiler");
  if (info.git_revision != revision || info.septet_version != version ||
      (compiler != info.other.end() && compiler->second != __VERSION__))
    return fmt::format("it was recorded by another build, Septet {} at {}; this is {} at {}: verify it with that one",
                       info.septet_version, info.git_revision.empty() ? "an unknown revision" : info.git_revision,
                       version, revision);
  return "inputs and build are those of the recording: its hashes or files were altered, this tree was changed since "
         "its revision, or the "
         "processor's arithmetic differs";
}

}  // namespace septet::server
