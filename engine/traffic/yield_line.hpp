#pragma once
/// Lines at which others may have right of way (lights, give-way signs and crossings on foot), and the time until a
/// vehicle or walker with it arrives.
///
/// Lines are read off a road network: a light's at its stop line (sign 294) or at itself, a give-way sign's (205) and a
/// stop sign's (206) at itself, a crosswalk's a metre before it, for either direction. Others are taken to continue
/// with their present speed and turn rate. World frame, metres, seconds. Pure functions.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::traffic {

struct YieldLine {
  enum class Kind : std::uint8_t { light, give_way, crossing };
  Kind kind = Kind::give_way;
  road::RoadIndex road = 0;
  bool along_s = true;  ///< Applies to traffic towards increasing s.
  double s_m = 0.0;
  double signal_s_m = 0.0;  ///< Station of the light itself.
};

/// True where a signal is for traffic towards increasing s; one for both directions stands on its traffic's side.
bool applies_along_s(const road::Road& road, const road::Signal& signal);

/// Lines in the order of roads, along each.
std::vector<YieldLine> yield_lines(const road::RoadNetwork& network);

/// Points of the path beyond a line that others may cross, a metre apart, from a place in the lane on: for a crossing
/// over it, else into the junction. Where lanes part, along the first continuation.
std::vector<Vec2> way_beyond(const road::RoadNetwork& network, YieldLine::Kind kind, const road::LanePosition& at_line);

/// Limit of the look-ahead.
inline constexpr double conflict_horizon_s = 8.0;

struct Conflict {
  ParticipantId with = 0;
  double in_s = 0.0;  ///< Time until a participant with right of way reaches the path; 0: is there.
};
/// The first participant to reach the path beyond a line: walkers at a crossing, vehicles at a give-way line, except
/// those with the path of `self`. Of a swarm's people those who cross, or wait to. Empty at a light.
std::optional<Conflict> first_conflict(YieldLine::Kind kind, std::span<const Vec2> way,
                                       std::span<const Participant> participants, const Participant& self);

}  // namespace septet::traffic
