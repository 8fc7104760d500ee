#include "sim-server/host/serve.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace septet::server {
namespace {

using logging::DriveEnd;

/// Joins two texts for the driver, one below the other.
std::string below(std::string above, const std::string& text) {
  if (!above.empty() && !text.empty()) above += '\n';
  return above += text;
}

/// State shared by the loop's parts. A part returns once `result.end` has the reason, or when it has nothing more to
/// do.
struct Loop {
  TickSource& source;
  const Attendants& attendants;
  ServeClock& clock;
  std::uint64_t ticks;
  double started_s;
  double source_begun_s = 0.0;  ///< Simulated time of the source's beginning.
  ServeResult result = {};
  std::shared_ptr<const TakenSnapshot> newest = nullptr;
  std::string doing = "starting";  ///< For attendants.
  Wishes wishes = {};              ///< Wishes of all attendants, as last asked.
  bool is_being_drawn = false;     ///< As Moment's.

  bool is_paused() const { return wishes.stands_still; }
  void report(std::string what) {
    doing = std::move(what);
    const double total_s = ticks == 0 ? 0.0 : source_begun_s + static_cast<double>(ticks) / source.tick_rate_hz();
    const Progress progress{result.simulated_s, total_s, clock.now_s() - started_s, doing};
    for (const auto& attendant : attendants) attendant->show(progress);
  }
  void tell(const Message& message) {
    for (const auto& attendant : attendants) attendant->hear(message);
  }
  void tell(std::string text) { tell(Message{std::move(text)}); }
  void show_messages() {
    for (auto& text : source.take_messages()) tell(Message{std::move(text), true});
  }
  /// Calls the attendants before a tick and takes their wishes for it.
  void attend() {
    for (const auto& attendant : attendants) {
      attendant->before_tick({newest, doing, clock.now_s(), is_being_drawn});
      for (auto& text : attendant->take_messages()) tell(std::move(text));
    }
    wishes = {};
    for (const auto& attendant : attendants) {
      const Wishes wish = attendant->wishes();
      if (!wishes.end) wishes.end = wish.end;
      wishes.stands_still = wishes.stands_still || wish.stands_still;
      wishes.goes_without_missing = wishes.goes_without_missing || wish.goes_without_missing;
      wishes.word_to_driver = below(std::move(wishes.word_to_driver), wish.word_to_driver);
    }
  }
  /// Takes the next tick; null at the end, with the reason in the result.
  std::shared_ptr<const TakenSnapshot> take_tick(const std::optional<DriverInput>& controls) {
    auto snapshot = source.next(controls);
    show_messages();
    if (!snapshot) result.error = std::move(snapshot.error());
    if (!snapshot || !*snapshot) {
      result.end = source.end();
      return nullptr;
    }
    ++result.ticks;
    result.simulated_s = (*snapshot)->snapshot().simulated_time_s;
    if (result.ticks == 1) source_begun_s = result.simulated_s - 1.0 / source.tick_rate_hz();
    result.state_hash = (*snapshot)->snapshot().state_hash;
    newest = *snapshot;
    for (const auto& attendant : attendants) attendant->after_tick(newest, source.shaking_share());
    return std::move(*snapshot);
  }
  /// True if somebody wants the drive to end or its log is lost; the result has the reason.
  bool is_stopped(const std::optional<DriveEnd>& by_a_screen) {
    attend();
    if (auto error = source.take_error()) {
      result.error = std::move(*error);
      result.end = source.end();
    }
    if (result.error) return true;
    if (!wishes.end && !by_a_screen) return false;
    result.end = wishes.end ? *wishes.end : *by_a_screen;
    return true;
  }
  /// True once all requested ticks are there; the result has the reason.
  bool is_time_over() {
    if (ticks == 0 || result.ticks < ticks) return false;
    result.end = DriveEnd::time_over;
    return true;
  }
};

/// A loop with screens.
struct ScreenLoop : Loop {
  ScreenHost& host;
  const ServeOptions& options;
  bool can_pause = false;  ///< The world follows the clock, and has begun.
  std::string alarm = {};  ///< Text that the driver reads: alarms and messages.

