#include "engine/world/interpolate.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "engine/math/spherical_interpolation.hpp"

namespace septet {
namespace {

/// Quintic Hermite polynomial in each coordinate; `h` is the interval's length.
Vec3 quintic(const Vec3& p0, const Vec3& v0, const Vec3& a0, const Vec3& p1, const Vec3& v1, const Vec3& a1, double h,
             double t) {
  const double t2 = t * t, t3 = t2 * t, t4 = t3 * t, t5 = t4 * t;
  return p0 * (1.0 - 10.0 * t3 + 15.0 * t4 - 6.0 * t5) + v0 * (h * (t - 6.0 * t3 + 8.0 * t4 - 3.0 * t5)) +
         a0 * (h * h * 0.5 * (t2 - 3.0 * t3 + 3.0 * t4 - t5)) + p1 * (10.0 * t3 - 15.0 * t4 + 6.0 * t5) +
         v1 * (h * (-4.0 * t3 + 7.0 * t4 - 3.0 * t5)) + a1 * (h * h * 0.5 * (t3 - 2.0 * t4 + t5));
}

bool teleported(const Participant& before, const Participant& after, double seconds) {
  const Vec3 expected =
      before.world_from_vehicle.position_m + 0.5 * seconds * (before.velocity_mps + after.velocity_mps);
  return glm::length(after.world_from_vehicle.position_m - expected) > 1.0 + 20.0 * seconds * seconds;
}

}  // namespace

Participant interpolate(const Participant& before, const Participant& after, double seconds, double t) {
  if (t >= 1.0) return after;
  Participant result = before;
  if (t <= 0.0 || seconds <= 0.0 || teleported(before, after, seconds)) return result;

  const auto& from = before.world_from_vehicle;
  const auto& to = after.world_from_vehicle;
  result.world_from_vehicle.position_m =
      quintic(from.position_m, before.velocity_mps, before.acceleration_mps2, to.position_m, after.velocity_mps,
              after.acceleration_mps2, seconds, t);
  result.world_from_vehicle.orientation = slerp_quadratic(
      from.orientation, to.orientation,
      sigma_from_rates(glm::length(before.angular_velocity_radps), glm::length(after.angular_velocity_radps)), t);
  result.velocity_mps = glm::mix(before.velocity_mps, after.velocity_mps, t);
  result.acceleration_mps2 = glm::mix(before.acceleration_mps2, after.acceleration_mps2, t);
  result.angular_velocity_radps = glm::mix(before.angular_velocity_radps, after.angular_velocity_radps, t);
  result.front_steer_rad = glm::mix(before.front_steer_rad, after.front_steer_rad, t);
  for (std::size_t i = 0; i < 4; ++i)
    result.wheel_lift_m[i] = glm::mix(before.wheel_lift_m[i], after.wheel_lift_m[i], t);

  // The wheel's own angle is known only to a turn; its mean rate gives the number of turns between.
  const double turn = 2.0 * glm::pi<double>();
  const double expected = 0.5 * (before.wheel_spin_radps + after.wheel_spin_radps) * seconds;
  const double difference = after.wheel_spin_rad - before.wheel_spin_rad;
  const double rolled = difference + turn * std::round((expected - difference) / turn);
  const double angle = before.wheel_spin_rad +
                       rolled * varied_share(sigma_from_rates(before.wheel_spin_radps, after.wheel_spin_radps), t);
  result.wheel_spin_rad = angle - turn * std::floor(angle / turn);
  return result;
}

Snapshot interpolate(const Snapshot& before, const Snapshot& after, double time_s) {
  const double seconds = after.simulated_time_s - before.simulated_time_s;
  if (seconds <= 0.0 || time_s >= after.simulated_time_s) return after;
  const double t = std::max(0.0, (time_s - before.simulated_time_s) / seconds);
  Snapshot result = before;
  result.simulated_time_s = std::max(time_s, before.simulated_time_s);
  Head& head = result.driver_car.head;
  head.from_rest_m = glm::mix(head.from_rest_m, after.driver_car.head.from_rest_m, t);
  head.turn_rad = glm::mix(head.turn_rad, after.driver_car.head.turn_rad, t);
  for (auto& participant : result.participants)
    if (const Participant* later = find_participant(after, participant.id))
      participant = interpolate(participant, *later, seconds, t);
  return result;
}

}  // namespace septet
