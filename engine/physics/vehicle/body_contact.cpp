#include "engine/physics/vehicle/body_contact.hpp"

#include <algorithm>

namespace septet::vehicle {
namespace {
// Clearance of the bumpers, whose corners these are: an approach angle of 15 degrees over a metre of overhang. Lower,
// and a saloon that brakes in a bend would scrape the ground with its outer front corner at 6 m/s².
constexpr double bumper_clearance_m = 0.25;
constexpr double stiffness_npm = 4e5;
constexpr double damping_nspm = 8e3;
constexpr double body_friction = 0.5;
constexpr double buried_m = 0.5;  ///< Deeper, the force grows no more, and lifts the corner out no faster than out_mps.
constexpr double out_mps = 1.0;   ///< Slow: such a depth is not driven into, so no energy is stored.
}  // namespace

void add_body_contact(const VehicleParameters& parameters, const Ground& ground, const VehicleState& state,
                      const Vec3& velocity_mps, Vec3& force_n, Vec3& moment_nm) {
  const BodyParameters& body = parameters.body;
  const Quat body_from_world = glm::conjugate(state.world_from_body.orientation);
  for (int corner = 0; corner < 8; ++corner) {
    const bool front = corner < 4, left = corner % 2 == 0, top = corner / 2 % 2 == 1;
    const WheelGround& below = ground[(front ? 0 : 2) + (left ? 0 : 1)];
    // The roof is narrower and shorter than the sills.
    const double inset_m = top ? 0.25 : 0.0;
    const double rear_m = -body.rear_overhang_m + (top ? 0.25 * body.length_m : 0.0);
    const double front_m = body.length_m - body.rear_overhang_m - (top ? 0.3 * body.length_m : 0.0);
    const Vec3 point_m = Vec3(front ? front_m : rear_m, (left ? 1.0 : -1.0) * (0.5 * body.width_m - inset_m),
                              top ? body.height_m : bumper_clearance_m) -
                         Vec3(body.mass_centre_x_m, 0.0, body.mass_centre_z_m);
    const double depth_m = -glm::dot(below.normal, state.world_from_body * point_m - below.point_m);
    if (depth_m <= 0.0) continue;
    const Vec3 normal = body_from_world * below.normal;
    const Vec3 speed_mps = velocity_mps + glm::cross(state.angular_velocity_radps, point_m);
    const double approach_mps = -glm::dot(speed_mps, normal);
    double push_n = std::max(0.0, stiffness_npm * std::min(depth_m, buried_m) + damping_nspm * approach_mps);
    if (depth_m > buried_m) push_n *= std::clamp(1.0 + approach_mps / out_mps, 0.0, 1.0);
    const Vec3 sliding_mps = speed_mps + approach_mps * normal;
    const double slide_mps = glm::length(sliding_mps);
    const Vec3 push = push_n * normal - body_friction * push_n / std::max(slide_mps, 0.1) * sliding_mps;
    force_n += push;
    moment_nm += glm::cross(point_m, push);
  }
}

}  // namespace septet::vehicle
