#include "sim-server/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/core/hash.hpp"
#include "engine/effects/smoke/visibility.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/world/indicator.hpp"
#include "sim-server/effect_surroundings.hpp"
#include "sim-server/way_ahead.hpp"
#include "sim-server/wheel_ground.hpp"

namespace septet::server {
namespace {

const char* name_of(scenario::ElementStatus status) {
  switch (status) {
    case scenario::ElementStatus::standby: return "standby";
    case scenario::ElementStatus::running: return "running";
    case scenario::ElementStatus::complete: return "complete";
  }
  return "";
}

constexpr double tick_s = 1.0 / tick_rate_hz;
constexpr int car_steps = 8;  // About 1 kHz: what the wheels' spin and hop want.

/// A number that has gone bad is reset where it is; this tells of it.
void note_bad_numbers(std::uint32_t count, std::optional<ParticipantId> participant, const char* reset, SimulationState& state,
                      std::vector<SimulationEvent>& events) {
  if (count == 0) return;
  state.diagnostics.bad_numbers += count;
  events.push_back({"bad_number", participant, fmt::format("count={} reset={}", count, reset)});
}

/// What came as no number counts as 0: nobody touches that control.
std::uint32_t reset_bad_numbers(DriverInput& input) {
  std::uint32_t count = 0;
  for (double* value : {&input.steering_wheel_rad, &input.accelerator, &input.brake, &input.clutch, &input.gaze_heading_rad})
    if (!std::isfinite(*value)) {
      *value = 0.0;
      ++count;
    }
  return count;
}

/// A wheel that begins to touch a kerb's edge, for the log: on the way up or down.
void note_kerb(std::size_t wheel, const Vec3& centre_m, const vehicle::WheelGround& ground, const SimulationModel& model, SimulationState& state,
               std::vector<SimulationEvent>& events) {
  constexpr std::array names{"front_left", "front_right", "rear_left", "rear_right"};
  const bool touches = ground.edge_m && glm::distance(centre_m, *ground.edge_m) <= model.car.tyre.radius_m;
  if (touches && !state.at_kerb[wheel])
    events.push_back({"kerb", std::nullopt,
                      fmt::format("wheel={} height_m={:.3f} speed_mps={:.2f}", names[wheel], ground.edge_m->z - ground.point_m.z,
                                  glm::length(state.car.velocity_mps))});
  state.at_kerb[wheel] = touches;
}

/// The road's surface under each wheel, and how slippery it is there.
vehicle::Ground ground_below(const SimulationModel& model, SimulationState& state, std::vector<SimulationEvent>& events) {
  const auto centres = vehicle::wheel_centres_m(model.car, state.car);
  const Environment& sky = state.scenario.environment;
  const RoadWeather weather{sky.road_wetness, sky.snow_cover, sky.temperature_k, state.scenario.friction_scale};
  const Vec2 heading{state.car.world_from_body.orientation * Vec3(1.0, 0.0, 0.0)};
  const Vec2 ahead = glm::length(heading) > 0.1 ? glm::normalize(heading) : Vec2(1.0, 0.0);
  vehicle::Ground ground;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    vehicle::WheelGround& wheel = ground[i];
    if (find_wheel_ground(model.roads, weather, centres[i], state.car_road.has_value(), state.wheel_roads[i], wheel)) {
      find_kerb(model.roads, centres[i], ahead, model.car.tyre.radius_m, state.wheel_roads[i], wheel);
      note_kerb(i, centres[i], wheel, model, state, events);
      wheel.point_m.z += obstacle_height_m(state.effects, wheel.point_m);
      continue;
    }
    // Far off every road the ground goes on level at the height of the wheel's last contact.
    wheel.point_m = {centres[i].x, centres[i].y, state.car.world_from_body.position_m.z - model.car.body.mass_centre_z_m};
    wheel.friction = std::min(surface_friction(nullptr, weather), 0.5);
    wheel.rolling_resistance = 4.0;
  }
  return ground;
}

/// What the hull met, for the log and for the debris.
void note_hull(const vehicle::HullReport& report, SimulationState& state, std::vector<SimulationEvent>& events) {
  constexpr double least_mps = 0.5;  // Less is leaning on it.
  state.effects.crashes.struck_standing.insert(state.effects.crashes.struck_standing.end(), report.begun.begin(), report.begun.end());
  for (const vehicle::HullTouch& touch : report.over) {
    const double delta_v_mps = glm::length(touch.delta_v_mps);
    if (touch.closing_speed_mps < least_mps && delta_v_mps < least_mps) continue;
    ++state.diagnostics.collisions;
    events.push_back({"collision", std::nullopt,
                      fmt::format("{} closing_speed_mps={:.2f} delta_v_mps={:.2f}", name_of(touch.kind), touch.closing_speed_mps, delta_v_mps)});
  }
}

vehicle::VehicleOutputs advance_car(const SimulationModel& model, const DriverInput& input, SimulationState& state,
                                    std::vector<SimulationEvent>& events) {
  const auto ground = ground_below(model, state, events);
  const std::uint32_t bad_before = state.car.bad_numbers;
  const double on_the_way_m = glm::length(state.car.velocity_mps) * tick_s;
  const auto obstacles = model.obstacles ? model.obstacles->near(Vec2(state.car.world_from_body.position_m), vehicle::hull_reach_m(model.car) + on_the_way_m)
                                         : std::vector<Obstacle>{};
  vehicle::HullReport met;
  for (int i = 0; i < car_steps; ++i) {
    vehicle::advance_vehicle(model.car, input, ground, tick_s / car_steps, state.car);
    vehicle::advance_hull(model.car, obstacles, tick_s / car_steps, state.car, state.hull, met);
  }
  note_hull(met, state, events);
  note_bad_numbers(state.car.bad_numbers - bad_before, driver_participant, "car", state, events);
  const auto out = vehicle::outputs(model.car, state.car);
  const Vec3 origin = out.world_from_vehicle.position_m;
  if (const auto place = road::locate(model.roads, {origin.x, origin.y}, state.car_road ? &*state.car_road : nullptr, 60.0))
    state.car_road = place->position;
  return out;
}

Lamps driver_lamps(const DriverInput& input, const vehicle::VehicleOutputs& car, double time_s) {
  Lamps lamps;
  const bool blink = indicator_is_lit(time_s);
  lamps.set(Lamp::brake, input.brake > 0.02);
  lamps.set(Lamp::reverse, car.gear < 0);
  lamps.set(Lamp::indicator_left, blink && (input.hazard_lights || input.indicator == IndicatorStalk::left));
  lamps.set(Lamp::indicator_right, blink && (input.hazard_lights || input.indicator == IndicatorStalk::right));
  lamps.set(Lamp::low_beam, input.low_beam);
  lamps.set(Lamp::high_beam, input.high_beam);
  lamps.set(Lamp::horn, input.horn);
  return lamps;
}

Participant car_participant(const SimulationModel& model, const SimulationState& state, const vehicle::VehicleOutputs& out) {
  Participant car;
  car.id = driver_participant;
  car.model = model.scenario.entities[model.driver_entity].model;
  car.paint = 7;
  car.lamps = driver_lamps(state.input, out, state.time_s());
  car.world_from_vehicle = out.world_from_vehicle;
  car.velocity_mps = out.velocity_mps;
  car.acceleration_mps2 = out.acceleration_mps2;
  car.angular_velocity_radps = out.angular_velocity_radps;
  car.front_steer_rad = out.front_steer_rad;
  car.wheel_spin_rad = out.wheel_spin_rad;
  car.wheel_spin_radps = out.wheel_spin_radps;
  car.wheel_lift_m = out.wheel_lift_m;
  return car;
}

DriverCar driver_car(const SimulationModel& model, const SimulationState& state, const vehicle::VehicleOutputs& out) {
  DriverCar car;
  car.participant = driver_participant;
  car.speed_mps = out.speed_mps;
  car.engine_radps = out.engine_radps;
  car.gear = static_cast<std::int8_t>(out.gear);
  car.steering_wheel_rad = state.input.steering_wheel_rad;
  car.steering_torque_nm = out.steering_torque_nm;
  car.accelerator = state.input.accelerator;
  car.brake = state.input.brake;
  car.clutch = state.input.clutch;
  car.yaw_rate_radps = out.yaw_rate_radps;
  car.gaze_heading_rad = state.input.gaze_heading_rad;
  // Lateral position is that of the middle of the front axle (SAE J2944, reference point 2), which the driver steers.
  const Vec3 front = out.world_from_vehicle * Vec3(model.car.body.wheelbase_m, 0.0, 0.0);
  const auto place = road::locate(model.roads, {front.x, front.y}, state.car_road ? &*state.car_road : nullptr, 60.0);
  if (place && place->lanes.lane != 0 && place->lanes.outside_m <= 0.0) {
    car.road = place->position.road;
    car.lane = place->lanes.lane;
    car.road_s_m = place->position.s_m;
    car.lane_width_m = road::lane_width_m(model.roads, car.road, car.lane, car.road_s_m);
    const bool along = road::runs_along_s(model.roads, {car.road, car.lane, car.road_s_m, 0.0});
    car.lateral_position_m = along ? place->lanes.offset_m : -place->lanes.offset_m;
  }
  return car;
}

/// No part of a vehicle is farther than this from its origin.
double reach_m(const VehicleModel& model) { return model.length_m + model.width_m; }

void notice_collisions(Snapshot& snapshot, SimulationState& state, std::vector<SimulationEvent>& events) {
  const Participant* car = find_participant(snapshot, driver_participant);
  std::vector<ParticipantId> touching;
  double apart_m = 0.0;  // From here on nobody can touch the car: nearly everybody is, and needs no more than that.
  for (const VehicleModel& model : vehicle_models()) apart_m = std::max(apart_m, 2.0 * reach_m(model));
  for (const Participant& other : snapshot.participants) {
    if (other.id == driver_participant || !car) continue;
    const Vec2 apart = other.world_from_vehicle.position_m - car->world_from_vehicle.position_m;
    if (glm::dot(apart, apart) > apart_m * apart_m || !contact_of(body_box(*car), body_box(other))) continue;
    touching.push_back(other.id);
    if (std::ranges::binary_search(state.touching, other.id)) continue;
    ++state.diagnostics.collisions;
    state.effects.crashes.struck_by_driver.push_back(other.id);
    events.push_back({"collision", other.id, fmt::format("closing_speed_mps={:.2f}", glm::length(car->velocity_mps - other.velocity_mps))});
  }
  state.touching = std::move(touching);
  snapshot.diagnostics = state.diagnostics;
}

/// Everybody whom traffic has to mind and does not move itself; the driver's car comes first.
std::vector<traffic::ForeignVehicle> foreign_vehicles(const SimulationModel& model, const SimulationState& state,
                                                      const vehicle::VehicleOutputs& car) {
  std::vector<Participant> others{car_participant(model, state, car)};
  scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, others);
  std::vector<traffic::ForeignVehicle> foreign;
  foreign.reserve(others.size());
  for (const Participant& p : others) foreign.push_back({p.id, p.model, p.world_from_vehicle, p.velocity_mps, p.lamps});
  return foreign;
}

