#pragma once
/// A participant's body as a box, for contacts.

#include "engine/effects/debris/debris_state.hpp"
#include "engine/physics/impact/outline.hpp"
#include "engine/physics/impact/restitution.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// A participant's body as a box, from its ground clearance to its roof; bonnet and windscreen of cars and vans are one
/// slope. World frame.
debris::Box body_box(const Participant& participant);

/// Radius of its corners in plan.
double corner_m(const Participant& participant);

/// A body's outline in plan; by itself with the corners of a vehicle.
impact::Outline outline_of(const debris::Box& box, double corner_m = impact::vehicle_corner_m());

}  // namespace septet::simulation
