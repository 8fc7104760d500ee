#pragma once
/// A vehicle as the solid that a thrown body meets: bumper, bonnet, windscreen and roof, extruded over its width.
///
/// Two convex pieces, one below the belt line and the cabin. Vehicle frame in `pieces`, metres. The numbers stand in
/// fronts.toml beside this file.

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::person {

/// Inside: dot(normal, p) < offset_m.
struct Plane {
  Vec3 normal{1.0, 0.0, 0.0};  ///< Unit length, outwards.
  double offset_m = 0.0;
};

/// Part of a vehicle that is met.
enum class Part : std::uint8_t { below, bumper, bonnet, windscreen, roof, side, rear };

struct Face {
  Plane plane;
  Part part = Part::side;
  /// Of a flat front's underside: a ball whose middle is above it, and which is no deeper behind the front than this,
  /// came in through the front and is not pushed down.
  double behind_front_m = 0.0;
};
using Piece = std::vector<Face>;  ///< Convex; the bumper before the underside.

/// Convex pieces of a vehicle of this model.
std::vector<Piece> vehicle_pieces(const VehicleModel& model);

/// Where a ball lies in a piece.
struct Depth {
  double depth_m = 0.0;
  Vec3 normal{0.0};
  Part part = Part::side;
};
/// The least way out of the piece for a ball; depth ≤ 0: it is not in it.
Depth depth_in(const Piece& piece, const Vec3& centre_m, double radius_m);

/// How a body first touches a vehicle in a tick.
struct Touches {
  std::optional<Part> body, head;
  double closing_mps = 0.0;        ///< Greatest speed along a normal at which a ball met it.
  Vec3 point_m{0.0}, normal{0.0};  ///< There; the normal is the vehicle's.
};

/// A vehicle that moves through a tick. What bodies give it is in `velocity_mps` and `taken_ns` afterwards.
struct MovingSolid {
  std::vector<Piece> pieces;
  RigidTransform world_from_vehicle;  ///< At the tick's end.
  Vec3 velocity_mps{0.0};             ///< Of the origin.
  Vec3 angular_velocity_radps{0.0};
  double mass_kg = INFINITY;  ///< Infinite: it takes impulses unmoved.
  Vec3 taken_ns{0.0};         ///< Sum of the impulses that it was given.
  Touches touches;            ///< Of the last body that was advanced.
};

}  // namespace septet::person
