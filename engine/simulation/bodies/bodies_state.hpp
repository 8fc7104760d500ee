#pragma once
/// Vehicles and boxes that a crash has taken off their rails, and the contacts that run: plain data. The stage: bodies.hpp.

#include <optional>
#include <vector>

#include "engine/physics/impact/engagement.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/road/road_position.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// A vehicle moved by impacts and its locked wheels, or a box by impacts and friction, from its first contact on.
struct LooseBody {
  ParticipantId id = 0;  ///< As it was before: everybody knows it by this one.
  ModelIndex model = 0;
  Vec3 box_size_m{1.0};  ///< Of a box (engine/world/participant_shape.hpp).
  std::uint8_t paint = 0;
  Lamps lamps;
  double front_steer_rad = 0.0, wheel_spin_rad = 0.0;
  /// Its mass centre is the middle of its outline. Infinite mass: it stands fast, and is at rest for good.
  impact::Body body;
  double height_m = 0.0;   ///< Of the vehicle's origin.
  Vec3 up{0.0, 0.0, 1.0};  ///< Unit length: of the ground below.
  double climb_mps = 0.0;  ///< Rate of height_m.
  Vec2 acceleration_mps2{0.0};
  std::optional<road::RoadPosition> road;  ///< Its last place, where the next search begins.
  vehicle::HullState hull;                 ///< What it touches beside the road.
};

/// Two that touch, or that an impact still presses; of them at least one is a body or the driver's car.
struct BodyContact {
  ParticipantId first = 0, second = 0;  ///< Ascending.
  impact::Engagement engagement;
};

struct BodiesState {
  std::vector<LooseBody> bodies;      ///< In the order in which they left their rails.
  std::vector<BodyContact> contacts;  ///< Ascending by first, then second.

  bool empty() const { return bodies.empty() && contacts.empty(); }
};

}  // namespace septet::simulation
