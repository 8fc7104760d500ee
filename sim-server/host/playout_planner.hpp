#pragma once
/// The server's choice of the simulated time that screens show, from the lateness of their ticks.
///
/// The play-out delay D is at least the rig's; it grows to the worst lateness of the last seconds plus one and a half
/// ticks (a lost datagram comes with the next tick's repetition), and shrinks again only after a calm while. The offset
/// between the server's clock and the shown time is D plus the simulation's lag behind that clock. A change is
/// announced ahead, so that every screen makes it at the same instant of the server's clock. Pure state, no clock; one
/// thread.

#include <deque>

#include "engine/control/control_message.hpp"

namespace septet::server {

/// Maximum of the values of the last seconds.
class SlidingMaximum {
 public:
  explicit SlidingMaximum(double memory_s) : memory_s_(memory_s) {}
  void add(double value, double now_s);
  /// Returns `otherwise` if there was no value.
  double at(double now_s, double otherwise);

 private:
  struct Value {
    double at_s, value;
  };
  double memory_s_;
  std::deque<Value> values_;  ///< Descending value, ascending time.
};

class PlayoutPlanner {
 public:
  PlayoutPlanner(double least_delay_s, double tick_s) : least_s_(least_delay_s), tick_s_(tick_s) {}

  /// Takes a screen's measurement: the time from a tick's publication to its arrival.
  void observe(double lateness_s, double now_s) { lateness_.add(lateness_s, now_s); }
  /// The header of a tick published now.
  control::TickHeader header(double now_s, double simulated_time_s);

  double delay_s() const { return delay_s_; }

 private:
  static constexpr double memory_s = 5.0;    ///< Duration for which a late tick is remembered.
  static constexpr double notice_s = 0.1;    ///< From the announcement of a change to the change.
  static constexpr double largest_s = 0.25;  ///< Maximum of D: beyond it, no driver would believe the wheel.

  double least_s_, tick_s_;
  double delay_s_ = 0.0;
  bool started_ = false;
  double current_s_ = 0.0, next_s_ = 0.0, next_from_s_ = 0.0;
  SlidingMaximum lateness_{memory_s}, behind_{memory_s};
};

}  // namespace septet::server
