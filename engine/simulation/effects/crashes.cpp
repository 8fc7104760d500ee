#include "engine/simulation/effects/crashes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

std::vector<debris::MountedPart> parts_of(const Participant& participant, const debris::Box& box) {
  switch (vehicle_models()[participant.model].kind) {
    case ParticipantKind::car:
    case ParticipantKind::van:
    case ParticipantKind::ambulance:
      return debris::passenger_car_parts(box.half_size_m);
    default:
      return {};
  }
}

debris::CrashBody body_of(const Participant& participant, const MountedParts& parts) {
  debris::CrashBody body;
  body.box = body_box(participant);
  body.mass_kg = vehicle_mass_kg(participant);
  const auto known = parts.find(participant.id);
  body.parts = known != parts.end() ? known->second : parts_of(participant, body.box);
  return body;
}

void note_glass(ParticipantId vehicle, const debris::CrashBody& body, const Vec3& point_m, double closing_mps,
                CrashOutcome& outcome) {
  const auto is_windscreen = [](const debris::MountedPart& part) { return part.part == debris::Part::windscreen; };
  const bool gone = std::ranges::none_of(body.parts, is_windscreen);
  const Vec3 local_m = inverse(body.box.world_from_box) * point_m;
  outcome.glass.push_back(
      {vehicle, gone, std::clamp(0.5 + 0.5 * local_m.y / body.box.half_size_m.y, 0.0, 1.0), closing_mps});
}

void throw_parts(const Participant& car, debris::Crash& blow, const debris::ContactWorld& world, CrashMemory& memory,
                 debris::State& debris, Random& random, CrashOutcome& outcome) {
  const debris::CrashReport report = debris::crash(debris, blow, world, random);
  ++outcome.crashes;
  note_glass(car.id, blow.first, blow.point_m, report.closing_speed_mps, outcome);
  outcome.pieces += static_cast<int>(report.pieces.size());
  outcome.impulse_on_driver_ns += blow.first.impulse_ns;
  memory.parts[car.id] = std::move(blow.first.parts);
}

void crash_with_vehicle(const Participant& car, const Participant& other, const debris::ContactWorld& world,
                        CrashMemory& memory, debris::State& debris, Random& random, CrashOutcome& outcome) {
  debris::Crash blow;
  blow.first = body_of(car, memory.parts);
  blow.second = body_of(other, memory.parts);
  const auto contact = contact_of(blow.first.box, blow.second.box);
  if (!contact) return;
  blow.point_m = contact->point_m;
  blow.normal = contact->normal;
  const double closing = glm::dot(blow.second.box.velocity_mps - blow.first.box.velocity_mps, blow.normal);
  if (closing < debris::least_crash_speed_mps) return;
  const double common = blow.first.mass_kg * blow.second.mass_kg / (blow.first.mass_kg + blow.second.mass_kg);
  outcome.impulse_on_driver_ns += blow.normal * (common * closing);
  throw_parts(car, blow, world, memory, debris, random, outcome);
  note_glass(other.id, blow.second, blow.point_m, closing, outcome);
  for (const MadeDent& dent : dents_of_crash(car, other, blow.normal, closing)) outcome.dents.push_back(dent);
  memory.parts[other.id] = std::move(blow.second.parts);
}

/// Uses the car's motion at the first touch; its hull has taken the impact itself.
void crash_with_standing(const Participant& car, const vehicle::HullTouch& touch, const debris::ContactWorld& world,
                         CrashMemory& memory, debris::State& debris, Random& random, CrashOutcome& outcome) {
  if (touch.closing_speed_mps < debris::least_crash_speed_mps) return;
  debris::Crash blow;
  blow.first = body_of(car, memory.parts);
  blow.first.box.angular_velocity_radps = touch.angular_velocity_radps;
  blow.first.box.velocity_mps = touch.velocity_mps;
  blow.point_m = touch.point_m;
  blow.normal = touch.normal;
  constexpr double half_m = 0.5;  // Half width of the struck area.
  blow.second.box.world_from_box = {touch.point_m - half_m * touch.normal,
                                    orientation_from_angles(std::atan2(touch.normal.y, touch.normal.x), 0.0, 0.0)};
  blow.second.box.half_size_m = Vec3(half_m);
  throw_parts(car, blow, world, memory, debris, random, outcome);
  for (const MadeDent& dent : dents_of_touch(car, touch)) outcome.dents.push_back(dent);
}

}  // namespace

double vehicle_mass_kg(const Participant& participant) {
  return vehicle_body(vehicle_models()[participant.model].kind).mass_kg;
}

std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b) {
  const auto axes_of = [](const debris::Box& box) {
    const Vec3 x = box.world_from_box.orientation * Vec3(1.0, 0.0, 0.0);
    const Vec2 forward = glm::normalize(Vec2(x.x, x.y));
    return std::array<Vec2, 2>{forward, Vec2(-forward.y, forward.x)};
  };
  const auto own_a = axes_of(a), own_b = axes_of(b);
  const Vec3 between = a.world_from_box.position_m - b.world_from_box.position_m;
  if (std::abs(between.z) > a.half_size_m.z + b.half_size_m.z) return std::nullopt;
  const auto reach = [](const debris::Box& box, const std::array<Vec2, 2>& axes, const Vec2& axis) {
    return box.half_size_m.x * std::abs(glm::dot(axes[0], axis)) +
           box.half_size_m.y * std::abs(glm::dot(axes[1], axis));
  };
  BoxContact contact;
  contact.depth_m = INFINITY;
  for (const Vec2& axis : {own_a[0], own_a[1], own_b[0], own_b[1]}) {
    const double apart = glm::dot(Vec2(between.x, between.y), axis);
    const double depth = reach(a, own_a, axis) + reach(b, own_b, axis) - std::abs(apart);
    if (depth < 0.0) return std::nullopt;
    if (depth >= contact.depth_m) continue;
    contact.depth_m = depth;
    const double side = apart < 0.0 ? -1.0 : 1.0;
    contact.normal = {side * axis.x, side * axis.y, 0.0};
  }
  // Midpoint between the point of each box nearest to the other one's middle.
  const auto nearest = [](const debris::Box& box, const Vec3& point) {
    const Vec3 local = inverse(box.world_from_box) * point;
    return box.world_from_box * glm::clamp(local, -box.half_size_m, box.half_size_m);
  };
  contact.point_m =
      0.5 * (nearest(a, b.world_from_box.position_m) + nearest(b, nearest(a, b.world_from_box.position_m)));
  return contact;
}

CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris,
                             Random& random) {
  CrashOutcome outcome;
  const auto find = [&](ParticipantId id) { return std::ranges::find(participants, id, &Participant::id); };
  const auto car = find(driver);
  if (car == participants.end()) return outcome;
  for (const ParticipantId id : memory.struck_by_driver)
    if (const auto other = find(id); other != participants.end())
      crash_with_vehicle(*car, *other, world, memory, debris, random, outcome);
  for (const vehicle::HullTouch& touch : memory.struck_standing)
    crash_with_standing(*car, touch, world, memory, debris, random, outcome);
  memory.struck_by_driver.clear();
  memory.struck_standing.clear();
  return outcome;
}

}  // namespace septet::simulation
