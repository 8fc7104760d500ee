#include "sim-server/drive/what_if/variant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/natural_end.hpp"
#include "sim-server/drive/traffic_choice.hpp"

namespace septet::server {
namespace {

/// The first collision from an instant on, without the car's place.
Expected<std::optional<LoggedCollision>> collision_from(const logging::SessionReader& session, double from_s) {
  const auto events = session.events({.first = static_cast<Tick>(from_s * simulation::tick_rate_hz)});
  if (!events) return tl::unexpected(events.error());
  const auto found = std::ranges::find(*events, "collision", &logging::Event::kind);
  if (found == events->end()) return std::optional<LoggedCollision>();
  return std::optional(
      LoggedCollision{.met = {.tick = found->tick, .other = found->participant}, .world_from_car = {}});
}

Expected<void> check_without_gap(const WhatIf& what_if) {
  const auto& inputs = what_if.recorded.inputs;
  if (inputs.back().tick - inputs.front().tick + 1 == inputs.size()) return {};
  return failure("driver inputs are missing: the log has a gap", what_if.where, "use an unaltered copy");
}

/// A drive that is run again, from a state on.
class RunAgain {
 public:
  /// `model` is of the drive, or differs from its by the car's given motion; it outlives the run.
  RunAgain(const WhatIf& what_if, const simulation::Model& model, simulation::State state)
      : what_if_(what_if),
        model_(model),
        state_(std::move(state)),
        command_(first_command_after(what_if.recorded, state_.tick)) {}

  const simulation::State& state() const { return state_; }
  const Snapshot& snapshot() const { return snapshot_; }
  const std::vector<simulation::Event>& events() const { return events_; }

  Expected<void> step(std::span<const PlacedChange> changes) {
    events_.clear();
    if (auto done = repeat_commands(what_if_.recorded, what_if_.where, command_, state_, events_); !done) return done;
    const DriverInput input = changed_input(what_if_.known(), changes, state_.tick + 1);
    snapshot_ = simulation::server_step(model_, input, state_, events_, std::move(snapshot_));
    if (auto error = state_.traffic->take_error()) return tl::unexpected(std::move(*error));
    return {};
  }

 private:
  const WhatIf& what_if_;
  const simulation::Model& model_;
  simulation::State state_;
  std::size_t command_;
  Snapshot snapshot_;
  std::vector<simulation::Event> events_;
};

/// Compares state hashes with those of the log, tick by tick.
class LoggedHashes {
 public:
  static Expected<LoggedHashes> from(const logging::SessionReader& session, const simulation::State& state) {
    auto cursor = session.snapshots_from(state.time_s());
    if (!cursor) return tl::unexpected(cursor.error());
    return LoggedHashes(session, std::move(*cursor));
  }
  /// False: the log was cut off between an input and its snapshot.
  Expected<bool> compare(Tick tick, std::uint64_t hash, const WhatIf& what_if) {
    const auto snapshot = cursor_.next();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) return false;
    if ((*snapshot)->tick != tick)
      return failure(fmt::format("the snapshot of tick {} is missing: the log has a gap", tick), what_if.where,
                     "use an unaltered copy");
    if ((*snapshot)->state_hash == hash) return true;
    return failure(fmt::format("without a change tick {} gives state hash {:016x}, recorded is {:016x}", tick, hash,
                               (*snapshot)->state_hash),
                   what_if.where,
                   cause_of_other_hash(session_.info(), !what_if.recorded.inputs_are_original.value_or(true)));
  }

