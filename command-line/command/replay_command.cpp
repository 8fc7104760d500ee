#include "command-line/command/replay_command.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "engine/simulation/server_step.hpp"
#include "logging/session/session_digest.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/recorded_drive.hpp"
#include "sim-server/drive/traffic_choice.hpp"

namespace septet::server {
namespace {

tl::unexpected<Error> refused(const std::filesystem::path& file, const std::string& what, const std::string& remedy) {
  return failure(what, file.string(), remedy);
}

/// True if the log's controls at the tick of its inputs differ from the inputs' present content.
bool is_altered(const DriverInput& input, const DriverCar& car) {
  const auto differ = [](double a, double b) { return std::abs(a - b) > 1e-6; };
  return differ(input.steering_wheel_rad, car.steering_wheel_rad) || differ(input.accelerator, car.accelerator) ||
         differ(input.brake, car.brake) || differ(input.clutch, car.clutch);
}

struct Verified {
  Tick first = 0;             ///< First tick verified.
  std::uint64_t ticks = 0;    ///< Run again.
  bool goes_on = false;       ///< The drive is still being written.
  bool scene_agrees = false;  ///< False: unknown, the session has no digest.
};

/// True if the session has grown since it was read up to this tick.
Expected<bool> has_grown(const std::filesystem::path& file, Tick last_input) {
  const auto now = logging::SessionReader::open(file);
  if (!now) return tl::unexpected(now.error());
  const auto later = now->inputs({.first = last_input + 1});
  if (!later) return tl::unexpected(later.error());
  return !later->empty();
}

/// Number of ticks run again that agree. Ticks without both input and snapshot prove nothing and are not counted; a
/// missing one in between is the verdict.
Expected<Verified> verify(const std::filesystem::path& file, double from_s) {
  const auto session = logging::SessionReader::open(file);
  if (!session) return tl::unexpected(session.error());
  const auto shown = session->shown_span_s();
  if (!shown) return tl::unexpected(shown.error());
  const auto recorded_drive = read_recorded_drive(*session);
  if (!recorded_drive) return tl::unexpected(recorded_drive.error());
  const auto& model = *recorded_drive->loaded.model;
  const auto& inputs = recorded_drive->inputs;
  const std::optional<bool> original = recorded_drive->inputs_are_original;
  auto traffic = open_traffic(recorded_drive->traffic, model);
  if (!traffic) return tl::unexpected(traffic.error());
  // A drive that began at a kept state is run again from there.
  auto state = kept_state(*session, model, std::max(from_s, shown->first), std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  const auto scene = logging::is_scene_as_driven(*session);
  if (!scene) return tl::unexpected(scene.error());
  if (const auto commands = logging::are_commands_as_driven(*session); !commands)
    return tl::unexpected(commands.error());
  Verified verified{.first = state->tick, .scene_agrees = scene->has_value()};
  auto recorded = state->tick == 0 ? session->snapshots() : session->snapshots_from(state->time_s());
  if (!recorded) return tl::unexpected(recorded.error());

  const auto gap = [&](const char* what) {
    return refused(file, fmt::format("the {} of tick {} is missing: the log has a gap", what, state->tick),
                   "only what lies before a gap can be run again");
  };
  DriverInput input = state->input;
  /// True if there is a snapshot of the state's tick, with this hash.
  const auto compare = [&](std::uint64_t hash) -> Expected<bool> {
    const auto snapshot = recorded->next();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) return false;
    if ((*snapshot)->tick != state->tick) return gap("snapshot");
    if ((*snapshot)->state_hash == hash) return true;
    return refused(
        file,
        fmt::format("tick {} gives state hash {:016x}, recorded is {:016x}", state->tick, hash,
                    (*snapshot)->state_hash),
        cause_of_other_hash(session->info(),
                            original ? !*original : state->tick > 0 && is_altered(input, (*snapshot)->driver_car)));
  };
  const auto first = compare(simulation::hash_state(*state));
  if (!first) return tl::unexpected(first.error());
  if (!*first)
    return refused(file, "the session holds no snapshots: there is nothing to compare with",
                   "give a session that was driven");
  std::vector<simulation::Event> events;
  std::size_t command = first_command_after(*recorded_drive, verified.first);
  for (const auto& next : inputs) {
    if (next.tick <= verified.first) continue;
    input = next.input;
    events.clear();
    if (auto done = repeat_commands(*recorded_drive, file.string(), command, *state, events); !done)
      return tl::unexpected(done.error());
    const Snapshot snapshot = simulation::server_step(model, input, *state, events);
    if (auto error = state->traffic->take_error()) return tl::unexpected(std::move(*error));
    if (next.tick != state->tick) return gap("driver input");
    const auto agrees = compare(snapshot.state_hash);
    if (!agrees) return tl::unexpected(agrees.error());
    if (!*agrees) break;  // The log was cut off between an input and its snapshot.
    ++verified.ticks;
  }
  if (!session->ended_cleanly() && state->tick >= inputs.back().tick) {
    const auto grown = has_grown(file, inputs.back().tick);
    if (!grown) return tl::unexpected(grown.error());
    verified.goes_on = *grown;
  }
  const auto more = recorded->next();
  if (!more) return tl::unexpected(more.error());
  // Rows that have come since the inputs were read are no gap.
  if (*more && !verified.goes_on) {
    ++state->tick;
    return gap("driver input");
  }
  if (verified.ticks == 0)
    return refused(file, "no tick has both an input and a snapshot: there is nothing to compare",
                   "give a session that was driven");
  if (!original.value_or(true))
    return refused(file, "the driver inputs are not those that were driven with, though every state hash agrees",
                   "use an unaltered copy");
  return verified;
}

}  // namespace

Expected<int> run_verify(const std::filesystem::path& session, double from_s) {
  const auto verified = verify(session, from_s);
  if (!verified) return tl::unexpected(verified.error());
  const std::string from =
      verified->first > 0
          ? fmt::format(" from the state of {:g} s", static_cast<double>(verified->first) / simulation::tick_rate_hz)
          : "";
  fmt::print("{} ticks run again{}: every state hash agrees\n", verified->ticks, from);
  if (verified->goes_on) fmt::print("this drive goes on: what came since then was not run again\n");
  fmt::print("{}\n", verified->scene_agrees ? "the scene is the one that was driven in"
                                            : "the scene is not compared: the session has no digest of it");
  return 0;
}

}  // namespace septet::server
