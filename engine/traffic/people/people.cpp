#include "engine/traffic/people/people.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/road/road_position.hpp"
#include "engine/traffic/people/people_stages.hpp"
#include "engine/world/limbs.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::traffic {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
/// Time in which a velocity becomes the wanted one (Moussaïd et al. 2011: 0.5 s).
constexpr double relaxation_s = 0.5;
constexpr double most_turn_radps = 4.0, steps_from_mps = 0.05;

ModelIndex person_model() {
  static constexpr ModelIndex unknown = 0;
  const auto model = find_vehicle_model("pedestrian");
  return model ? *model : unknown;
}

/// True where nobody is nearer to a new place than people come, but for those from whom it leads away.
bool is_free(const PeopleState& people, const Neighbourhood& near, std::uint32_t self, const Vec2& to_m,
             std::uint32_t& by) {
  const Vec2 from_m = people.people[self].position_m;
  constexpr double slack_m = 0.1;  // The order is of the tick's begin.
  return for_near(people, near, self, to_m, apart_m + slack_m, [&](std::uint32_t other) {
    const Vec2 there = people.people[other].position_m;
    const Vec2 after = to_m - there, before = from_m - there;
    const double after2 = glm::dot(after, after);
    if (after2 >= apart_m * apart_m || after2 >= glm::dot(before, before)) return true;
    by = other;
    return false;
  });
}

/// One's place a tick on: as he wants, else along the one in his way, else he stands.
void move(const Neighbourhood& near, double dt_s, std::uint32_t self, PeopleState& people) {
  Person& person = people.people[self];
  Vec2 velocity = person.velocity_mps + (person.wanted_mps - person.velocity_mps) * std::min(1.0, dt_s / relaxation_s);
  std::uint32_t by = 0;
  if (!is_free(people, near, self, person.position_m + dt_s * velocity, by)) {
    const Vec2 apart = people.people[by].position_m - person.position_m;
    const double d2 = std::max(glm::dot(apart, apart), 1e-9);
    velocity -= std::max(0.0, glm::dot(velocity, apart) / d2) * apart;
    if (!is_free(people, near, self, person.position_m + dt_s * velocity, by)) velocity = Vec2(0.0);
  }
  person.position_m += dt_s * velocity;
  person.velocity_mps = velocity;
}

void turn_and_step(double dt_s, Person& person) {
  const double mps = glm::length(person.velocity_mps);
  double wanted = person.heading_rad;
  if (mps > 0.2) wanted = std::atan2(person.velocity_mps.y, person.velocity_mps.x);
  const double turn =
      std::clamp(road::wrap_angle(wanted - person.heading_rad), -most_turn_radps * dt_s, most_turn_radps * dt_s);
  person.turns_radps = turn / dt_s;
  person.heading_rad = road::wrap_angle(person.heading_rad + turn);
  const double strides = person.strides + dt_s * strides_hz(mps > steps_from_mps ? mps : 0.0);
  person.strides = strides - std::floor(strides);
}

void look(const WalkwayGraph& graph, const PeopleAround& around, double since_s, PeopleState& people) {
  const std::vector<SeenVehicle> vehicles = seen_vehicles(around);
  const Neighbourhood near = neighbourhood_of(people);
  for (std::uint32_t index = 0; index < people.people.size(); ++index) {
    Person& person = people.people[index];
    if (person.outside) continue;
    const Aim aim = aim_of(graph, around, vehicles, since_s, index, people);
    if (aim.stands) {
      person.wanted_mps = Vec2(0.0);
      person.stuck_s = 0.0;
      person.heading_rad +=
          std::clamp(road::wrap_angle(std::atan2(aim.faces.y, aim.faces.x) - person.heading_rad), -0.3, 0.3);
      continue;
    }
    constexpr double stuck_mps = 0.25, back_s = 14.0;
    person.stuck_s = glm::length(person.velocity_mps) < stuck_mps ? person.stuck_s + since_s
                                                                  : std::max(0.0, person.stuck_s - 2.0 * since_s);
    if (person.stuck_s > back_s && !person.crosses) {
      turn_back(person);
      person.stuck_s = 0.0;
    }
    person.wanted_mps = step_to(graph, vehicles, near, index, aim, around.keeps_left ? 1.0 : -1.0, people);
  }
}

}  // namespace

Neighbourhood neighbourhood_of(const PeopleState& people) {
  Neighbourhood near;
  near.rank.assign(people.people.size(), 0);
  for (std::uint32_t k = 0; k < people.people.size(); ++k)
    if (!people.people[k].outside) near.by_x.push_back(k);
  std::ranges::sort(near.by_x, {}, [&](std::uint32_t k) { return std::pair(people.people[k].position_m.x, k); });
  for (std::uint32_t k = 0; k < near.by_x.size(); ++k) near.rank[near.by_x[k]] = k;
  return near;
}

bool look_next(const PeopleState& people) { return people.ticks % look_ticks == 0; }

void advance_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around, double dt_s,
                    PeopleState& people) {
  if (people.people.empty()) return;
  if (look_next(people)) look(graph, around, dt_s * static_cast<double>(look_ticks), people);
  const Neighbourhood near = neighbourhood_of(people);
  for (std::uint32_t index = 0; index < people.people.size(); ++index) {
    Person& person = people.people[index];
    if (person.outside) continue;
    move(near, dt_s, index, people);
    turn_and_step(dt_s, person);
    const Walk& walk = graph.walks[person.walk];
    const OnWalk on = locate_on_walk(graph, walk, person.position_m, person.at_m);
    person.at_m = on.at_m, person.left_m = on.left_m;
    const PlaceOnWalk place = place_on_walk(graph, walk, on.at_m);
    person.height_m = place.middle_m.z + std::clamp(on.left_m, -place.half_m, place.half_m) * place.rises;
  }
  people.time_s += dt_s;
  ++people.ticks;
  constexpr std::uint64_t recycle_ticks = 5 * look_ticks;
  if (people.ticks % recycle_ticks == 0) recycle_people(wish, graph, around, people);
}

bool release(ParticipantId id, PeopleState& people) {
  const auto found = std::ranges::find(people.people, id, &Person::id);
  if (found == people.people.end()) return false;
  const auto gone = static_cast<std::uint32_t>(found - people.people.begin());
  people.people.erase(found);
  // Those who followed him follow the next of them, who now has his index.
  for (Person& person : people.people)
    if (person.leader > gone) --person.leader;
  return true;
}

void append_participants(const PeopleState& people, std::vector<Participant>& participants) {
  const ModelIndex model = person_model();
  const double ahead_m = vehicle_models()[model].centre_x_m();
  for (const Person& person : people.people) {
    if (person.outside) continue;
    Participant& participant = participants.emplace_back();
    const Vec2 heading(std::cos(person.heading_rad), std::sin(person.heading_rad));
    participant.id = person.id;
    participant.model = model;
    participant.paint = person.paint;
    participant.world_from_vehicle = {Vec3(person.position_m - ahead_m * heading, person.height_m),
                                      orientation_from_angles(person.heading_rad, 0.0, 0.0)};
    const double mps = glm::length(person.velocity_mps);
    participant.velocity_mps = Vec3(person.velocity_mps, 0.0);
    participant.angular_velocity_radps.z = person.turns_radps;
    participant.lamps.set(Lamp::signal_green, person.crosses || person.asks);
    participant.wheel_spin_rad = turn_rad * person.strides;
    participant.wheel_spin_radps = turn_rad * strides_hz(mps > steps_from_mps ? mps : 0.0);
  }
}

}  // namespace septet::traffic