 private:
  LoggedHashes(const logging::SessionReader& session, logging::SnapshotCursor cursor)
      : session_(session), cursor_(std::move(cursor)) {}
  const logging::SessionReader& session_;
  logging::SnapshotCursor cursor_;
};

/// Runs the logged inputs from the kept state on, keeps the state at the fork, and takes down the logged course.
Expected<void> run_as_logged(const logging::SessionReader& session, WhatIf& what_if) {
  const simulation::Model& model = *what_if.recorded.loaded.model;
  auto traffic = open_traffic(what_if.recorded.traffic, model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto begin =
      kept_state(session, model, static_cast<double>(what_if.fork) / simulation::tick_rate_hz, std::move(*traffic));
  if (!begin) return tl::unexpected(begin.error());
  what_if.begin = begin->tick;
  auto hashes = LoggedHashes::from(session, *begin);
  if (!hashes) return tl::unexpected(hashes.error());
  what_if.begin_hash = simulation::hash_state(*begin);
  if (auto equal = hashes->compare(begin->tick, what_if.begin_hash, what_if); !equal)
    return tl::unexpected(equal.error());
  RunAgain run(what_if, model, std::move(*begin));
  const auto keep = [&]() -> Expected<void> {
    auto bytes = simulation::save_state(model, run.state());
    if (!bytes) return tl::unexpected(bytes.error());
    what_if.fork_state = std::move(*bytes);
    return {};
  };
  if (what_if.begin == what_if.fork)
    if (auto kept = keep(); !kept) return kept;
  std::optional<OutcomeWatch> watch;
  const Tick last = std::min(std::max(what_if.end, what_if.known_until), what_if.recorded.inputs.back().tick);
  while (run.state().tick < last) {
    if (auto done = run.step({}); !done) return done;
    const Snapshot& snapshot = run.snapshot();
    const auto equal = hashes->compare(snapshot.tick, snapshot.state_hash, what_if);
    if (!equal) return tl::unexpected(equal.error());
    if (!*equal) break;
    ++what_if.agreeing_ticks;
    if (snapshot.tick == what_if.fork)
      if (auto kept = keep(); !kept) return kept;
    if (what_if.logged && snapshot.tick == what_if.logged->met.tick) {
      if (auto met = collision_among(run.events(), snapshot, what_if.names)) what_if.logged->met = std::move(*met);
      if (const auto* car = find_participant(snapshot, simulation::driver_participant))
        what_if.logged->world_from_car = car->world_from_vehicle;
    }
    if (snapshot.tick <= what_if.fork) continue;
    if (!watch) watch.emplace(what_if.names, what_if.logged ? &*what_if.logged : nullptr, what_if.from_s);
    watch->see(snapshot, run.events());
  }
  if (watch) what_if.as_logged = watch->outcome();
  return {};
}

/// Runs to the first collision, else to the end, or the drive's own end.
Expected<VariantOutcome> run_to_end(const WhatIf& what_if, const simulation::Model& model, simulation::State state,
                                    std::span<const PlacedChange> changes) {
  OutcomeWatch watch(what_if.names, what_if.logged ? &*what_if.logged : nullptr, what_if.from_s);
  RunAgain run(what_if, model, std::move(state));
  const Tick end = model.motion ? std::min(what_if.end, what_if.recorded.inputs.back().tick) : what_if.end;
  while (run.state().tick < end && !natural_end(model, run.state())) {
    if (auto done = run.step(changes); !done) return tl::unexpected(done.error());
    watch.see(run.snapshot(), run.events());
    if (watch.has_collided()) break;
  }
  return watch.outcome();
}

}  // namespace

Expected<std::vector<PlacedChange>> place_changes(const WhatIf& what_if, std::span<const InputChange> changes) {
  std::vector<PlacedChange> placed;
  placed.reserve(changes.size());
  for (const InputChange& change : changes) {
    auto one = place_change(change, what_if.known(), what_if.where);
    if (!one) return tl::unexpected(one.error());
    placed.push_back(*one);
  }
  return placed;
}

Expected<WhatIf> prepare_what_if(const logging::SessionReader& session,
                                 std::span<const std::vector<InputChange>> extremes, const WhatIfOptions& options) {
  if (const auto shown = session.shown_span_s(); !shown) return tl::unexpected(shown.error());
  auto recorded = read_recorded_drive(session);
  if (!recorded) return tl::unexpected(recorded.error());
  WhatIf what_if{.recorded = std::move(*recorded), .where = session.path().string(), .from_s = options.from_s};
  if (what_if.recorded.traffic != "own")
    return failure("another program moves the traffic of this drive, and keeps its state", what_if.where,
                   "drive with Septet's own traffic");
  const bool is_changed = std::ranges::any_of(extremes, [](const auto& changes) { return !changes.empty(); });
  if (is_changed && what_if.recorded.loaded.model->motion)
    return failure("the car of this drive goes by a table: nobody pressed or steered what could be changed",
                   what_if.where, "depart from the table within its ± by --runs, or drive with another table");
  if (auto whole = check_without_gap(what_if); !whole) return tl::unexpected(whole.error());
  auto names = logging::participant_names(session);
  if (!names) return tl::unexpected(names.error());
  what_if.names = std::move(*names);
  auto logged = collision_from(session, options.from_s);
  if (!logged) return tl::unexpected(logged.error());
  what_if.logged = std::move(*logged);
  const Tick first = what_if.recorded.inputs.front().tick, last = what_if.recorded.inputs.back().tick;
  what_if.known_until = what_if.logged ? std::clamp(what_if.logged->met.tick, first, last) : last;

  auto first_changed = std::numeric_limits<Tick>::max();
  for (const auto& changes : extremes) {
    const auto placed = place_changes(what_if, changes);
    if (!placed) return tl::unexpected(placed.error());
    for (const PlacedChange& change : *placed) first_changed = std::min(first_changed, change.first);
  }
  if (first_changed == std::numeric_limits<Tick>::max()) first_changed = first;  // Without a change.
  what_if.fork = first_changed - 1;
  what_if.end = what_if.fork + static_cast<Tick>(std::llround(options.seconds * simulation::tick_rate_hz));
  if (auto run = run_as_logged(session, what_if); !run) return tl::unexpected(run.error());
  return what_if;
}

Expected<VariantOutcome> run_variant(const WhatIf& what_if, std::span<const InputChange> changes) {
  const auto placed = place_changes(what_if, changes);
  if (!placed) return tl::unexpected(placed.error());
  const simulation::Model& model = *what_if.recorded.loaded.model;
  auto traffic = open_traffic(what_if.recorded.traffic, model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = simulation::restore_state(model, std::move(*traffic), what_if.fork_state, what_if.where);
  if (!state) return tl::unexpected(state.error());
  return run_to_end(what_if, model, std::move(*state), *placed);
}

Expected<VariantOutcome> run_deviating(const WhatIf& what_if, const simulation::MotionDeviation& deviation) {
  simulation::Model model = *what_if.recorded.loaded.model;
  if (!model.motion)
    return failure("somebody drives in this session: there is no table to depart from", what_if.where,
                   "give a session of septet drive --motion, or a --change");
  model.motion = std::make_shared<const simulation::GivenMotion>(simulation::deviating(*model.motion, deviation));
  auto traffic = open_traffic(what_if.recorded.traffic, model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = simulation::initial_state(model, std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  return run_to_end(what_if, model, std::move(*state), {});
}

}  // namespace septet::server
