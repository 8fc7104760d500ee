#include "engine/simulation/driver_car.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "engine/physics/vehicle/hull_outline.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/simulation/car_impacts.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/follow_motion.hpp"
#include "engine/simulation/ground_faces.hpp"
#include "engine/simulation/hull_crashes.hpp"
#include "engine/simulation/step_edges.hpp"
#include "engine/simulation/wheel_ground.hpp"
#include "engine/world/indicator.hpp"

namespace septet::simulation {
namespace {

constexpr double road_reach_m = 60.0;  ///< Roads farther off are not searched for.
constexpr int car_steps = 8;           // About 1 kHz, as the wheels' spin and hop require.

constexpr std::array<const char*, vehicle::wheel_count> wheel_names{"front_left", "front_right", "rear_left",
                                                                    "rear_right"};

/// Logs a wheel that begins to touch a kerb's edge, on the way up or down.
void note_kerb(std::size_t wheel, const Vec3& centre_m, const vehicle::WheelGround& ground, const Model& model,
               State& state, std::vector<Event>& events) {
  std::optional<KerbTouch>& kerb = state.kerbs[wheel];
  const auto nearest = std::ranges::min_element(ground.edges, {}, [&](const std::optional<vehicle::StepEdge>& edge) {
    return edge ? glm::distance(centre_m, edge->point_m) : std::numeric_limits<double>::infinity();
  });
  if (!*nearest || glm::distance(centre_m, (*nearest)->point_m) > model.car.tyre.radius_m) return kerb.reset();
  if (kerb) return;
  const Vec3 to_edge = (*nearest)->point_m - centre_m;
  kerb = {(*nearest)->point_m.z - ground.point_m.z,
          glm::dot(state.car.velocity_mps, to_edge) / std::max(glm::length(to_edge), 0.01)};
  events.push_back(
      {"kerb", std::nullopt,
       fmt::format("wheel={} height_m={:.3f} speed_mps={:.2f} closing_speed_mps={:.2f}", wheel_names[wheel],
                   kerb->height_m, glm::length(state.car.velocity_mps), kerb->closing_speed_mps)});
}

/// Tracks strikes: a wheel whose damage grows in this tick is being struck; the strike ends once it grows no longer.
void note_damage(std::size_t wheel, const vehicle::WheelDamage& before, double squeeze_m, State& state,
                 std::vector<Event>& events) {
  const vehicle::WheelDamage& damage = state.car.wheels[wheel].damage;
  std::optional<WheelStrike>& strike = state.strikes[wheel];
  if (damage.any() != before.any() || damage.rim_bend_m > before.rim_bend_m) {
    if (!strike) strike = {state.kerbs[wheel]};
    strike->squeeze_m = std::max(strike->squeeze_m, squeeze_m);
  } else if (strike) {
    const std::string kerb = strike->kerb ? fmt::format(" height_m={:.3f} closing_speed_mps={:.2f}",
                                                        strike->kerb->height_m, strike->kerb->closing_speed_mps)
                                          : "";
    events.push_back(
        {"wheel_damage", std::nullopt,
         fmt::format("wheel={}{} squeeze_m={:.3f} rim_bend_m={:.4f} toe_out_rad={:.4f} tyre=cut", wheel_names[wheel],
                     kerb, strike->squeeze_m, damage.rim_bend_m, damage.toe_out_rad())});
    strike.reset();
  }
}

/// Ground under each wheel, road or land, and its friction.
vehicle::Ground ground_below(const Model& model, State& state, std::vector<Event>& events) {
  const auto centres = vehicle::wheel_centres_m(model.car, state.car);
  const RoadWeather weather = road_weather(state);
  const Vec2 heading{state.car.world_from_body.orientation * Vec3(1.0, 0.0, 0.0)};
  const Vec2 ahead = glm::length(heading) > 0.1 ? glm::normalize(heading) : Vec2(1.0, 0.0);
  const double way_m = std::max(0.0, glm::dot(Vec2(state.car.velocity_mps), ahead)) * tick_s;
  vehicle::Ground ground;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    vehicle::WheelGround& wheel = ground[i];
    const road::RoadPosition stood = state.wheel_roads[i];
    const bool has_place = state.car_road.has_value();
    const auto outside_m =
        find_wheel_ground(model.roads, model.raised.get(), weather, centres[i], has_place, state.wheel_roads[i], wheel);
    if (model.obstacles && (!outside_m || *outside_m > 0.0)) {
      const bool paved = outside_m && *outside_m <= roadside::paved_edge_m;
      const double road_friction = wheel.friction;
      find_land(model.roads, model.obstacles->terrain(), weather, centres[i],
                outside_m ? &state.wheel_roads[i] : nullptr, wheel);
      if (paved) {
        wheel.friction = road_friction;
        wheel.rolling_resistance = 1.0;
      }
      if (outside_m && has_place) stays_before_face(model, centres[i], stood, state.wheel_roads[i], wheel);
      state.kerbs[i].reset();
    } else if (outside_m) {
      if (!has_place || !stays_before_face(model, centres[i], stood, state.wheel_roads[i], wheel))
        find_step_edges(model.roads, model.raised.get(), centres[i], ahead, model.car.tyre.radius_m,
                        state.wheel_roads[i], wheel, way_m);
      take_faces_away(state.hull, model.car.tyre.radius_m, wheel);
      note_kerb(i, centres[i], wheel, model, state, events);
    } else {
      // A world without land is level, as high as the road that the car was last on.
      wheel.point_m = Vec3(Vec2(centres[i]), 0.0);
      if (state.car_road) wheel.point_m.z = road::evaluate(model.roads, *state.car_road).position_m.z;
      wheel.friction = surface_friction(nullptr, weather);
    }
    const double debris_m = obstacle_height_m(state.effects, wheel.point_m);
    wheel.point_m.z += debris_m;
    wheel.yields = debris_m > 0.0;
  }
  return ground;
}

/// Sets a car whose wheels all lie far below the ground (a scenario that put it there, a road without a floor) onto it,
/// and logs that: forces of that depth are beyond all bounds. Returns true if it did.
bool set_on_ground(const Model& model, const vehicle::Ground& ground, State& state, std::vector<Event>& events) {
  constexpr double buried_m = 10.0;  // More than one level of a road below another.
  const auto centres = vehicle::wheel_centres_m(model.car, state.car);
  double least_m = ground[0].point_m.z - centres[0].z, most_m = least_m;
  for (std::size_t i = 1; i < centres.size(); ++i) {
    const double below_m = ground[i].point_m.z - centres[i].z;
    least_m = std::min(least_m, below_m);
    most_m = std::max(most_m, below_m);
  }
  if (!(least_m > buried_m)) return false;
  state.car.world_from_body.position_m.z += most_m + model.car.tyre.radius_m;
  state.car.velocity_mps.z = 0.0;
  events.push_back({"set_on_ground", driver_participant, fmt::format("below_m={:.1f}", least_m)});
  return true;
}

/// Logs that the car has been off the roads for some seconds, each minute from then on, and its return.
void note_off_road(const std::optional<road::Location>& place, State& state, std::vector<Event>& events) {
  constexpr double beside_m = 2.0;  // Two wheels on the verge are not off the road.
  constexpr auto first = static_cast<std::uint32_t>(5.0 * tick_rate_hz),
                 again = static_cast<std::uint32_t>(60.0 * tick_rate_hz);
  if (place && place->lanes.outside_m <= beside_m) {
    if (state.off_road_ticks >= first)
      events.push_back({"off_road", driver_participant,
                        fmt::format("state=back after_s={:.1f}", state.off_road_ticks / tick_rate_hz)});
    state.off_road_ticks = 0;
    return;
  }
  const std::uint32_t ticks = ++state.off_road_ticks;
  if (ticks < first || (ticks - first) % again != 0) return;
  events.push_back(
      {"off_road", driver_participant,
       fmt::format("state=off since_s={:.1f} distance_m={} speed_mps={:.2f}", ticks / tick_rate_hz,
                   place ? fmt::format("{:.1f}", place->lanes.outside_m) : fmt::format("{:.0f}+", road_reach_m),
                   glm::length(state.car.velocity_mps))});
}

/// The driver's car as the owner of its hull.
HullOwner hull_owner(const Model& model, const State& state) {
  HullOwner owner{
      driver_participant,
      {vehicle::planar_body(model.car.body, state.car), vehicle::hull_outline(model.car.body, state.car).outline},
      model.car.body.mass_centre_x_m};
  owner.side.body.heading_rad = heading_rad(state.car.world_from_body.orientation);
  return owner;
}

/// `out`: lamps with failed bulbs.
Lamps driver_lamps(const DriverInput& input, const vehicle::VehicleOutputs& car, double time_s, Lamps out) {
  Lamps lamps;
  const bool blink = indicator_is_lit(time_s);
  lamps.set(Lamp::brake, input.brake > 0.02);
  lamps.set(Lamp::reverse, car.gear < 0);
  lamps.set(Lamp::indicator_left, blink && (input.hazard_lights || input.indicator == IndicatorStalk::left));
  lamps.set(Lamp::indicator_right, blink && (input.hazard_lights || input.indicator == IndicatorStalk::right));
  lamps.set(Lamp::low_beam, input.low_beam);
  lamps.set(Lamp::high_beam, input.high_beam);
  lamps.set(Lamp::horn, input.horn);
  lamps.set(Lamp::parking_brake, input.parking_brake);
  lamps.bits = static_cast<std::uint16_t>(lamps.bits & ~out.bits);
  return lamps;
}

Participant car_participant(const Model& model, const State& state, const vehicle::VehicleOutputs& out) {
  Participant car;
  car.id = driver_participant;
  car.model = model.scenario.entities[model.driver_entity].model;
  car.paint = 7;
  car.lamps = driver_lamps(state.input, out, state.time_s(), state.faults.lamps_out);
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

}  // namespace

DrivenCar advance_car(const Model& model, State& state, std::vector<Event>& events) {
  auto ground = ground_below(model, state, events);
  if (set_on_ground(model, ground, state, events)) ground = ground_below(model, state, events);
  const std::uint32_t bad_before = state.car.bad_numbers;
  const Vec2 before_mps(state.car.velocity_mps);
  const double on_the_way_m = glm::length(state.car.velocity_mps) * tick_s;
  auto obstacles = model.obstacles ? model.obstacles->near(Vec2(state.car.world_from_body.position_m),
                                                           vehicle::hull_reach_m(model.car) + on_the_way_m, state.gone)
                                   : std::vector<Obstacle>{};
  append_faces(model, state, ground, obstacles);
  vehicle::HullReport met;
  const std::vector<vehicle::HullTouch> touches_before = state.hull.touches;
  const auto wheels_before = state.car.wheels;
  std::array<double, vehicle::wheel_count> squeeze_m{};
  std::optional<vehicle::VehicleParameters> failed;
  if (state.faults.vehicle.any()) failed = vehicle::with_faults(model.car, state.faults.vehicle);
  const vehicle::VehicleParameters& parameters = failed ? *failed : model.car;
  for (int i = 0; i < car_steps; ++i) {
    vehicle::advance_vehicle(parameters, state.input, ground, tick_s / car_steps, state.car);
    const impact::Due due = due_to_car(state, vehicle::planar_body(model.car.body, state.car));
    vehicle::advance_hull(model.car, obstacles, tick_s / car_steps, due, state.car, state.hull, met);
    advance_impacts(model, tick_s / car_steps, state);
    for (std::size_t wheel = 0; wheel < squeeze_m.size(); ++wheel)
      squeeze_m[wheel] = std::max(squeeze_m[wheel], state.car.wheels[wheel].squeeze_m);
  }
  for (std::size_t wheel = 0; wheel < squeeze_m.size(); ++wheel)
    note_damage(wheel, wheels_before[wheel].damage, squeeze_m[wheel], state, events);
  follow_motion(model, !met.begun.empty(), before_mps, state);
  if (!met.over.empty() || !state.hull.touches.empty())
    note_hull(hull_owner(model, state), touches_before, state.hull, met, state, events);
  note_bad_numbers(state.car.bad_numbers - bad_before, driver_participant, "car", state, events);
  const DrivenCar car = driven_car(model, state);
  const Vec3 origin = car.outputs.world_from_vehicle.position_m;
  const auto place = road::locate(model.roads, {origin.x, origin.y}, state.car_road ? &*state.car_road : nullptr,
                                  road_reach_m, origin.z);
  if (place) state.car_road = place->position;
  note_off_road(place, state, events);
  return car;
}

DrivenCar driven_car(const Model& model, const State& state) {
  const auto outputs = vehicle::outputs(model.car, state.car);
  return {outputs, car_participant(model, state, outputs)};
}

void push_car(const Model& model, const Vec3& impulse_ns, State& state, DrivenCar& car) {
  if (impulse_ns == Vec3(0.0)) return;
  state.car.velocity_mps += impulse_ns / model.car.body.mass_kg;
  car = driven_car(model, state);
}

DriverCar driver_car(const Model& model, const State& state, const vehicle::VehicleOutputs& outputs) {
  DriverCar car;
  car.participant = driver_participant;
  car.speed_mps = outputs.speed_mps;
  car.engine_radps = outputs.engine_radps;
  car.gear = static_cast<std::int8_t>(outputs.gear);
  car.steering_wheel_rad = state.input.steering_wheel_rad;
  car.steering_torque_nm = outputs.steering_torque_nm;
  car.accelerator = state.input.accelerator;
  car.brake = state.input.brake;
  car.clutch = state.input.clutch;
  car.yaw_rate_radps = outputs.yaw_rate_radps;
  car.gaze_heading_rad = state.input.gaze_heading_rad;
  car.head = state.input.head;
  // Lateral position is that of the middle of the front axle (SAE J2944, reference point 2), which the driver steers.
  const Vec3 front = outputs.world_from_vehicle * Vec3(model.car.body.wheelbase_m, 0.0, 0.0);
  const auto place =
      road::locate(model.roads, {front.x, front.y}, state.car_road ? &*state.car_road : nullptr, 60.0, front.z);
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

}  // namespace septet::simulation
