#pragma once
/// Past places of the driver's car, over the last minutes, to put it back there.

#include <cstddef>
#include <deque>
#include <optional>

#include "engine/simulation/operator_command.hpp"
#include "logging/session/records.hpp"

namespace septet::server {

class WayBack {
 public:
  /// Adds a sample of the drive, in ascending order. Samples outside every lane are skipped.
  void add(const logging::Sample& sample);
  /// The car's last place in a lane at or before that time, with its speed then; at 0 seconds, its last place in a
  /// lane, at rest. Empty: no such place in the last 300 s.
  std::optional<simulation::PutCar> place(double seconds_ago, double now_s) const;

  static constexpr double reaches_s = 300.0;

 private:
  std::deque<logging::Sample> samples_;
};

}  // namespace septet::server