/// Starts and ends the swarms that the storyboard asked for.
void apply_swarms(const SimulationModel& model, const scenario::StepResult& step, const vehicle::VehicleOutputs& car, SimulationState& state) {
  for (const auto& swarm : step.swarms) {
    traffic::TrafficParameters parameters = traffic::motorway_traffic(swarm.vehicle_count, swarm.semi_major_axis_m);
    parameters.first_id = first_traffic_participant;
    if (const double both = swarm.same_direction_weight + swarm.opposite_direction_weight; both > 0.0)
      parameters.opposite_share = swarm.opposite_direction_weight / both;
    std::vector<traffic::KindShare> mix;
    for (const auto& entry : swarm.categories) mix.push_back({scenario::kind_of_category(entry.category), entry.weight});
    traffic::set_mix(parameters, mix);
    state.traffic->start(parameters, foreign_vehicles(model, state, car));
  }
  if (!step.stopped_traffic.empty()) state.traffic->stop();
}

/// Everybody who takes part, ascending id, in the memory of `participants`.
std::vector<Participant> participants_now(const SimulationModel& model, const SimulationState& state, const vehicle::VehicleOutputs& car,
                                          std::vector<Participant> participants = {}) {
  participants.clear();
  participants.reserve(256);
  participants.push_back(car_participant(model, state, car));
  scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, participants);
  state.traffic->append_participants(participants);
  if (!std::ranges::is_sorted(participants, {}, &Participant::id)) std::ranges::sort(participants, {}, &Participant::id);
  show_damage(state.effects, participants);
  return participants;
}

