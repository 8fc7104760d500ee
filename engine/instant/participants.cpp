#include "engine/instant/participants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/instant/headlight_beam.hpp"
#include "engine/instant/level_fade.hpp"
#include "engine/instant/limb_pose.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/world/limbs.hpp"
#include "engine/world/paint.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::instant {
namespace {

using scene::PartRole;

bool is_lamp(PartRole role) { return role >= PartRole::lamp_brake && role <= PartRole::beacon; }

/// Index of a wheel (front left, front right, rear left, rear right), or −1.
int wheel_index(PartRole role) {
  const int index = static_cast<int>(role) - static_cast<int>(PartRole::wheel_front_left);
  return index >= 0 && index < 4 ? index : -1;
}

float glow_radius_m(PartRole role) {
  switch (role) {
    case PartRole::lamp_head:
      return 0.55f;
    case PartRole::beacon:
      return 1.3f;
    case PartRole::lamp_tail:
      return 0.22f;
    default:
      return 0.38f;
  }
}

/// Direction in which a lamp shines, vehicle frame.
Vec3 facing(PartRole role, double x_m) {
  switch (role) {
    case PartRole::lamp_head:
      return {1, 0, 0};
    case PartRole::lamp_brake:
    case PartRole::lamp_tail:
    case PartRole::lamp_reverse:
    case PartRole::signal_red:
    case PartRole::signal_amber:
    case PartRole::signal_green:
      return {-1, 0, 0};
    case PartRole::lamp_indicator_left:
    case PartRole::lamp_indicator_right:
      return {x_m > 1.0 ? 1.0 : -1.0, 0, 0};
    default:
      return {0, 0, 0};
  }
}

/// Mean of the flashes over `taken_in_s` around the instant.
float strobe(double simulated_time_s, bool second_half) {
  constexpr double period_s = 0.5, pulse_s = 0.06, next_pulse_s = 0.12;
  const double phase_s = std::fmod(simulated_time_s + (second_half ? 0.25 : 0.0), period_s);
  const double from = phase_s - 0.5 * taken_in_s, to = phase_s + 0.5 * taken_in_s;
  double lit_s = 0.0;
  for (const double begin : {0.0, next_pulse_s, period_s, -period_s, next_pulse_s - period_s})
    lit_s += std::max(0.0, std::min(to, begin + pulse_s) - std::max(from, begin));
  return static_cast<float>(std::clamp(lit_s / taken_in_s, 0.0, 1.0));
}

/// State of a lamp of the vehicle; beacons aside.
bool is_on(PartRole role, Lamps lamps) {
  const bool beams = lamps.has(Lamp::low_beam) || lamps.has(Lamp::high_beam);
  switch (role) {
    case PartRole::lamp_brake:
      return lamps.has(Lamp::brake);
    case PartRole::lamp_reverse:
      return lamps.has(Lamp::reverse);
    case PartRole::lamp_indicator_left:
      return lamps.has(Lamp::indicator_left);
    case PartRole::lamp_indicator_right:
      return lamps.has(Lamp::indicator_right);
    case PartRole::lamp_head:
    case PartRole::lamp_tail:
      return beams;
    case PartRole::signal_red:
      return lamps.has(Lamp::signal_red);
    case PartRole::signal_amber:
      return lamps.has(Lamp::signal_amber);
    case PartRole::signal_green:
      return lamps.has(Lamp::signal_green);
    default:
      return true;
  }
}

/// Horizontal intensity of a box that shines on all sides, averaged around it: a side is visible from half of all
/// directions, with 2/π of its area in the mean.
glm::vec3 shone_around(const scene::Instance& part, const MeshSummary& mesh) {
  const glm::vec3 size = glm::abs((mesh.bounds.max_m - mesh.bounds.min_m) * part.scale);
  return mesh.emission * (2.0f / std::numbers::pi_v<float> * size.z * (size.x + size.y));
}

/// Heading of a vehicle on the level.
glm::vec2 level_ahead(const RigidTransform& world_from_vehicle) {
  const glm::vec2 ahead(world_from_vehicle.orientation * Vec3(1, 0, 0));
  const float length = glm::length(ahead);
  return length > 1e-3f ? ahead / length : glm::vec2(1.0f, 0.0f);
}

/// Adds the beams of a vehicle's left and right lamps. They merge between these distances from the eye: from further
/// away the two are not told apart, and a picture has few beams to spend.
void add_headlights(std::vector<Headlight>& headlights, const RigidTransform& world_from_vehicle,
                    std::span<const Vec3> lamps_m, std::size_t lamps_gone, double distance_m, float main_beam) {
  if (lamps_m.empty() && lamps_gone > 0) return;
  float intensity = beam::pair_intensity;
  if (lamps_gone > 0) intensity *= static_cast<float>(lamps_m.size()) / static_cast<float>(lamps_m.size() + lamps_gone);
  constexpr double two_until_m = 19.0, one_from_m = 28.0, before_glass_m = 0.15, least_apart_m = 0.2;
  Vec3 middle_m(3.6, 0.0, 0.65);
  double aside_m = 0.0;
  if (!lamps_m.empty()) {
    middle_m = Vec3(before_glass_m, 0.0, 0.0);
    for (const Vec3& lamp_m : lamps_m) middle_m += lamp_m / double(lamps_m.size());
    for (const Vec3& lamp_m : lamps_m) aside_m += std::abs(lamp_m.y - middle_m.y) / double(lamps_m.size());
  }
  aside_m *= std::clamp((one_from_m - distance_m) / (one_from_m - two_until_m), 0.0, 1.0);
  const glm::vec3 ahead(world_from_vehicle.orientation * Vec3(1, 0, 0));
  if (aside_m < least_apart_m) {
    headlights.push_back({world_from_vehicle * middle_m, ahead, intensity, main_beam});
    return;
  }
  for (const double side : {1.0, -1.0})
    headlights.push_back(
        {world_from_vehicle * (middle_m + Vec3(0.0, side * aside_m, 0.0)), ahead, 0.5f * intensity, main_beam});
}

}  // namespace

