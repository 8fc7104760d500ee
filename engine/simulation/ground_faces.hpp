#pragma once
/// Faces of the ground: steps higher than a wheel climbs. A wheel stays on the ground before the face; the hull meets
/// the face as a wall.
///
/// A road file makes them where a profile begins elsewhere than the one before ends, and where roads of other heights
/// join (engine/road/CHECKS.md names them). Ground higher than a car that belongs to another road is a bridge and no
/// face.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// True where a wheel has come in plan to ground that lies higher than it climbs, from where it `stood`. Then `ground`,
/// found there, becomes the one before the face, and `place` the nearest place on that.
bool stays_before_face(const Model& model, const Vec3& centre_m, const road::RoadPosition& stood,
                       road::RoadPosition& place, vehicle::WheelGround& ground);

/// True where the surface of a road may step within `reach_m` of a station: a record of it begins there, or the road
/// ends.
bool may_step(const road::Road& road, double s_m, double reach_m);

/// Takes away edges higher than a wheel's radius, which a hull that touches a face meets as a wall: a wheel that comes to
/// one by the hull's crush does not climb it.
void take_faces_away(const vehicle::HullState& hull, double wheel_radius_m, vehicle::WheelGround& ground);

/// Appends a stretch of wall for each corner of the hull that comes to a face, or still touches one: all of one run, so
/// that two corners at one face are one impact. `ground`: under the wheels. Costs nothing away from places where a road
/// may step.
void append_faces(const Model& model, const State& state, const vehicle::Ground& ground,
                  std::vector<Obstacle>& obstacles);

}  // namespace septet::simulation