  void show_alarm() {
    if (auto now = below(below(source.alarm(), source.word_to_driver()), wishes.word_to_driver); now != alarm) {
      alarm = std::move(now);
      host.give_notice({alarm, host.notice().keys});
    }
  }

  void pump() {
    host.pump(clock.now_s());
    for (auto& text : host.take_messages()) tell(std::move(text));
  }
  /// A request to pause a world that cannot be paused, or has not begun, counts as a request to leave.
  bool is_stopped() {
    const bool leaves = !can_pause && host.pause_requested();
    return Loop::is_stopped(leaves ? std::optional(DriveEnd::escape) : host.end_requested());
  }
  bool is_paused() const { return Loop::is_paused() || (can_pause && host.pause_requested()); }
  bool is_over() { return is_stopped() || is_time_over(); }

  /// Pumps until `satisfied`, out of patience or stopped; false in the latter cases. Runs `nudge` every `every_s`.
  template <class Condition, class Nudge>
  bool pump_until(Condition satisfied, double patience_s, double every_s, Nudge nudge) {
    const double begun_s = clock.now_s();
    double nudged_s = begun_s;
    while (true) {
      pump();
      if (satisfied()) return true;
      const double now_s = clock.now_s();
      if (now_s - begun_s > patience_s || is_stopped()) return false;
      if (now_s - nudged_s > every_s) {
        nudged_s = now_s;
        nudge();
      }
      clock.wait(host.has_backlog() ? 0.0 : 0.005);
    }
  }
};

/// Waits until all screens of the rig, and its car, are there, or until the operator or the time limit does without the
/// missing ones. Simulated time begins after that. In lockstep, a drive without any screen fails.
bool wait_for_screens(ScreenLoop& loop) {
  const auto missing = [&] { return fmt::format("{}", fmt::join(loop.host.missing(), ", ")); };
  const double patience_s = loop.options.lockstep ? loop.options.patience_s : loop.options.wait_for_screens_s;
  const auto told_to_go = [&] { return loop.wishes.goes_without_missing; };
  if (patience_s > 0.0)
    loop.pump_until([&] { return loop.host.all_ready() || told_to_go(); }, patience_s, 0.5,
                    [&] {
                      loop.report(fmt::format("waiting for {}{}", missing(),
                                              loop.options.can_go_without ? " (Enter: drive without)" : ""));
                    });
  loop.started_s = loop.clock.now_s();
  if (patience_s <= 0.0 || loop.host.all_ready()) return true;
  if (loop.is_stopped()) return false;
  if (loop.options.lockstep && !told_to_go() && loop.host.missing().size() == loop.host.screens().size()) {
    loop.result.end = DriveEnd::no_screens;
    loop.result.error = Error{fmt::format("no answer within {:.0f} s from: {}", patience_s, missing()), "screens",
                              "look into their logs, and check that they run and reach this machine"};
    return false;
  }
  loop.tell("the drive begins without " + missing());
  return true;
}

/// Keeps the world still, visibly on all screens, for as long as the operator or the driver wants. The actuators in the
/// driver's seat rest.
void stand_still(ScreenLoop& loop) {
  const control::Notice before = loop.host.notice();
  const auto say = [&] {
    const bool by_driver = loop.host.pause_requested();
    const std::string alarm = loop.source.alarm();
    const control::Notice notice{
        below((alarm.empty() ? "" : alarm + ". ") +
                  (by_driver ? "Paused. Escape: go on. R: begin again. Enter: end" : "Paused by the operator"),
              loop.wishes.word_to_driver),
        before.keys, by_driver};
    if (loop.host.notice() != notice) {
      loop.host.give_notice(notice);
      if (by_driver) loop.tell("paused by the driver");
    }
    loop.report(by_driver ? "paused by the driver" : "paused");
  };
  loop.source.stand_still();
  const double begun_s = loop.clock.now_s();
  say();
  loop.pump_until(
      [&] { return !loop.is_paused(); }, std::numeric_limits<double>::infinity(), 0.1,
      [&] {
        loop.show_messages();
        if (loop.newest) loop.host.repeat_newest();
        loop.source.stand_still();  // Repeated, since the message may be lost on its way to a car on another machine.
        say();
      });
  const double stood_s = loop.clock.now_s() - begun_s;
  loop.tell(fmt::format("the world stood still for {:.1f} s", stood_s));
  loop.host.give_notice(before);
  loop.host.restart_shown_time();
  loop.started_s += stood_s;
  loop.report("driving");
}

void run_lockstep(ScreenLoop& loop) {
  if (!wait_for_screens(loop)) return;
  while (!loop.is_over()) {
    if (loop.is_paused()) {
      stand_still(loop);
      continue;
    }
    const auto snapshot = loop.take_tick(loop.host.take_controls());
    if (!snapshot) return;
    loop.show_alarm();
    const Tick tick = snapshot->snapshot().tick;
    if (tick % loop.options.draw_every_ticks != 0) {
      loop.host.publish_to_watchers(snapshot, loop.clock.now_s());
      continue;
    }
    loop.host.publish(snapshot, loop.clock.now_s());
    const double asked_s = loop.clock.now_s();
    const auto look = [&] {
      loop.host.leave_silent_behind(tick, loop.clock.now_s() - loop.options.longest_silence_s);
      loop.host.repeat_newest();
    };
    loop.is_being_drawn = true;
    const bool together =
        loop.pump_until([&] { return loop.host.all_presented(tick); }, loop.options.patience_s, 0.1, look);
    loop.is_being_drawn = false;
    if (!together && loop.clock.now_s() - asked_s > loop.options.patience_s) loop.host.leave_behind(tick);
    loop.report("driving");
  }
}

/// Keeps the world still at its first instant, visibly on all screens, until the driver takes the controls.
void wait_for_driver(ScreenLoop& loop) {
  const auto first = loop.source.first();
  if (!first || loop.options.wait_for_driver.empty()) return;
  const std::string about = loop.options.about.empty() ? "" : '\n' + loop.options.about;
  const auto say = [&, keys = loop.host.notice().keys] {
    const control::Notice notice{below(loop.options.wait_for_driver + about, loop.wishes.word_to_driver), keys};
    if (loop.host.notice() != notice) loop.host.give_notice(notice);
  };
  say();
  loop.tell(fmt::format("the world waits for the driver: {} (--start-now does without)", loop.options.wait_for_driver));
  const double begun_s = loop.clock.now_s();
  loop.host.publish(first, begun_s);
  const auto waited_s = [&] { return loop.clock.now_s() - begun_s; };
  const bool is_ready =
      loop.pump_until([&] { return loop.source.driver_is_ready(loop.host.take_controls(), waited_s()); },
                      std::numeric_limits<double>::infinity(), 0.1,
                      [&] {
                        loop.show_messages();
                        loop.host.repeat_newest();
                        say();
                        loop.report("waiting for the driver");
                      });
  // A driver who has taken the controls has read the keys, in any window.
  loop.host.give_notice({"", !is_ready && loop.host.notice().keys});
  loop.host.restart_shown_time();
  loop.started_s = loop.clock.now_s();
  if (is_ready) loop.tell(fmt::format("the driver took the controls after {:.1f} s", waited_s()));
}

void run_real_time(ScreenLoop& loop) {
  if (!wait_for_screens(loop)) return;
  wait_for_driver(loop);
  if (loop.is_stopped()) return;
  loop.can_pause = true;
  const double tick_s = 1.0 / loop.source.tick_rate_hz();
  double due_s = loop.clock.now_s();
  double reported_s = due_s;
  while (!loop.is_over()) {
    loop.pump();
    if (loop.is_paused()) {
      stand_still(loop);
      due_s = loop.clock.now_s();
      continue;
    }
    const double now_s = loop.clock.now_s();
    if (now_s < due_s) {
      loop.clock.wait(loop.host.has_backlog() ? 0.0 : due_s - now_s);
      continue;
    }
    // A machine that cannot keep up slows the simulation down; it does not skip ticks.
    if (now_s - due_s > tick_s) {
      ++loop.result.late_ticks;
      due_s = now_s;
    }
    due_s += tick_s;
    const auto snapshot = loop.take_tick(loop.host.take_controls());
    if (!snapshot) return;
    loop.show_alarm();
    loop.host.publish(snapshot, now_s);
    if (now_s - reported_s > 0.5) {
      reported_s = now_s;
      loop.report("driving");
    }
  }
}

/// Shows the natural end of a drive, with the keys to press, until R, Enter or Escape is pressed, all screens have
/// left, or the time is over. The end in the result stays, unless there is an error.
void show_end(ScreenLoop& loop) {
  const DriveEnd end = loop.result.end;
  if (!loop.options.words_at_end || loop.result.error || exit_status(end) != logging::finished_status) return;
  loop.host.give_notice({loop.options.words_at_end(end), false, true});
  loop.tell(fmt::format("the drive's end stays on the screens for {:.0f} s, or until R or Enter is pressed",
                        loop.options.end_shown_s));
  const auto rest = [&] {
    loop.host.repeat_newest();
    loop.source.stand_still();
    loop.report("over");
  };
  rest();
  loop.host.stand_until_escape();
  const auto is_left = [&] {
    return !loop.host.pause_requested() || loop.host.missing().size() == loop.host.screens().size();
  };
  loop.pump_until(is_left, loop.options.end_shown_s, 0.1, rest);
  loop.result.begins_again = loop.result.end == DriveEnd::restart;
  if (!loop.result.error) loop.result.end = end;
}

}  // namespace