float shining(PartRole role, Lamps lamps, double simulated_time_s, double beacon_y_m) {
  if (role == PartRole::beacon) return lamps.has(Lamp::beacon) ? strobe(simulated_time_s, beacon_y_m < -0.05) : 0.0f;
  return is_on(role, lamps) ? 1.0f : 0.0f;
}

RigidTransform vehicle_from_part(const scene::Instance& part, const DrawnParticipant& participant) {
  RigidTransform result = part.world_from_object;
  if (const int wheel = wheel_index(part.role); wheel >= 0) {
    result.position_m.z += participant.wheel_lift_m[static_cast<std::size_t>(wheel)];
    const double steer = wheel < 2 ? participant.front_steer_rad : 0.0;
    result.orientation = glm::angleAxis(steer, Vec3(0, 0, 1)) *
                         glm::angleAxis(participant.wheel_spin_rad, Vec3(0, 1, 0)) * result.orientation;
  } else if (is_limb(part.role)) {
    return vehicle_from_limb(part, participant);
  } else if (part.role == PartRole::steering_wheel) {
    // Its axis points forward and away from the driver: a turn to the left is counter-clockwise to him.
    result.orientation = result.orientation * glm::angleAxis(-participant.steering_wheel_rad, Vec3(1, 0, 0));
  }
  return result;
}

