#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scenario/model/misc_object.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "engine/world/indicator.hpp"
#include "engine/world/limbs.hpp"
#include "engine/world/paint.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::scenario {
namespace {

constexpr double braking_mps2 = -0.7;  ///< Gentler deceleration comes from lifting the accelerator.

Lamps lamps_now(const EntityState& entity, ParticipantId id, double time_s) {
  Lamps lamps = entity.lamps;
  const bool blink = indicator_is_lit(time_s, id);
  if (entity.lateral_control.active && entity.lateral_control.lane_change) {
    lamps.set(entity.lateral_control.to_the_left ? Lamp::indicator_left : Lamp::indicator_right, true);
  }
  for (const Lamp indicator : {Lamp::indicator_left, Lamp::indicator_right}) {
    if (lamps.has(indicator)) lamps.set(indicator, blink);
  }
  if (entity.acceleration_mps2 < braking_mps2) lamps.set(Lamp::brake, true);
  return lamps;
}

Participant box_participant(ParticipantId id, const Entity& entity, const EntityState& from) {
  Participant box;
  box.id = id;
  box.model = entity.model;
  box.paint = static_cast<std::uint8_t>(id % body_colors.size());
  set_box_size({entity.box.length_m, entity.box.width_m, entity.box.height_m}, box);
  box.world_from_vehicle = from.world_from_entity;
  box.world_from_vehicle.position_m = from.world_from_entity * foot_of_box_m(entity);
  box.velocity_mps = from.velocity_mps;
  box.acceleration_mps2 = from.acceleration_vector_mps2;
  box.angular_velocity_radps = from.angular_velocity_radps;
  return box;
}

}  // namespace

void append_participants(const Scenario& scenario, const ScenarioState& state, ParticipantId first_id,
                         std::vector<Participant>& participants) {
  for (EntityIndex i = 0; i < state.entities.size(); ++i) {
    const EntityState& from = state.entities[i];
    const Entity& entity = scenario.entities[i];
    if (!from.active || from.external || from.at_road_end_s > 0.0) continue;
    if (entity.kind == EntityKind::misc_object) {
      // The effects stage makes things of those that break.
      if (object_form(entity) == ObjectForm::box) participants.push_back(box_participant(first_id + i, entity, from));
      continue;
    }
    Participant participant;
    participant.id = first_id + i;
    participant.model = entity.model;
    const VehicleModel& model = vehicle_models()[entity.model];
    // The standard's vehicles have no colour: private vehicles and people's jackets take the colours in turn.
    if (model.kind == ParticipantKind::car || model.kind == ParticipantKind::van ||
        model.kind == ParticipantKind::pedestrian)
      participant.paint = static_cast<std::uint8_t>(i % body_colors.size());
    participant.lamps = lamps_now(from, participant.id, state.time_s);
    participant.world_from_vehicle = from.world_from_entity;
    participant.velocity_mps = from.velocity_mps;
    participant.acceleration_mps2 = from.acceleration_vector_mps2;
    participant.angular_velocity_radps = from.angular_velocity_radps;
    const Vec3 up = from.world_from_entity.orientation * Vec3(0.0, 0.0, 1.0);
    const double speed = from.speed_mps;
    if (std::abs(speed) > 0.5) {
      participant.front_steer_rad = std::atan(model.wheelbase_m * glm::dot(from.angular_velocity_radps, up) / speed);
    }
    if (model.kind == ParticipantKind::pedestrian) {
      constexpr double turn_rad = 2.0 * std::numbers::pi;
      participant.wheel_spin_rad = turn_rad * from.strides;
      participant.wheel_spin_radps = turn_rad * strides_hz(speed);
    } else {
      participant.wheel_spin_rad = from.wheel_angle_rad;
      participant.wheel_spin_radps = model.wheel_radius_m > 0.0 ? speed / model.wheel_radius_m : 0.0;
    }
    participants.push_back(participant);
  }
}

}  // namespace septet::scenario