/// Spills and burns what the storyboard asked for.
void apply_effects(const SimulationModel& model, const scenario::StepResult& step, const vehicle::VehicleOutputs& car, SimulationState& state) {
  using Kind = scenario::EffectAction::Kind;
  for (const scenario::EffectAction& action : step.effects) {
    if (action.kind == Kind::spill) {
      spill(action, model.scenario.entities[action.entity], state.scenario.entities[action.entity], state.effects);
      continue;
    }
    const ParticipantId id = action.entity == model.driver_entity ? driver_participant : first_scripted_participant + action.entity;
    if (action.kind == Kind::extinguish) extinguish(id, state.effects.fires);
    if (action.kind != Kind::ignite) continue;
    const auto participants = participants_now(model, state, car);
    if (const auto burning = std::ranges::find(participants, id, &Participant::id); burning != participants.end())
      ignite(model.roads, *burning, model.seed, state.effects.fires);
  }
}

void advance_storyboard(const SimulationModel& model, const vehicle::VehicleOutputs& car, SimulationState& state,
                        std::vector<SimulationEvent>& events) {
  scenario::place_external(model.roads, model.driver_entity, car.world_from_vehicle, car.velocity_mps, car.acceleration_mps2, state.scenario);
  const auto step = scenario::advance_scenario(model.scenario, model.roads, tick_s, state.scenario);
  for (const auto& event : step.events)
    events.push_back({"scenario", std::nullopt, fmt::format("element={} state={}", model.scenario.element_names[event.element], name_of(event.to))});
  for (const scenario::EntityIndex entity : step.left)
    events.push_back({"scenario", first_scripted_participant + entity, fmt::format("entity={} state=left_at_road_end", model.scenario.entities[entity].name)});
  for (const scenario::EntityIndex entity : step.reset)
    note_bad_numbers(1, first_scripted_participant + entity, "entity", state, events);
  apply_swarms(model, step, car, state);
  apply_effects(model, step, car, state);
}

