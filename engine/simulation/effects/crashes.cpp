#include "engine/simulation/effects/crashes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/simulation/effects/body_box.hpp"

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

debris::CrashBody body_of(const Participant& participant, double mass_kg, const MountedParts& parts) {
  debris::CrashBody body;
  body.box = body_box(participant);
  body.mass_kg = mass_kg;
  const auto known = parts.find(participant.id);
  body.origin = {participant.id, participant.model, participant.paint, {}};
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

/// Returns the pieces' kinetic energy.
double throw_parts(const Participant& car, debris::Crash& blow, const debris::ContactWorld& world, CrashMemory& memory,
                   debris::State& debris, Random& random, CrashOutcome& outcome) {
  const debris::CrashReport report = debris::crash(debris, blow, world, random);
  ++outcome.crashes;
  note_glass(car.id, blow.first, blow.point_m, report.closing_speed_mps, outcome);
  outcome.pieces += static_cast<int>(report.pieces.size());
  outcome.torn.push_back({car.id, blow.first.torn});
  memory.parts[car.id] = std::move(blow.first.parts);
  return report.kinetic_j;
}

Participant at_touch(const Participant& now, const CrashedVehicle& then) {
  Participant vehicle = now;
  vehicle.velocity_mps = then.velocity_mps;
  vehicle.angular_velocity_radps = then.angular_velocity_radps;
  return vehicle;
}

/// Uses both motions at the touch: the impact has changed them since.
void crash_of_vehicles(const Participant& first, const Participant& second, const VehicleCrash& struck,
                       ParticipantId driver, const debris::ContactWorld& world, CrashMemory& memory,
                       debris::State& debris, Random& random, CrashOutcome& outcome) {
  if (struck.closing_speed_mps < debris::least_crash_speed_mps) return;
  debris::Crash blow;
  blow.first = body_of(at_touch(first, struck.first), struck.first.mass_kg, memory.parts);
  blow.second = body_of(at_touch(second, struck.second), struck.second.mass_kg, memory.parts);
  blow.point_m = struck.point_m;
  blow.normal = struck.normal;
  const double kinetic_j = throw_parts(first, blow, world, memory, debris, random, outcome);
  outcome.broken_off.push_back({first.id, second.id, 0, blow.first.impulse_ns, blow.second.impulse_ns, kinetic_j});
  if (first.id == driver) outcome.impulse_on_driver_ns += blow.first.impulse_ns;
  note_glass(second.id, blow.second, blow.point_m, struck.closing_speed_mps, outcome);
  for (const MadeDent& dent : dents_of_crash(first, second, struck)) outcome.dents.push_back(dent);
  outcome.torn.push_back({second.id, blow.second.torn});
  memory.parts[second.id] = std::move(blow.second.parts);
}

/// Uses the vehicle's motion at the first touch; its hull has taken the impact itself.
void crash_with_standing(const Participant& car, const vehicle::HullTouch& touch, ParticipantId driver,
                         const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris, Random& random,
                         CrashOutcome& outcome) {
  if (touch.closing_speed_mps < debris::least_crash_speed_mps) return;
  debris::Crash blow;
  blow.first = body_of(car, touch.mass_kg, memory.parts);
  blow.first.box.angular_velocity_radps = touch.angular_velocity_radps;
  blow.first.box.velocity_mps = touch.velocity_mps;
  blow.point_m = touch.point_m;
  blow.normal = touch.normal;
  constexpr double half_m = 0.5;  // Half width of the struck area.
  blow.second.box.world_from_box = {touch.point_m - half_m * touch.normal,
                                    orientation_from_angles(std::atan2(touch.normal.y, touch.normal.x), 0.0, 0.0)};
  blow.second.box.half_size_m = Vec3(half_m);
  const double kinetic_j = throw_parts(car, blow, world, memory, debris, random, outcome);
  outcome.broken_off.push_back({car.id, std::nullopt, touch.run, blow.first.impulse_ns, Vec3(0.0), kinetic_j});
  if (car.id == driver) outcome.impulse_on_driver_ns += blow.first.impulse_ns;
  for (const MadeDent& dent : dents_of_touch(car, touch)) outcome.dents.push_back(dent);
}

bool are_level(const debris::Box& a, const debris::Box& b) {
  const double apart_m = std::abs(a.world_from_box.position_m.z - b.world_from_box.position_m.z);
  return apart_m <= a.half_size_m.z + b.half_size_m.z;
}

}  // namespace

bool overlap(const Participant& a, const Participant& b) {
  const debris::Box first = body_box(a), second = body_box(b);
  return are_level(first, second) &&
         impact::contact_of(outline_of(first, corner_m(a)), outline_of(second, corner_m(b))).has_value();
}

double contact_height_m(const debris::Box& a, const debris::Box& b) {
  const auto low = [](const debris::Box& box) { return box.world_from_box.position_m.z - box.half_size_m.z; };
  const auto high = [](const debris::Box& box) { return box.world_from_box.position_m.z + box.half_size_m.z; };
  return 0.5 * (std::max(low(a), low(b)) + std::min(high(a), high(b)));
}

std::optional<BoxContact> contact_of(const debris::Box& a, const debris::Box& b) {
  if (!are_level(a, b)) return std::nullopt;
  const auto contact = impact::contact_of(outline_of(a), outline_of(b));
  if (!contact) return std::nullopt;
  return BoxContact{Vec3(contact->place.point_m, contact_height_m(a, b)), Vec3(-contact->place.normal, 0.0),
                    -contact->gap_m};
}

CrashOutcome advance_crashes(const std::vector<Participant>& participants, ParticipantId driver,
                             const debris::ContactWorld& world, CrashMemory& memory, debris::State& debris,
                             Random& random) {
  CrashOutcome outcome;
  const auto find = [&](ParticipantId id) { return std::ranges::find(participants, id, &Participant::id); };
  for (const VehicleCrash& struck : memory.struck_vehicles) {
    const auto first = find(struck.first.id), second = find(struck.second.id);
    if (first != participants.end() && second != participants.end())
      crash_of_vehicles(*first, *second, struck, driver, world, memory, debris, random, outcome);
  }
  for (const StandingCrash& struck : memory.struck_standing)
    if (const auto vehicle = find(struck.vehicle); vehicle != participants.end())
      crash_with_standing(*vehicle, struck.touch, driver, world, memory, debris, random, outcome);
  memory.struck_vehicles.clear();
  memory.struck_standing.clear();
  return outcome;
}

}  // namespace septet::simulation
