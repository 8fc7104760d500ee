#pragma once
/// The server's choice of the play-out delay D, from how late ticks reach the screens.
///
/// D is at least the rig's; it grows to the worst lateness of the last seconds plus one tick (a lost datagram comes with the
/// next tick's repetition), and shrinks again only after a calm while. A change is announced ahead, so that every screen makes
/// it at the same instant of the server's clock. Pure state, no clock; one thread.

#include <cstdint>
#include <deque>

#include "engine/control/control_message.hpp"

namespace septet::server {

class PlayoutPlanner {
 public:
  PlayoutPlanner(double least_delay_s, double tick_s);

  /// A screen says how late a tick came.
  void observe(double lateness_s, double now_s);
  /// The delay part of the header of a tick published now.
  control::TickHeader header(double now_s);

  double delay_s() const { return next_s_; }

 private:
  static constexpr double memory_s = 5.0;     ///< How long a late tick is remembered.
  static constexpr double notice_s = 0.1;     ///< From the announcement of a change to the change.
  static constexpr double largest_s = 0.25;   ///< Beyond this no driver would believe the wheel.

  struct Lateness {
    double at_s, lateness_s;
  };
  double least_s_, tick_s_;
  double current_s_, next_s_, next_from_s_ = 0.0;
  std::deque<Lateness> worst_;  ///< Descending lateness, ascending time: a sliding maximum.
};

}  // namespace septet::server
