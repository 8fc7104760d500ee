#pragma once
/// Where the driver's car was in the last minutes, to be put back there.

#include <cstddef>
#include <deque>
#include <optional>

#include "engine/simulation/operator_command.hpp"
#include "logging/session/records.hpp"

namespace septet::server {

class WayBack {
 public:
  /// Each sample of the drive, ascending. Those outside of every lane are no place to go back to.
  void add(const logging::Sample& sample);
  /// Where it was in a lane so many seconds ago, or just before that, as fast as it was; 0: where it was last, at rest. Nothing: it was in no
  /// lane then, or nobody remembers.
  std::optional<simulation::PutCar> place(double seconds_ago, double now_s) const;

  static constexpr double reaches_s = 300.0;

 private:
  std::deque<logging::Sample> samples_;
};

}  // namespace septet::server
