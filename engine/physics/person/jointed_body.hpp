#pragma once
/// A body of some masses on rods: a person, or a bicycle that nobody rides.
///
/// Masses stand in the joints. Rods keep two of them at their distance, limits within bounds; balls on rods touch the
/// ground and vehicles, with friction and without restitution. Every inner impulse acts along the line between two
/// masses, so linear and angular momentum are kept; what a vehicle loses, the body gets. World frame, metres. Additions,
/// multiplications, divisions and square roots alone: equal inputs give equal bits on every machine.
///
/// Simplified: masses at the ends of a rod give a limb more inertia about its middle than it has; arms are in the trunk;
/// a knee has no side to which it bends (jointed_plans.hpp says how it is drawn).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/physics/person/vehicle_solid.hpp"

namespace septet::person {

inline constexpr std::size_t most_masses = 9;

struct PointMass {
  Vec3 position_m{0.0}, velocity_mps{0.0};
};

/// Two masses at a distance, or within two.
struct Rod {
  std::size_t a, b;
  double least_m, most_m;
};

/// A ball at share t of the way from a to b, which touches.
struct Ball {
  std::size_t a, b;
  double t;
  double radius_m;
};

/// Constants of a kind of body: masses as shares of the whole, and their places as it stands, in the frame of the
/// participant that it is drawn as.
struct Plan {
  std::vector<double> mass_share;
  std::vector<Vec3> stands_at_m;
  std::vector<Rod> rods, limits;
  std::vector<Ball> balls;
  double ground_friction = 0.66;
  double vehicle_friction = 0.22;
  double most_force_n = 2200.0;  ///< Of a ball on a vehicle at first: flesh, bonnet and bumper give way.
};

enum class BodyKind : std::uint8_t { person, bicycle, motorcycle };
const Plan& plan_of(BodyKind kind);

struct JointedBody {
  BodyKind kind = BodyKind::person;
  double mass_kg = 80.0;
  std::array<PointMass, most_masses> masses{};  ///< Those that the plan has; the others are zero.
  std::uint32_t still_ticks = 0;                ///< Time for which nothing has moved.
};

/// The ground under a body: a plane.
struct Ground {
  Vec3 point_m{0.0}, normal{0.0, 0.0, 1.0};
  double friction_factor = 1.0;  ///< 1 on dry asphalt.
};

/// True for a body that lies: it is not advanced until a vehicle is near.
bool lies_still(const JointedBody& body);

/// Advances by one tick of `dt_s`. `vehicles` are those near it, as they stand at the tick's end; empty `ground`: none
/// within reach (in the air, or a test of momentum). `gravity_mps2`: downwards.
void advance_body(const std::optional<Ground>& ground, double gravity_mps2, double dt_s,
                  std::span<MovingSolid> vehicles, JointedBody& body);

/// Sums over the masses, kg, m, m/s.
Vec3 mass_centre_m(const JointedBody& body);
Vec3 momentum_ns(const JointedBody& body);

}  // namespace septet::person
