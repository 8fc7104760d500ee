#pragma once
/// Messages for the driver about the car: a collision, its speed and what it came to, leaving the road, a stalled engine; and the keys
/// to press.
///
/// `take` is called for each tick, so that the same drive gives the same messages. One thread.

#include <optional>
#include <span>
#include <string>

#include "engine/simulation/state.hpp"
#include "engine/world/crash_record.hpp"
#include "engine/world/snapshot.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

class DriverWord {
 public:
  /// `by_keyboard`: the driver has the keys Escape, R and V.
  explicit DriverWord(bool by_keyboard = true) : by_keyboard_(by_keyboard) {}

  void take(const Snapshot& now, std::span<const simulation::Event> events);
  /// Messages, one per line; empty: nothing to report.
  std::string text() const;

  /// A blow is shown from this speed on, for this long; driving off every lane and a stall are shown after this long.
  static constexpr double least_blow_mps = 2.0, blow_shown_s = 8.0, off_road_after_s = 4.0, stalled_after_s = 2.0;

 private:
  void take_crash(const simulation::Event& event);
  /// What the blow that is shown came to; empty: not known.
  std::string outcome() const;
  /// Who ran into whom in it.
  std::string whose_blow() const;

  bool by_keyboard_, has_begun_ = false;
  std::string blow_;
  bool blow_is_others_ = false;  ///< Somebody ran into the driver's car.
  double blow_mps_ = 0.0, blow_at_s_ = 0.0;
  std::optional<CrashRecord> crash_;  ///< The hardest of late; of what stands it comes before the collision.
  double crash_at_s_ = 0.0;
  double now_s_ = 0.0, on_lane_s_ = 0.0, runs_s_ = 0.0;  ///< Last tick on a lane, and with a running engine.
};

/// Lines for the driver at the natural end of a drive: it is over, and the keys to press. `is_lesson`: the debrief has
/// the mark.
std::string words_at_end(logging::DriveEnd end, bool is_lesson);

}  // namespace septet::server
