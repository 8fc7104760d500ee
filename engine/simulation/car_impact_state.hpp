#pragma once
/// A running impact of the driver's car with somebody who is no loose body. The stage that begins and advances it:
/// car_impacts.hpp.

#include "engine/physics/impact/pulse.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct CarImpact {
  ParticipantId vehicle = 0;  ///< The other one.
  impact::Pulse pulse;        ///< Of the car as the first body.
  impact::Body struck;  ///< The other as the impact alone would move it: its share of momentum and energy is kept here.
  double due_s = 0.0;   ///< Time since the touch that the pulse has not made up for yet.
};

}  // namespace septet::simulation
