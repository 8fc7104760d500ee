#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/traffic/people/people_stages.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::traffic {
namespace {

constexpr double start_up_s = 3.0;      ///< HCM 2010: start-up and end clearance.
constexpr double right_of_way_s = 1.0;  ///< The same where who walks has right of way.
constexpr double gentle_mps2 = 1.8;     ///< Braking on which people count where they have right of way.
constexpr double looks_m = 90.0, turns_in_m = 22.0, stands_mps = 0.3, creeps_mps = 1.5;
constexpr double beside_band_m = 0.6, impatient_s = 30.0;

/// True where a vehicle leaves people a gap, or lets them pass.
bool leaves_gap(const SeenVehicle& vehicle, const Vec2& middle_m, const Vec2& across, double length_m, double half_m,
                double needed_s, bool has_right_of_way) {
  const Vec2 from = vehicle.middle_m - middle_m;
  const double distance_m = glm::length(from);
  if (distance_m > looks_m) return true;
  const Vec2 normal(-across.y, across.x);
  const double ahead_m = glm::dot(from, normal), beside_m = glm::dot(from, across);
  const double along_cos = std::abs(glm::dot(vehicle.heading, normal));
  const double reach_m =
      along_cos * vehicle.half_length_m + std::sqrt(1.0 - along_cos * along_cos) * vehicle.half_width_m;
  const double mps = glm::length(vehicle.velocity_mps);
  const double half_across_m = 0.5 * length_m + 0.5;
  const bool is_on_band = std::abs(ahead_m) < reach_m + half_m * 0.5 && std::abs(beside_m) < half_across_m;
  if (mps < stands_mps) return !is_on_band;
  if (is_on_band) return false;
  const double closing_mps =
      ahead_m > 0.0 ? -glm::dot(vehicle.velocity_mps, normal) : glm::dot(vehicle.velocity_mps, normal);
  double gap_m = std::abs(ahead_m) - reach_m - half_m, towards_mps = closing_mps;
  if (closing_mps < 0.5 * mps) {
    // It comes round a corner, if at all.
    if (distance_m > turns_in_m || glm::dot(from, vehicle.velocity_mps) > -0.3 * distance_m * mps) return true;
    gap_m = distance_m - vehicle.half_length_m - half_m, towards_mps = mps;
  } else {
    const double arrives_s = std::max(gap_m, 0.0) / closing_mps;
    const double beside_then_m = beside_m + glm::dot(vehicle.velocity_mps, across) * arrives_s;
    if (std::abs(beside_then_m) > half_across_m + 1.5) return true;
  }
  gap_m = std::max(gap_m, 0.0);
  if (gap_m > needed_s * towards_mps) return true;
  if (!has_right_of_way) return false;
  const double room_m = std::max(gap_m - beside_band_m, 0.05);
  return mps < creeps_mps ? gap_m > beside_band_m : towards_mps * towards_mps < 2.0 * gentle_mps2 * room_m;
}

}  // namespace

std::vector<SeenVehicle> seen_vehicles(const PeopleAround& around) {
  std::vector<SeenVehicle> seen;
  for (const Participant& participant : around.vehicles) {
    const VehicleModel model = shape_of(participant);
    if (model.kind == ParticipantKind::pedestrian) continue;
    SeenVehicle& vehicle = seen.emplace_back();
    const Vec3 middle = participant.world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.0);
    const Vec3 heading = participant.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
    vehicle.middle_m = Vec2(middle);
    vehicle.height_m = middle.z;
    vehicle.velocity_mps = Vec2(participant.velocity_mps);
    const double flat = glm::length(Vec2(heading));
    vehicle.heading = flat > 1e-6 ? Vec2(heading) / flat : Vec2(1.0, 0.0);
    vehicle.half_length_m = 0.5 * model.length_m, vehicle.half_width_m = 0.5 * model.width_m;
  }
  return seen;
}

bool may_cross(const WalkwayGraph& graph, const Crossing& crossing, bool from_left, const PeopleAround& around,
               const std::vector<SeenVehicle>& vehicles, const Person& person) {
  if (crossing.kind == Crossing::Kind::light) {
    const auto heads = graph.heads_of(crossing);
    return std::ranges::all_of(heads, [&](std::uint32_t head) {
      return head < around.lights.size() && around.lights[head].lamps.has(Lamp::signal_green);
    });
  }
  const Vec2 way = crossing.right_kerb_m - crossing.left_kerb_m;
  const double length_m = std::max(glm::length(way), 0.1);
  const Vec2 across = way / length_m, middle_m = 0.5 * (crossing.left_kerb_m + crossing.right_kerb_m);
  const bool zebra = crossing.kind == Crossing::Kind::zebra;
  const double needed_s =
      length_m / person.desired_mps + (zebra || person.waits_s > impatient_s ? right_of_way_s : start_up_s);
  constexpr double level_m = 3.0;
  return std::ranges::all_of(vehicles, [&](const SeenVehicle& vehicle) {
    if (std::abs(vehicle.height_m - person.height_m) > level_m) return true;
    return leaves_gap(vehicle, middle_m, from_left ? across : -across, length_m, crossing.place.half_m, needed_s,
                      zebra);
  });
}

}  // namespace septet::traffic
