#include "engine/simulation/people_stage.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/archive.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/lights_stage.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/world/participant_sight.hpp"

namespace septet::simulation {
namespace {

traffic::PeopleAround around_of(const Model& model, const Participant& car, const std::vector<TrafficLight>& lights,
                                const std::vector<Participant>& vehicles, const State& state) {
  traffic::PeopleAround around;
  around.driver_eyes_m = car.world_from_vehicle * driver_eyes_m(vehicle_models()[car.model]);
  around.keeps_left = !model.roads.roads.empty() && model.roads.roads.front().rule == road::TrafficRule::left_hand;
  around.lights = lights;
  around.vehicles = vehicles;
  if (model.obstacles) around.walls = &model.obstacles->walls();
  around.gone = state.gone;
  return around;
}

/// All that people look at: everybody but themselves.
std::vector<Participant> others_now(const Model& model, const State& state, const Participant& car) {
  std::vector<Participant> others{car};
  append_others(model, state, others);
  show_thrown(state, others);
  std::erase_if(others, [](const Participant& each) { return is_person_of_swarm(each.id); });
  return others;
}

}  // namespace

std::vector<traffic::CrossingPlace> crossing_places(const Model& model) {
  std::vector<traffic::CrossingPlace> places;
  if (!model.walkways) return places;
  places.reserve(model.walkways->crossings.size());
  for (const traffic::Crossing& crossing : model.walkways->crossings) places.push_back(crossing.place);
  return places;
}

void start_people(const Model& model, const PeopleWish& wish, const Participant& car, State& state) {
  state.people = {wish, {}};
  state.traffic->show_people({});
  // Those of an earlier swarm who were thrown lie where they lie, and their numbers are theirs.
  if (!model.walkways) return;
  const std::vector<Participant> others = others_now(model, state, car);
  state.people.swarm =
      traffic::populate_people(wish, *model.walkways, around_of(model, car, {}, others, state), model.seed);
  std::erase_if(state.people.swarm.people, [&](const traffic::Person& person) { return is_thrown(state, person.id); });
}

void advance_people(const Model& model, const Participant& car, State& state) {
  if (state.people.empty() || !model.walkways) return;
  traffic::PeopleState& people = state.people.swarm;
  const bool look = traffic::look_next(people);
  const std::vector<TrafficLight> lights =
      look && !model.lights.empty() ? lit_heads(model, state.time_s()) : std::vector<TrafficLight>{};
  const std::vector<Participant> others = look ? others_now(model, state, car) : std::vector<Participant>{};
  traffic::advance_people(state.people.wish, *model.walkways, around_of(model, car, lights, others, state), tick_s,
                          people);
  state.traffic->show_people(traffic::people_crossing(*model.walkways, people));
}

void require_sound(StateReader& reader, const Model& model, const PeopleOfDrive& people) {
  constexpr auto wrong = "people in it do not fit together";
  const std::vector<traffic::Person>& all = people.swarm.people;
  reader.require(all.empty() || model.walkways, wrong);
  reader.require(std::ranges::is_sorted(all, std::ranges::less_equal{}, &traffic::Person::id), wrong);
  if (!reader.ok()) return;
  const std::size_t walks = model.walkways ? model.walkways->walks.size() : 0;
  constexpr double farthest_m = 1e7;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    const traffic::Person& person = all[k];
    reader.require(is_person_of_swarm(person.id) && person.leader <= k && person.walk < walks &&
                       (person.next_walk == traffic::no_walk || person.next_walk < walks) && person.desired_mps > 0.0 &&
                       std::abs(person.at_m) < farthest_m && std::abs(person.height_m) < farthest_m &&
                       glm::length(person.position_m) < farthest_m && glm::length(person.velocity_mps) < farthest_m,
                   wrong);
  }
}

}  // namespace septet::simulation
