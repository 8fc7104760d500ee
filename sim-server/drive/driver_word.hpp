#pragma once
/// What has happened to the driver's car, in words for whoever drives it: what it hit and how fast, that it has left the road, that the engine
/// has stalled; and what to press.
///
/// Fed each tick with what a tick tells, so that the same drive gives the same words. One thread.

#include <span>
#include <string>

#include "engine/simulation/state.hpp"
#include "engine/world/snapshot.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

class DriverWord {
 public:
  /// `by_keyboard`: Escape, R and V are at hand.
  explicit DriverWord(bool by_keyboard = true) : by_keyboard_(by_keyboard) {}

  void take(const Snapshot& now, std::span<const simulation::Event> events);
  /// A line each; empty: nothing that the driver does not see.
  std::string text() const;

  /// A blow is told of from this speed on, for so long; off every lane and a stall once they have lasted.
  static constexpr double least_blow_mps = 2.0, blow_shown_s = 8.0, off_road_after_s = 4.0, stalled_after_s = 2.0;

 private:
  bool by_keyboard_, has_begun_ = false;
  std::string blow_;
  double blow_mps_ = 0.0, blow_at_s_ = 0.0;
  double now_s_ = 0.0, on_lane_s_ = 0.0, runs_s_ = 0.0;  ///< When it was last on a lane, and its engine ran.
};

/// Lines for the driver at a drive's own end: that it is over, and what to press. `is_lesson`: its mark is in the debrief.
std::string words_at_end(logging::DriveEnd end, bool is_lesson);

}  // namespace septet::server
