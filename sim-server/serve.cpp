#include "sim-server/serve.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace septet::server {
namespace {

/// The loop's parts share these.
struct Loop {
  TickSource& source;
  ScreenHost& host;
  const ServeOptions& options;
  const ServeEnvironment& environment;
  double started_s;
  ServeResult result;

  void pump() {
    if (environment.changed_list)
      if (auto list = environment.changed_list()) host.set_allowed(std::move(*list));
    host.pump(environment.now_s());
    for (const auto& text : host.take_messages()) environment.message(text);
  }
  void report(std::string what) {
    environment.report({result.simulated_s, static_cast<double>(options.ticks) / source.tick_rate_hz(),
                        environment.now_s() - started_s, std::move(what)});
  }
  bool done() const { return environment.stop_requested() || (options.ticks != 0 && result.ticks >= options.ticks); }

  /// Pumps until `satisfied` or out of patience; false in the latter case. `every_s` runs `nudge` now and then.
  template <class Condition, class Nudge>
  bool pump_until(Condition satisfied, double patience_s, double every_s, Nudge nudge) {
    const double begun_s = environment.now_s();
    double nudged_s = begun_s;
    while (true) {
      pump();
      if (satisfied()) return true;
      const double now_s = environment.now_s();
      if (now_s - begun_s > patience_s || environment.stop_requested()) return false;
      if (now_s - nudged_s > every_s) {
        nudged_s = now_s;
        nudge();
      }
      environment.wait(host.has_backlog() ? 0.0 : 0.005);
    }
  }

  Expected<std::shared_ptr<const TakenSnapshot>> take_tick() {
    auto snapshot = source.next(host.take_controls());
    for (const auto& text : source.take_messages())
      if (environment.show) environment.show(text);
    if (snapshot && *snapshot) {
      ++result.ticks;
      result.simulated_s = (*snapshot)->snapshot().simulated_time_s;
      result.state_hash = (*snapshot)->snapshot().state_hash;
    }
    return snapshot;
  }
};

/// All who belong to the rig are there, or the operator does without them. Simulated time begins after that.
Expected<void> wait_for_screens(Loop& loop) {
  const auto missing = [&] { return fmt::format("{}", fmt::join(loop.host.missing(), ", ")); };
  const double patience_s = loop.options.lockstep ? loop.options.patience_s : loop.options.wait_for_screens_s;
  const bool can_go = loop.environment.told_to_go != nullptr;
  const auto told_to_go = [&] { return can_go && loop.environment.told_to_go(); };
  if (patience_s > 0.0)
    loop.pump_until([&] { return loop.host.all_ready() || told_to_go(); }, patience_s, 0.5,
                    [&] { loop.report(fmt::format("waiting for {}{}", missing(), can_go ? " (Enter: drive without)" : "")); });
  loop.started_s = loop.environment.now_s();
  if (patience_s <= 0.0 || loop.host.all_ready() || loop.environment.stop_requested()) return {};
  if (loop.options.lockstep && !told_to_go())
    return failure(fmt::format("no answer within {:.0f} s from: {}", patience_s, missing()), "screens",
                   "look into their logs, and check that they run and reach this machine");
  loop.environment.message("the drive begins without " + missing());
  return {};
}

Expected<void> run_lockstep(Loop& loop) {
  if (auto ready = wait_for_screens(loop); !ready) return ready;
  while (!loop.done()) {
    const auto snapshot = loop.take_tick();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) break;
    const Tick tick = (*snapshot)->snapshot().tick;
    if (tick % loop.options.draw_every_ticks != 0) continue;
    loop.host.publish(*snapshot, loop.environment.now_s());
    const bool together = loop.pump_until([&] { return loop.host.all_presented(tick); }, loop.options.lockstep_patience_s, 0.1,
                                          [&] { loop.host.repeat_newest(); });
    if (!together && !loop.environment.stop_requested()) loop.host.leave_behind(tick);
    loop.report("driving");
  }
  return {};
}

Expected<void> run_real_time(Loop& loop) {
  if (auto ready = wait_for_screens(loop); !ready) return ready;
  const double tick_s = 1.0 / loop.source.tick_rate_hz();
  double due_s = loop.environment.now_s();
  double reported_s = due_s;
  while (!loop.done()) {
    loop.pump();
    const double now_s = loop.environment.now_s();
    if (now_s < due_s) {
      loop.environment.wait(loop.host.has_backlog() ? 0.0 : due_s - now_s);
      continue;
    }
    // A machine that cannot keep up slows the simulation down; it does not skip ticks.
    if (now_s - due_s > tick_s) {
      ++loop.result.late_ticks;
      due_s = now_s;
    }
    due_s += tick_s;
    const auto snapshot = loop.take_tick();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) break;
    loop.host.publish(*snapshot, now_s);
    if (now_s - reported_s > 0.5) {
      reported_s = now_s;
      loop.report("driving");
    }
  }
  return {};
}

}  // namespace

Expected<ServeResult> serve(TickSource& source, ScreenHost& host, const ServeOptions& options,
                            const ServeEnvironment& environment) {
  Loop loop{source, host, options, environment, environment.now_s(), {}};
  auto outcome = options.lockstep ? run_lockstep(loop) : run_real_time(loop);
  loop.result.wall_s = environment.now_s() - loop.started_s;
  // Whatever happened, the screens hear that it is over and say what they have seen.
  host.finish(outcome ? "the drive is over" : outcome.error().what);
  const ServeEnvironment farewell{environment.now_s, environment.wait, [] { return false; }, environment.report, environment.message};
  Loop last{source, host, options, farewell, loop.started_s, {}};
  last.pump_until([&] { return host.all_reported(); }, 10.0, 1.0, [] {});
  if (!outcome) return tl::unexpected(outcome.error());
  return loop.result;
}

}  // namespace septet::server
