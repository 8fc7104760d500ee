#include "engine/simulation/server_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/air_now.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/broken_off.hpp"
#include "engine/simulation/collisions.hpp"
#include "engine/simulation/crash_recording.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/driver_eyes.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/examiner.hpp"
#include "engine/simulation/follow_motion.hpp"
#include "engine/simulation/game.hpp"
#include "engine/simulation/guidance.hpp"
#include "engine/simulation/lights_stage.hpp"
#include "engine/simulation/people_stage.hpp"
#include "engine/simulation/sight_stage.hpp"
#include "engine/simulation/storyboard_stage.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/simulation/way_ahead.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/world/people_errors.hpp"

namespace septet::simulation {
namespace {

/// NaN or infinite controls count as 0, i.e. released.
std::uint32_t reset_bad_numbers(DriverInput& input) {
  std::uint32_t count = 0;
  Vec3& head_m = input.head.from_rest_m;
  for (double* value : {&input.steering_wheel_rad, &input.accelerator, &input.brake, &input.clutch,
                        &input.gaze_heading_rad, &head_m.x, &head_m.y, &head_m.z, &input.head.turn_rad})
    if (!std::isfinite(*value)) {
      *value = 0.0;
      ++count;
    }
  head_m = glm::clamp(head_m, -farthest_head_m, farthest_head_m);
  input.head.turn_rad = std::clamp(input.head.turn_rad, -std::numbers::pi, std::numbers::pi);
  return count;
}

/// All participants, ascending id, in the memory of `participants`.
std::vector<Participant> participants_now(const Model& model, const State& state, const Participant& car,
                                          std::vector<Participant> participants) {
  participants.clear();
  participants.reserve(256);
  participants.push_back(car);
  append_others(model, state, participants);
  show_thrown(state, participants);
  if (!std::ranges::is_sorted(participants, {}, &Participant::id))
    std::ranges::sort(participants, {}, &Participant::id);
  return participants;
}

void run_effects(const Model& model, std::vector<Participant>& participants, State& state, DrivenCar& car,
                 std::vector<Event>& events) {
  if (state.tick % effects_step_ticks != 0) return;
  if (effects_are_still(state.effects)) return;
  const Environment& weather = state.scenario.environment;
  const double friction = vehicle::weather_friction(weather.road_wetness, weather.snow_cover, weather.temperature_k);
  const EffectsReport report =
      advance_effects({model.roads, model.obstacles.get(), participants, weather, driver_participant,
                       friction / vehicle::weather_friction(0.0, 0.0, 293.0), state.tick, tick_s, state.gone},
                      state.effects);
  PushedByPieces own{.before = vehicle::planar_body(model.car.body, state.car), .after = {}};
  push_car(model, report.impulse_on_driver_ns, state, car);
  own.after = vehicle::planar_body(model.car.body, state.car);
  for (const BrokenOff& broken : report.crashes.broken_off) give_back(broken, own, participants, state);
  if (report.crashes.pieces > 0)
    events.push_back({"debris", std::nullopt, fmt::format("pieces={}", report.crashes.pieces)});
  if (report.fractures > 0) events.push_back({"fracture", std::nullopt, fmt::format("faces={}", report.fractures)});
  note_bad_numbers(static_cast<std::uint32_t>(report.bad_numbers), std::nullopt, "debris", state, events);
}

/// `participants` are those of this tick, as the effects found them.
Snapshot capture(const Model& model, const State& state, const DrivenCar& car, std::vector<Participant> participants) {
  Snapshot snapshot;
  snapshot.tick = state.tick;
  snapshot.simulated_time_s = state.time_s();
  snapshot.state_hash = hash_state(state);
  snapshot.environment = state.scenario.environment;
  snapshot.driver_car = driver_car(model, state, car.outputs);
  snapshot.participants = std::move(participants);
  show_damage(state.effects, snapshot.participants);
  snapshot.effects = effect_keyframes(state.effects);
  if (auto lights = light_keyframe(model, state.tick)) snapshot.effects.push_back(std::move(*lights));
  if (auto warnings = warning_keyframe(state)) snapshot.effects.push_back(std::move(*warnings));
  if (auto sights = sight_keyframe(state)) snapshot.effects.push_back(std::move(*sights));
  if (auto seen = seen_keyframe(state)) snapshot.effects.push_back(std::move(*seen));
  append_guidance(state, snapshot.effects);
  snapshot.diagnostics = state.diagnostics;
  if (state.game) snapshot.game = state.game->standing;
  return snapshot;
}

}  // namespace

Expected<State> initial_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic) {
  State state;
  state.traffic = std::move(traffic);
  if (model.obstacles) state.traffic->see_walls(model.obstacles->walls());
  state.traffic->see_crossings(crossing_places(model));
  scenario::StepResult init;
  auto started = scenario::start_scenario(model.scenario, model.roads, model.driver_entity, init);
  if (!started) return tl::unexpected(started.error());
  state.scenario = std::move(*started);
  const auto& entity = state.scenario.entities[model.driver_entity];
  if (!entity.active) return tl::unexpected(scenario::why_without_place(model.scenario, model.driver_entity));
  state.car = vehicle::standstill(model.car, entity.world_from_entity, entity.speed_mps);
  begin_motion(model, state);
  const Participant car = driven_car(model, state).participant;
  apply_swarms(model, init, car, state);
  for (const PeopleErrorRates& rates : init.error_rates)
    if (auto set = state.traffic->set_errors(rates); !set) return tl::unexpected(set.error());
  if (init.people) start_people(model, *init.people, car, state);
  state.effects = initial_effects(model.scenario, state.scenario, model.seed);
  state.effects.ice = initial_ice(model.roads, model.scenario, state.scenario, model.driver_entity, driver_participant,
                                  first_scripted_participant, model.seed);
  apply_effects(model, init, car, state);
  if (model.scenario.game) state.game = initial_game(*model.scenario.game, model.seed);
  if (!model.yield_lines.empty()) state.examiner.emplace();
  std::vector<Event> route_untold;  // Its words come with the first looks. Without a way there nobody guides.
  for (const auto& places : init.guided) (void)guide_over(model, places, state, route_untold);
  if (auto error = state.traffic->take_error()) return tl::unexpected(std::move(*error));
  std::vector<Event> unseen_before;  // At the beginning everybody is.
  look_for_others(model, participants_now(model, state, car, {}), state, unseen_before);
  return state;
}

