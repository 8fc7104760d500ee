#include "engine/instant/spray.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/sight/air.hpp"

namespace septet::instant {
namespace {

struct WakeShape {
  double height_m, radius_m, growth_mps;
  double interval_s;
};
constexpr WakeShape car_wake{0.45, 0.4, 0.45, 0.12}, lorry_wake{1.1, 0.8, 0.4, 0.2};
constexpr double follows_s = 0.5, follows_share = 0.35;
constexpr double life = 3.0;  ///< Life of a puff in multiples of the time in which it thins to 1/e.

sight::Wake wake_of(const DrawnParticipant& vehicle, double road_wetness) {
  if (!vehicle.raises_spray) return {};
  return sight::spray_wake(vehicle.heavy, glm::length(vehicle.velocity_mps), road_wetness);
}

/// Number in [−1, 1) for a puff.
double scatter(std::uint32_t participant, std::uint32_t puff, std::uint32_t what) {
  std::uint32_t h = participant * 0x9e3779b1u ^ puff * 0x85ebca77u ^ what * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<double>((h ^ (h >> 15)) >> 8) / 8388608.0 - 1.0;
}

}  // namespace

float spray_depth(const DrawnParticipant& vehicle, double road_wetness) {
  return static_cast<float>(wake_of(vehicle, road_wetness).depth);
}

void add_spray(const DrawnParticipant& vehicle, const Environment& environment, double simulated_time_s,
               std::vector<SmokePuff>& puffs) {
  const sight::Wake air = wake_of(vehicle, environment.road_wetness);
  const auto depth = static_cast<float>(air.depth);
  if (depth < 0.01f || !(std::abs(simulated_time_s) < 1e9)) return;
  const WakeShape& wake = vehicle.heavy ? lorry_wake : car_wake;
  const RigidTransform& place = vehicle.world_from_vehicle;
  const Vec3 up = place.orientation * Vec3(0.0, 0.0, 1.0), aside = place.orientation * Vec3(0.0, 1.0, 0.0);
  const Vec3 from_m = place * Vec3(vehicle.tail_x_m, 0.0, 0.0);
  const Vec3 wind = environment.wind_speed_mps *
                    Vec3(std::cos(environment.wind_direction_rad), std::sin(environment.wind_direction_rad), 0.0);
  // Sum of the thinning e^−a over the puffs, as a share of thins_s / interval_s: less than one by the cut-off of the
  // old puffs.
  constexpr double whole = 0.935;
  const auto share = static_cast<float>(wake.interval_s / (whole * air.thins_s));
  const double newest = std::floor(simulated_time_s / wake.interval_s);
  const int count = static_cast<int>(life * air.thins_s / wake.interval_s);
  for (int n = 0; n < count; ++n) {
    const double age_s = simulated_time_s - (newest - n) * wake.interval_s;
    const auto puff = static_cast<std::uint32_t>(static_cast<std::int64_t>(newest) - n);
    const double thinned = age_s / air.thins_s;
    // Old puffs fade out without a jump.
    const double left = std::exp(-thinned) * std::clamp((life - thinned) * 2.0, 0.0, 1.0) *
                        std::min(1.0, age_s / (0.5 * wake.interval_s) + 0.5);
    const double radius_m = wake.radius_m + wake.growth_mps * age_s;
    const double followed_s = follows_share * follows_s * (1.0 - std::exp(-age_s / follows_s));
    SmokePuff drop;
    // Direction back along the vehicle's path, which turns with its yaw rate.
    const Quat turned_back = glm::angleAxis(-0.5 * vehicle.yaw_rate_radps * age_s, Vec3(0.0, 0.0, 1.0));
    drop.position_m = from_m - turned_back * vehicle.velocity_mps * (age_s - followed_s) +
                      wind * (age_s * age_s / (age_s + follows_s)) +
                      up * (wake.height_m + 0.15 * radius_m * scatter(vehicle.number, puff, 1)) +
                      aside * (0.25 * radius_m * scatter(vehicle.number, puff, 2));
    drop.radius_m = static_cast<float>(radius_m);
    drop.extinction_area_m2 = depth * share * static_cast<float>(left) * 2.0f * std::numbers::pi_v<float> *
                              static_cast<float>(radius_m * radius_m);
    drop.albedo = glm::vec3(0.92f);
    drop.seed = vehicle.number * 31u + puff;
    puffs.push_back(drop);
  }
}

}  // namespace septet::instant