/// Once a second, where there is smoke around the driver: how far he sees.
void note_visibility(const SimulationState& state, std::vector<SimulationEvent>& events) {
  if (!state.effects.fires.smoke || state.tick % static_cast<Tick>(tick_rate_hz) != 0) return;
  const double extinction = smoke::extinction_per_m(*state.effects.fires.smoke, state.car.world_from_body.position_m + Vec3(0.0, 0.0, 0.6));
  const auto dull = smoke::visibility_m(extinction, false), shining = smoke::visibility_m(extinction, true);
  if (dull && *dull < 200.0) events.push_back({"visibility", driver_participant, fmt::format("reflecting_m={:.1f} shining_m={:.1f}", *dull, *shining)});
}

void run_effects(const SimulationModel& model, const vehicle::VehicleOutputs& car, SimulationState& state, std::vector<SimulationEvent>& events) {
  if (state.tick % effects_step_ticks != 0) return;
  if (effects_are_still(state.effects)) return;
  const Environment& weather = state.scenario.environment;
  const double friction = vehicle::weather_friction(weather.road_wetness, weather.snow_cover, weather.temperature_k);
  const auto participants = participants_now(model, state, car);
  const EffectsReport report = advance_effects(
      {model.roads, model.obstacles.get(), participants, weather, driver_participant, friction / vehicle::weather_friction(0.0, 0.0, 293.0), state.tick, tick_s}, state.effects);
  state.car.velocity_mps += report.impulse_on_driver_ns / model.car.body.mass_kg;
  note_visibility(state, events);
  if (report.crashes.pieces > 0) events.push_back({"debris", std::nullopt, fmt::format("pieces={}", report.crashes.pieces)});
  if (report.fractures > 0) events.push_back({"fracture", std::nullopt, fmt::format("faces={}", report.fractures)});
  note_bad_numbers(static_cast<std::uint32_t>(report.bad_numbers), std::nullopt, "debris", state, events);
}

}  // namespace