Snapshot server_step(const Model& model, const DriverInput& input, State& state, std::vector<Event>& events,
                     Snapshot old) {
  ++state.tick;
  state.input = input;
  note_bad_numbers(reset_bad_numbers(state.input), driver_participant, "controls", state, events);
  DrivenCar car = advance_car(model, state, events);
  advance_storyboard(model, car, state, events);
  advance_people(model, car.participant, state);
  if (!model.lights.empty()) state.traffic->show_lights(lit_heads(model, state.time_s()));
  state.traffic->limit_sight(
      {state.sights, depth_for_lamps(air_of(state), traffic::farthest_looked_for_m), state.gone});
  state.traffic->advance(foreign_vehicles(model, state, car.participant), tick_s);
  note_bad_numbers(state.traffic->take_bad_numbers(), std::nullopt, "traffic", state, events);
  if (auto remark = state.traffic->take_remark()) events.push_back({"traffic", std::nullopt, std::move(*remark)});
  for (const traffic::ViewOpening& opening : state.traffic->take_openings())
    events.push_back({"junction_sight", opening.driver,
                      fmt::format("line_m={:.1f} hidden_s={:.1f}", opening.line_m, opening.hidden_s)});
  for (const ToldError& error : state.traffic->take_errors())
    events.push_back({std::string(people_error_event), error.who, text_of(error)});
  advance_bodies(model, state, events);
  auto participants = participants_now(model, state, car.participant, std::move(old.participants));
  advance_thrown(model, car, participants, state, events);
  participants.front() = car.participant;
  run_effects(model, participants, state, car, events);
  participants.front() = car.participant;  // The lowest id; the effects may have pushed it.
  find_collisions(model, car, participants, state, events);
  advance_game(model, car.participant, state, events);
  advance_examiner(model, participants, car.participant, state, events);
  advance_guidance(model, car.participant, state, events);
  look_ahead(model, participants, state.effects, state.scenario);
  look_through_air(model, participants, state, events);
  look_for_others(model, participants, state, events);
  return capture(model, state, car, std::move(participants));
}

Snapshot capture_snapshot(const Model& model, const State& state, Snapshot old) {
  const DrivenCar car = driven_car(model, state);
  return capture(model, state, car, participants_now(model, state, car.participant, std::move(old.participants)));
}

}  // namespace septet::simulation