ServeResult serve(TickSource& source, ScreenHost& host, const ServeOptions& options, const Attendants& attendants,
                  ServeClock& clock) {
  ScreenLoop loop{{source, attendants, clock, options.ticks, clock.now_s()}, host, options};
  options.lockstep ? run_lockstep(loop) : run_real_time(loop);
  loop.result.wall_s = clock.now_s() - loop.started_s;
  if (!options.lockstep) show_end(loop);
  // Screens are told of every kind of end, and send their reports.
  host.finish(loop.result.error ? loop.result.error->what : std::string(text_of(loop.result.end)));
  const double asked_s = clock.now_s();
  do {
    loop.pump();
    clock.wait(host.has_backlog() ? 0.0 : 0.005);
  } while (!host.all_reported() && clock.now_s() - asked_s < 10.0);
  return loop.result;
}

ServeResult run_headless(TickSource& source, std::uint64_t ticks, const Attendants& attendants, ServeClock& clock) {
  Loop loop{source, attendants, clock, ticks, clock.now_s()};
  while (!loop.is_stopped(std::nullopt) && !loop.is_time_over()) {
    if (loop.is_paused()) {
      const double begun_s = loop.clock.now_s();
      loop.source.stand_still();
      loop.report("paused");
      while (loop.is_paused() && !loop.is_stopped(std::nullopt)) loop.clock.wait(0.01);
      loop.started_s += loop.clock.now_s() - begun_s;
      loop.report("driving");
      continue;
    }
    if (!loop.take_tick(std::nullopt)) break;
    if (loop.result.ticks % 120 == 0) loop.report("driving");
  }
  loop.result.wall_s = clock.now_s() - loop.started_s;
  return loop.result;
}

}  // namespace septet::server
