#pragma once
/// Bodies that close lanes, and the way round them. Used by engine/traffic only.
///
/// A lane is closed to a vehicle where a body leaves it no room, not even at the lane's line. Who comes to such a place
/// changes towards the nearest lane that is open there, keeps room for that change if it has to stand
/// (mind_wrecks.cpp), and is let in by those beside it, one after the other. Who comes to rest too near to turn out
/// stays for good, and closes lanes as well.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

/// The way of a vehicle round the nearest body that closes its lane.
struct Detour {
  /// To that body, or a nearer one in a lane on the way to the open one, along x; infinite: nothing closes the lane.
  double gap_m = no_leader;
  int lanes = 0;  ///< Changes of lane to one that is open, positive towards greater lane numbers; 0: none is.
};

/// For a vehicle that is in, or changes to, `lane`.
Detour detour_round(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t vehicle, int lane);

/// Distance to the nearest body ahead that closes a lane to a vehicle; infinite where there is none.
double closed_ahead_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t vehicle, int lane);

/// True where a body before or beside a vehicle reaches into a lane: no place for a change that is not needed.
bool passes_wreck(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t vehicle, int lane);

/// How far a vehicle leaves the middle of its lane, to the left, to pass bodies that reach into it.
double shift_past_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t vehicle);

/// Room before a body with which so many changes of lane, to either side and one at least, can be done from a standstill.
double room_to_turn_out_m(const CorridorTraffic& traffic, std::size_t vehicle, int lanes, Turning turning);
/// Kept in addition.
inline constexpr double spare_m = 1.5;

/// True where a vehicle that stands has room for the changes of its detour, if it turns as tight as it can.
bool can_turn_out(const CorridorTraffic& traffic, std::size_t vehicle, const Detour& detour);

/// The wrecks and, behind them, vehicles that have come, or will come, to rest too near to turn out.
std::vector<Wreck> with_the_stuck(std::span<const Wreck> wrecks, const CorridorTraffic& traffic);

}  // namespace septet::traffic
