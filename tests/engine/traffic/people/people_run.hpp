#pragma once
/// People of a swarm in a network, and what was seen of them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/simulation/walkways_of_drive.hpp"
#include "engine/traffic/people/people.hpp"

namespace septet::traffic {

/// Walkways as a drive has them, but for lights.
inline WalkwayGraph walkways(const road::RoadNetwork& network) {
  return simulation::walkways_of(network, roadside::Obstacles(network, 1), roadside::RaisedAreas(network), {});
}

struct PeopleRun {
  double nearest_m = 1e9;  ///< Least distance of two outlines' middles.
  double longest_stuck_s = 0.0;
  double walked_m = 0.0, person_s = 0.0;
  std::uint32_t crossings_begun = 0;
};

/// Least distance of the middles of two people.
inline double nearest_two_m(const PeopleState& people) {
  std::vector<Vec2> places;
  for (const Person& person : people.people)
    if (!person.outside) places.push_back(person.position_m);
  std::ranges::sort(places, {}, &Vec2::x);
  double least_m = 1e9;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + 1; k < places.size() && places[k].x - places[i].x < least_m; ++k)
      least_m = std::min(least_m, glm::distance(places[i], places[k]));
  return least_m;
}

/// Called before each tick; may change what is around.
using BeforeTick = std::function<void(const PeopleState&, PeopleAround&)>;

inline PeopleRun run_people(const WalkwayGraph& graph, const PeopleWish& wish, PeopleAround around, double seconds,
                            PeopleState& people, const BeforeTick& before = {}) {
  constexpr double dt_s = 1.0 / 120.0;
  PeopleRun run;
  std::vector<double> stuck_s(people.people.size(), 0.0);
  std::vector<bool> crossed(people.people.size(), false);
  for (double t = 0.0; t < seconds; t += dt_s) {
    if (before) before(people, around);
    advance_people(wish, graph, around, dt_s, people);
    run.nearest_m = std::min(run.nearest_m, nearest_two_m(people));
    for (std::size_t k = 0; k < people.people.size(); ++k) {
      const Person& person = people.people[k];
      if (person.outside) continue;
      const double mps = glm::length(person.velocity_mps);
      run.walked_m += mps * dt_s, run.person_s += dt_s;
      stuck_s[k] = mps < 0.1 && person.waits_s == 0.0 ? stuck_s[k] + dt_s : 0.0;
      run.longest_stuck_s = std::max(run.longest_stuck_s, stuck_s[k]);
      if (person.crosses && !crossed[k]) ++run.crossings_begun;
      crossed[k] = person.crosses;
    }
  }
  return run;
}

}  // namespace septet::traffic