PlacedParticipants place_participants(std::span<const DrawnParticipant> participants,
                                      std::span<const scene::Prototype> prototypes, std::span<const MeshSummary> meshes,
                                      double simulated_time_s, const Vec3& eye_m,
                                      const std::function<float(const RigidTransform&)>& share_of_sky) {
  // Distance beyond that of any part from its vehicle's origin, and of the mirrors' eye points from the driver's.
  constexpr double margin_m = 12.0;
  PlacedParticipants result;
  for (const DrawnParticipant& participant : participants) {
    if (participant.prototype >= prototypes.size()) continue;
    const bool whole = participant.shown == Shown::whole;
    const double distance_m = glm::length(participant.world_from_vehicle.position_m - eye_m);
    const float sky = share_of_sky(participant.world_from_vehicle);
    std::vector<Vec3> head_lamps_m;
    std::size_t head_lamps_gone = 0;
    const float main_beam = participant.lamps.has(Lamp::high_beam) ? 1.0f : 0.0f;
    const std::vector<scene::Instance>& parts = prototypes[participant.prototype].parts;
    for (const scene::Instance& resting : parts) {
      const std::optional<scene::Instance> moved = scene::moved(resting, simulated_time_s);
      const scene::Instance& part = moved ? *moved : resting;
      if (moved && moved->scale == glm::vec3(0.0f)) continue;  // Its animation has taken it away.
      if (part.mesh >= meshes.size() || distance_m - margin_m >= gone_from_m(part.visible_to_m)) continue;
      const MeshSummary& mesh = meshes[part.mesh];
      const RigidTransform in_vehicle = vehicle_from_part(part, participant);
      PlacedMesh placed = place(part, mesh.bounds, participant.world_from_vehicle * in_vehicle, participant.stretch);
      const Vec3 middle_m = in_vehicle * Vec3(0.5f * (mesh.bounds.min_m + mesh.bounds.max_m) * part.scale);
      const float lit = shining(part.role, participant.lamps, simulated_time_s, middle_m.y);
      placed.seen = whole;
      placed.share_of_sky = sky;
      placed.snowed_on = false;  // The airstream of the drive has blown snow off.
      placed.number = participant.number;
      if (const auto index = static_cast<std::size_t>(&resting - parts.data());
          participant.reshaped && index < participant.reshaped->size())
        placed.reshaped = (*participant.reshaped)[index].get();
      if (placed.reshaped && placed.reshaped->indices.empty()) {
        head_lamps_gone += part.role == PartRole::lamp_head ? 1 : 0;
        continue;
      }
      const auto& lift = participant.wheel_lift_m;
      placed.over_road_m = static_cast<float>(in_vehicle.position_m.z - 0.25 * (lift[0] + lift[1] + lift[2] + lift[3]));
      placed.tint = glm::vec4(participant.paint, lit);
      placed.lights_around = part.role == PartRole::beacon;
      result.meshes.push_back(placed);
      if (part.role == PartRole::lamp_head) {
        head_lamps_m.push_back(middle_m);
      }
      const bool in_range = distance_m >= part.visible_from_m && distance_m < part.visible_to_m;
      if (is_lamp(part.role) && lit > 0.0f && whole && in_range)
        result.glows.push_back({participant.world_from_vehicle * middle_m, part.role == PartRole::lamp_head,
                                glm::vec3(participant.world_from_vehicle.orientation * facing(part.role, middle_m.x)),
                                mesh.emission * lit, glow_radius_m(part.role),
                                participant.world_from_vehicle.position_m.z, main_beam});
      if (part.role == PartRole::beacon && lit > 0.0f && whole && in_range)
        result.beacons.push_back({participant.world_from_vehicle * middle_m, shone_around(part, mesh) * lit,
                                  level_ahead(participant.world_from_vehicle)});
    }
    if (participant.lamps.has(Lamp::low_beam) || participant.lamps.has(Lamp::high_beam)) {
      add_headlights(result.headlights, participant.world_from_vehicle, head_lamps_m, head_lamps_gone, distance_m,
                     main_beam);
    }
  }
  std::stable_sort(result.meshes.begin(), result.meshes.end(),
                   [](const PlacedMesh& a, const PlacedMesh& b) { return a.mesh < b.mesh; });
  return result;
}

DrawnParticipant drawn_participant(const Participant& participant, std::uint32_t prototype) {
  DrawnParticipant drawn;
  drawn.prototype = prototype;
  drawn.world_from_vehicle = participant.world_from_vehicle;
  drawn.paint = body_color(participant.paint);
  drawn.lamps = participant.lamps;
  drawn.front_steer_rad = participant.front_steer_rad;
  drawn.wheel_spin_rad = participant.wheel_spin_rad;
  drawn.speed_mps = glm::length(participant.velocity_mps);
  drawn.number = participant.id;
  const VehicleModel model = shape_of(participant);
  if (is_box(participant)) {
    drawn.stretch = glm::vec3(box_size_m(participant));
  } else if (model.kind == ParticipantKind::pedestrian) {
    drawn.thrown_rad = participant.wheel_lift_m;
    // One who flies or slides does not walk, however fast.
    const double strides_per_s = participant.wheel_spin_radps / (2.0 * std::numbers::pi);
    drawn.speed_mps = strides_per_s * stride_m(strides_per_s);
  } else {
    drawn.wheel_lift_m = participant.wheel_lift_m;
  }
  drawn.velocity_mps = participant.velocity_mps;
  drawn.yaw_rate_radps = participant.angular_velocity_radps.z;
  drawn.tail_x_m = -model.rear_overhang_m;
  drawn.heavy = model.kind == ParticipantKind::lorry || model.kind == ParticipantKind::bus;
  drawn.raises_spray =
      model.kind != ParticipantKind::pedestrian && model.kind != ParticipantKind::object && model.wheel_radius_m > 0.0;
  return drawn;
}

}  // namespace septet::instant
