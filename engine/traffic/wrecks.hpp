#pragma once
/// Bodies that close lanes, and the way round them. Used by engine/traffic only.
///
/// A lane is closed to a vehicle where a body leaves it no room in the lane's middle. Who comes to such a place changes
/// towards the nearest lane that is open there, keeps room for that change if it has to stand, and is let in by those
/// beside it, one after the other. Who has come to rest too near to turn out stays, and closes the lane as well.

#include <span>
#include <vector>

#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

/// The way of a vehicle round the nearest body that closes its lane.
struct Detour {
  double gap_m = no_leader;  ///< To that body, along x; infinite: nothing closes the lane.
  int lanes = 0;  ///< Changes of lane to one that is open, positive towards greater lane numbers; 0: none is.
};

/// For a vehicle that is in, or changes to, `lane`.
Detour detour_round(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t vehicle, int lane);

/// Room before a body with which this many changes of lane can be done from a standstill.
double room_to_turn_out_m(const CorridorTraffic& traffic, std::size_t vehicle, int changes);

/// True where a vehicle that stands has room for the changes of its detour.
bool can_turn_out(const CorridorTraffic& traffic, std::size_t vehicle, const Detour& detour);

/// The wrecks and, behind them, vehicles that stand too near to turn out.
std::vector<Wreck> with_the_stuck(std::span<const Wreck> wrecks, const CorridorTraffic& traffic);

}  // namespace septet::traffic
