#pragma once
/// The rules of a game that a scenario is played as (engine/simulation/game.hpp plays it).
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
  EntityIndex leader = no_entity;     ///< Who is to be followed, and moves from lane to lane by itself…
  int first_lane = 0, last_lane = 0;  ///< …among these, OpenDRIVE ids, ascending.
  double near_m = 100.0;              ///< So near behind the leader there are points.
  double lost_m = 250.0;              ///< Farther away than this…
  double lost_s = 10.0;               ///< …for so long: the leader is lost.
  double level_s = 45.0;              ///< A level lasts so long.
  double seconds = 270.0;             ///< Who is still there then has come through.
  double move_s = 18.0;               ///< Mean time between the leader's changes of lane on the first level.
  std::uint32_t more_vehicles = 25;   ///< With each level.
};

}  // namespace septet::scenario