Expected<SimulationState> initial_state(const SimulationModel& model, std::unique_ptr<traffic::TrafficEngine> traffic) {
  SimulationState state;
  state.traffic = std::move(traffic);
  scenario::StepResult init;
  auto started = scenario::start_scenario(model.scenario, model.roads, model.driver_entity, init);
  if (!started) return tl::unexpected(started.error());
  state.scenario = std::move(*started);
  const auto& entity = state.scenario.entities[model.driver_entity];
  if (!entity.active)
    return tl::unexpected(scenario::why_without_place(model.scenario, model.driver_entity));
  state.car = vehicle::standstill(model.car, entity.world_from_entity, entity.speed_mps);
  apply_swarms(model, init, vehicle::outputs(model.car, state.car), state);
  state.effects = initial_effects(model.scenario, state.scenario, model.seed);
  apply_effects(model, init, vehicle::outputs(model.car, state.car), state);
  if (auto error = state.traffic->take_error()) return tl::unexpected(std::move(*error));
  return state;
}

Snapshot server_step(const SimulationModel& model, const DriverInput& input, SimulationState& state,
                     std::vector<SimulationEvent>& events, Snapshot old) {
  ++state.tick;
  state.input = input;
  note_bad_numbers(reset_bad_numbers(state.input), driver_participant, "controls", state, events);
  const auto car = advance_car(model, state.input, state, events);
  advance_storyboard(model, car, state, events);
  state.traffic->advance(foreign_vehicles(model, state, car), tick_s);
  note_bad_numbers(state.traffic->take_bad_numbers(), std::nullopt, "traffic", state, events);
  run_effects(model, car, state, events);
  Snapshot snapshot = capture_snapshot(model, state, std::move(old));
  notice_collisions(snapshot, state, events);
  look_ahead(model, snapshot, state.effects, state.scenario);
  return snapshot;
}

Snapshot capture_snapshot(const SimulationModel& model, const SimulationState& state, Snapshot old) {
  const auto car = vehicle::outputs(model.car, state.car);  // Again: the effects push the car.
  Snapshot snapshot;
  snapshot.tick = state.tick;
  snapshot.simulated_time_s = state.time_s();
  snapshot.state_hash = hash_state(state);
  snapshot.environment = state.scenario.environment;
  snapshot.driver_car = driver_car(model, state, car);
  snapshot.participants = participants_now(model, state, car, std::move(old.participants));
  snapshot.effects = effect_keyframes(state.effects);
  snapshot.diagnostics = state.diagnostics;
  return snapshot;
}

std::uint64_t hash_state(const SimulationState& state) {
  StateHash hash;
  hash.add(state.tick);
  vehicle::hash_state(hash, state.car);
  vehicle::hash_hull(hash, state.hull);
  scenario::add_to_hash(state.scenario, hash);
  state.traffic->add_to_hash(hash);
  hash.add(state.effects.hash);
  hash.add(state.diagnostics.collisions);
  hash.add(state.diagnostics.bad_numbers);
  return hash.value();
}

}  // namespace septet::server
