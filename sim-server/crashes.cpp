#include "sim-server/crashes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "sim-server/effect_surroundings.hpp"

namespace septet::server {
namespace {

constexpr double free_again_s = 1.0;  // Until a further contact with a barrier is another crash.

std::vector<debris::MountedPart> parts_of(const Participant& participant, const debris::Box& box) {
  switch (vehicle_models()[participant.model].kind) {
    case ParticipantKind::car:
    case ParticipantKind::van:
    case ParticipantKind::ambulance: return debris::passenger_car_parts(box.half_size_m);
    default: return {};
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

/// The driver's car against another body. Answers the closing speed, 0 where they do not touch or drift apart.
double crash_with(const Participant& car, debris::CrashBody other, const debris::ContactWorld& world, CrashMemory& memory,
                  debris::State& debris, Random& random, CrashOutcome& outcome, std::vector<debris::MountedPart>* left) {
  const bool barrier = std::isinf(other.mass_kg);
  debris::Crash blow;
  blow.first = body_of(car, memory.parts);
  blow.second = std::move(other);
  const auto contact = contact_of(blow.first.box, blow.second.box);
  if (!contact) return 0.0;
  blow.point_m = contact->point_m;
  blow.normal = contact->normal;
  if (barrier) {
    // A stretch of barrier has no ends: it is only ever met from its sides.
    const RigidTransform& stretch = blow.second.box.world_from_box;
    const Vec3 side = stretch.orientation * Vec3(0.0, 1.0, 0.0);
    blow.normal = glm::dot(blow.first.box.world_from_box.position_m - stretch.position_m, side) < 0.0 ? -side : side;
  }
  const double closing = glm::dot(blow.second.box.velocity_mps - blow.first.box.velocity_mps, blow.normal);
  if (closing < debris::least_crash_speed_mps) return 0.0;
  const debris::CrashReport report = debris::crash(debris, blow, world, random);
  ++outcome.crashes;
  outcome.pieces += static_cast<int>(report.pieces.size());
  const double own = blow.first.mass_kg, common = barrier ? own : own * blow.second.mass_kg / (own + blow.second.mass_kg);
  outcome.impulse_on_driver_ns += blow.normal * (common * closing) + blow.first.impulse_ns;
  memory.parts[car.id] = std::move(blow.first.parts);
  if (left) *left = std::move(blow.second.parts);
  return closing;
}

}  // namespace

double vehicle_mass_kg(const Participant& participant) {
  switch (vehicle_models()[participant.model].kind) {
    case ParticipantKind::lorry:
    case ParticipantKind::bus: return 16'000.0;
    case ParticipantKind::van: return 2'400.0;
    case ParticipantKind::ambulance: return 3'500.0;
    case ParticipantKind::motorcycle: return 290.0;
    case ParticipantKind::bicycle:
    case ParticipantKind::pedestrian: return 80.0;
    default: return 1'500.0;
  }
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
    return box.half_size_m.x * std::abs(glm::dot(axes[0], axis)) + box.half_size_m.y * std::abs(glm::dot(axes[1], axis));
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
  // Between what of each box lies nearest to the other one's middle.
  const auto nearest = [](const debris::Box& box, const Vec3& point) {
    const Vec3 local = inverse(box.world_from_box) * point;
    return box.world_from_box * glm::clamp(local, -box.half_size_m, box.half_size_m);
  };
  contact.point_m = 0.5 * (nearest(a, b.world_from_box.position_m) + nearest(b, nearest(a, b.world_from_box.position_m)));
  return contact;
}

CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const std::vector<debris::Box>& barriers, const debris::ContactWorld& world, double step_s,
                             CrashMemory& memory, debris::State& debris, Random& random) {
  CrashOutcome outcome;
  const auto find = [&](ParticipantId id) { return std::ranges::find(participants, id, &Participant::id); };
  const auto car = find(driver);
  if (car == participants.end()) return outcome;
  for (const ParticipantId id : memory.struck_by_driver) {
    const auto other = find(id);
    if (other == participants.end()) continue;
    std::vector<debris::MountedPart> left;
    if (crash_with(*car, body_of(*other, memory.parts), world, memory, debris, random, outcome, &left) > 0.0)
      memory.parts[id] = std::move(left);
  }
  memory.struck_by_driver.clear();

  const debris::Box own = body_box(*car);
  bool touches = false;
  for (const debris::Box& barrier : barriers) {
    if (!contact_of(own, barrier)) continue;
    touches = true;
    if (memory.at_barrier) break;
    debris::CrashBody body;
    body.box = barrier;
    outcome.barrier_closing_mps = crash_with(*car, std::move(body), world, memory, debris, random, outcome, nullptr);
    if (outcome.barrier_closing_mps > 0.0) {
      memory.at_barrier = true;
      break;
    }
  }
  memory.barrier_contact_s = touches ? 0.0 : memory.barrier_contact_s + step_s;
  if (memory.barrier_contact_s > free_again_s) memory.at_barrier = false;
  return outcome;
}

}  // namespace septet::server
