#pragma once
/// The rules of a scenario's game (engine/simulation/game.hpp plays it).
///
/// UserDefinedAction of Init with type "septet:game" and content "leader=ENTITY lanes=FIRST..LAST" and any of
///
///     near=100 lost=250 lost_s=10 level_s=45 seconds=270 move_s=18 more_vehicles=25
///
/// in any order, metres and seconds.

#include <cstdint>

#include "engine/scenario/model/entity.hpp"

namespace septet::scenario {

struct GameSettings {
  EntityIndex leader = no_entity;     ///< Vehicle to be followed, which moves from lane to lane by itself.
  int first_lane = 0, last_lane = 0;  ///< Its lanes, OpenDRIVE ids, ascending.
  double near_m = 100.0;              ///< Distance behind the leader within which there are points.
  double lost_m = 250.0;              ///< Distance beyond which the leader gets lost…
  double lost_s = 10.0;               ///< …after this time.
  double level_s = 45.0;              ///< Duration of a level.
  double seconds = 270.0;             ///< Duration of the game; a player who lasts that long has survived.
  double move_s = 18.0;               ///< Mean time between the leader's changes of lane on the first level.
  std::uint32_t more_vehicles = 25;   ///< Added with each level.
};

}  // namespace septet::scenario
