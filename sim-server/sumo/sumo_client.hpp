#pragma once
/// Septet's queries to a running SUMO: one call of its C++ client (TraCI) each.
///
/// The client library is linked by a module of its own, which is loaded when a drive needs SUMO: Septet builds and runs
/// without it. Vehicles are known by participant id; the world frame is Septet's. Errors: SUMO has gone, or refuses.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/traffic/driver.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

/// Bits of SUMO's vehicle signals.
namespace sumo_signal {
inline constexpr int blinker_right = 1 << 0, blinker_left = 1 << 1, brake_light = 1 << 3;
}

/// A kind of vehicle with one driver's parameters; `base` is one of the types of SUMO's own files.
struct SumoVehicleType {
  std::string id, base;
  double length_m = 0.0, width_m = 0.0, height_m = 0.0;
  traffic::FollowingParameters following;
};

struct SumoDeparture {
  ParticipantId id = 0;
  std::string type;
  std::vector<std::string> route;
  int lane_index = 0;
  double along_m = 0.0;
  bool watched = true;  ///< True: `step` reports it.
};

/// One vehicle after a step.
struct SumoVehicle {
  ParticipantId id = 0;
  Vec2 front_m{0.0};         ///< Middle of the front bumper.
  double heading_rad = 0.0;  ///< Counter-clockwise from x.
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
  int signals = 0;
};

class SumoClient {
 public:
  virtual ~SumoClient() = default;
  virtual Expected<void> define_type(const SumoVehicleType& type) = 0;
  /// Adds a vehicle that departs when SUMO finds room for it at that place, at its driver's desired speed or, if that
  /// is impossible, as fast as SUMO lets it.
  virtual Expected<void> add_vehicle(const SumoDeparture& departure) = 0;
  /// A vehicle that SUMO does not know, since it has left or was removed, is gone: no error.
  virtual Expected<void> remove_vehicle(ParticipantId id) = 0;
  /// Place of a vehicle moved by others after the next step, independent of its route; off every road it is ignored.
  virtual Expected<void> place_vehicle(ParticipantId id, const Vec2& front_m, double heading_rad) = 0;
  /// The distance at which a vehicle stops behind another, and in which SUMO lets nobody change lanes.
  virtual Expected<void> set_standstill_gap(ParticipantId id, double gap_m) = 0;
  /// Held: it does not drive on; it may still move aside.
  virtual Expected<void> hold_vehicle(ParticipantId id, bool held) = 0;
  /// Asks a vehicle to move sideways in the next step, to the left if positive, where its gaps allow it.
  virtual Expected<void> move_aside(ParticipantId id, double left_m) = 0;
  /// Advances SUMO by one step; returns the watched vehicles on the road, ascending id.
  virtual Expected<std::vector<SumoVehicle>> step() = 0;
};

/// Connects to the SUMO that listens at this port of this machine; one at a time.
using ConnectSumo = Expected<std::unique_ptr<SumoClient>> (*)(int port);
/// Loads the module. Error: this Septet was built without SUMO, or SUMO's library is gone.
Expected<ConnectSumo> load_sumo_module();

}  // namespace septet::server
