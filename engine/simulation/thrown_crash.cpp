#include "engine/simulation/thrown_crash.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/crash_recording.hpp"

namespace septet::simulation {
namespace {

/// Direction in plan from the vehicle to whom it meets.
Vec2 way_to_other(const person::Touches& touches) {
  const Vec2 level(touches.normal);
  const double length = glm::length(level);
  return length > 0.1 ? level / length : Vec2(1.0, 0.0);
}

/// Speed in plan along that way at which the vehicle's surface comes to whom it meets, who moves as a whole: what touches
/// first may be a limb that swings, or be met aslant.
double closing_in_plan_mps(const ThrownTouch& touch) {
  const Vec3 arm_m = touch.touches.point_m - touch.vehicle.world_from_vehicle.position_m;
  const Vec3 surface_mps = touch.vehicle.velocity_mps + glm::cross(touch.vehicle.angular_velocity_radps, arm_m);
  return std::max(0.0, glm::dot(Vec2(surface_mps - touch.other.velocity_mps), way_to_other(touch.touches)));
}

/// Change of speed by a plastic impact with another one, who may stand fast by an infinite mass.
double plastic_delta_v_mps(double closing_mps, double own_kg, double other_kg) {
  return std::isfinite(other_kg) ? closing_mps * other_kg / (own_kg + other_kg) : closing_mps;
}

}  // namespace

void tell_touch(const Model& model, const ThrownTouch& touch, State& state, std::vector<Event>& events) {
  const bool vehicle_first = touch.vehicle.id < touch.other.id;
  const Participant &first = vehicle_first ? touch.vehicle : touch.other,
                    &second = vehicle_first ? touch.other : touch.vehicle;
  const Vec2 to_second = vehicle_first ? way_to_other(touch.touches) : -way_to_other(touch.touches);
  const double closing_mps = closing_in_plan_mps(touch);
  const auto crashed = [&](const Participant& one) {
    return CrashedVehicle{one.id, mass_kg(model, state, one), one.velocity_mps, one.angular_velocity_radps};
  };
  VehicleCrash crash;
  crash.first = crashed(first), crash.second = crashed(second);
  crash.point_m = touch.touches.point_m;
  crash.normal = Vec3(-to_second, 0.0);
  crash.closing_speed_mps = closing_mps;
  state.effects.crashes.struck_vehicles.push_back(crash);

  // A person is taken along at once: the changes of speed are those of a plastic impact of the two masses.
  const double delta_v_mps = plastic_delta_v_mps(closing_mps, crash.first.mass_kg, crash.second.mass_kg),
               its_delta_v_mps = plastic_delta_v_mps(closing_mps, crash.second.mass_kg, crash.first.mass_kg);
  const bool by_first =
      glm::dot(Vec2(first.velocity_mps), to_second) >= -glm::dot(Vec2(second.velocity_mps), to_second);
  if (first.id == driver_participant) {
    ++state.diagnostics.collisions;
    events.push_back({"collision", second.id,
                      fmt::format("closing_speed_mps={:.2f} delta_v_mps={:.2f} by={}", closing_mps, delta_v_mps,
                                  by_first ? "driver" : "other")});
  } else {
    events.push_back(
        {"crash_of_others", first.id,
         fmt::format("with={} closing_speed_mps={:.2f} delta_v_mps={:.2f} its_delta_v_mps={:.2f} by={}", second.id,
                     closing_mps, delta_v_mps, its_delta_v_mps, by_first ? first.id : second.id)});
  }

  OpenCrash& record =
      open_crash({first.id, second.id, {Vec2(crash.point_m), to_second}, crash.point_m.z, closing_mps}, state);
  const auto note = [&](auto note_side, const Participant& one, double one_kg) {
    auto pushed = one.id == touch.vehicle.id ? pushed_body(model, state, one.id) : std::nullopt;
    if (pushed) pushed->heading_rad = heading_rad(one.world_from_vehicle.orientation);
    note_side(pushed ? *pushed : impact_side(one, one_kg).body, mass_centre_ahead_m(model, one), pushed.has_value(),
              record);
  };
  note(note_first, first, crash.first.mass_kg);
  note(note_second, second, crash.second.mass_kg);
}

void record_loss(ParticipantId vehicle, ParticipantId other, const Vec3& on_vehicle_ns, State& state) {
  if (on_vehicle_ns == Vec3(0.0)) return;
  OpenCrash* crash = find_open_crash(state, std::min(vehicle, other), std::max(vehicle, other));
  if (!crash) return;
  const bool vehicle_first = vehicle < other;
  // He may lie on the bonnet for a second in which wheels brake the vehicle: its change is that by him alone.
  CrashPush push{.first = crash->first, .second = crash->second};
  impact::Body& pushed = vehicle_first ? push.first : push.second;
  pushed.velocity_mps += Vec2(on_vehicle_ns) / pushed.mass_kg;
  push.on_second_ns = vehicle_first ? -Vec2(on_vehicle_ns) : Vec2(on_vehicle_ns);
  note_push(state.tick, push, *crash);
}

}  // namespace septet::simulation
