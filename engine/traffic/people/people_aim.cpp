#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "engine/traffic/people/people_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double looks_ahead_m = 1.6, before_kerb_m = 0.5, decides_m = 2.5;
/// Speeds on a crossing, by the usual one: people hurry a little, and more once their light is red.
constexpr double crossing_share = 1.1, late_share = 1.35;

/// A number in [0, 1) that follows from the arguments (SplitMix64).
double drawn(std::uint64_t ways, std::uint32_t turns) {
  std::uint64_t z = ways + 0x9e3779b97f4a7c15u * (std::uint64_t{turns} + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

double weight_of(const WalkwayGraph& graph, const Walk& walk) {
  if (!walk.is_crossing()) return 1.0;
  return graph.crossings[walk.crossing].kind == Crossing::Kind::plain ? 0.25 : 0.8;
}

/// Along the way that one goes: distance from the begin of his walk.
double gone_m(const Walk& walk, bool forwards, double at_m) { return forwards ? at_m : walk.length_m - at_m; }

/// Where one leaves his walk for the next one, along his way: its end, or the breadth of a crossing before it; of a
/// crossing, the pavement beyond it.
double leaves_at_m(const WalkwayGraph& graph, const Person& person) {
  constexpr double beyond_kerb_m = 0.3, breadth_m = 0.8;
  const Walk& walk = graph.walks[person.walk];
  const bool forwards = person.forwards;
  if (!walk.is_crossing()) {
    const bool to_crossing = person.next_walk != no_walk && graph.walks[person.next_walk].is_crossing();
    return walk.length_m - (to_crossing ? breadth_m : 0.0);
  }
  const Crossing& crossing = graph.crossings[walk.crossing];
  return beyond_kerb_m + (forwards ? crossing.right_at_m : walk.length_m - crossing.left_at_m);
}

void enter_next(const WalkwayGraph& graph, Person& person) {
  if (person.next_walk == no_walk) {
    turn_back(person);
  } else {
    person.walk = person.next_walk, person.forwards = person.next_forwards;
    if (!graph.walks[person.walk].is_crossing()) person.crosses = person.asks = false;
  }
  ++person.turns;
  const Walk& walk = graph.walks[person.walk];
  const OnWalk on = locate_on_walk(graph, walk, person.position_m, person.forwards ? 0.0 : walk.length_m);
  person.at_m = on.at_m, person.left_m = on.left_m;
  choose_next(graph, person);
}

/// Where he would walk at a place of his walk.
Vec2 lane_place(const WalkwayGraph& graph, const Walk& walk, bool forwards, double at_m, double beside) {
  const PlaceOnWalk place = place_on_walk(graph, walk, at_m);
  const Vec2 left(-place.along.y, place.along.x);
  return Vec2(place.middle_m) + (forwards ? beside : -beside) * usable_half_m(place.half_m) * left;
}

/// The place ahead of him, on the next walk where his own ends.
Vec2 place_ahead(const WalkwayGraph& graph, const Person& person, double beside) {
  const Walk& walk = graph.walks[person.walk];
  const double ahead_m = gone_m(walk, person.forwards, person.at_m) + looks_ahead_m;
  const double beyond_m = ahead_m - leaves_at_m(graph, person);
  if (beyond_m <= 0.0 || person.next_walk == no_walk)
    return lane_place(graph, walk, person.forwards, person.forwards ? ahead_m : walk.length_m - ahead_m, beside);
  const Walk& next = graph.walks[person.next_walk];
  return lane_place(graph, next, person.next_forwards, person.next_forwards ? beyond_m : next.length_m - beyond_m,
                    beside);
}

/// A group keeps together: who is ahead slows down, who is behind hurries, and the first one waits.
double share_in_group(const PeopleState& people, std::uint32_t index, const Vec2& along) {
  constexpr double together_m = 0.4, lost_m = 12.0, behind_m = 3.0;
  const Person& person = people.people[index];
  if (person.leader != index) {
    const Person& leader = people.people[person.leader];
    if (leader.outside) return 1.0;
    const Vec2 apart = person.position_m - leader.position_m;
    const double ahead_m = glm::dot(apart, along);
    if (glm::length(apart) > lost_m) return 1.0;
    return ahead_m > together_m ? 0.75 : ahead_m < -together_m ? 1.25 : 1.0;
  }
  for (std::uint32_t k = index + 1; k < people.people.size() && people.people[k].leader == index; ++k) {
    const Person& other = people.people[k];
    const double apart_m = glm::distance(other.position_m, person.position_m);
    if (!other.outside && apart_m > behind_m && apart_m < lost_m) return 0.6;
  }
  return 1.0;
}

}  // namespace

void choose_next(const WalkwayGraph& graph, Person& person) {
  const Walk& walk = graph.walks[person.walk];
  const auto ends = graph.ends_of(graph.nodes[person.forwards ? walk.end : walk.begin]);
  person.next_walk = no_walk;
  // Nobody crosses back at once.
  const bool crossed = walk.is_crossing();
  const auto suits = [&](const WalkEnd& end) {
    return end.walk != person.walk && !(crossed && graph.walks[end.walk].is_crossing());
  };
  double sum = 0.0;
  for (const WalkEnd& end : ends)
    if (suits(end)) sum += weight_of(graph, graph.walks[end.walk]);
  double at = drawn(person.ways, person.turns) * sum;
  for (const WalkEnd& end : ends) {
    if (!suits(end)) continue;
    person.next_walk = end.walk, person.next_forwards = end.is_begin;
    if ((at -= weight_of(graph, graph.walks[end.walk])) < 0.0) break;
  }
}

void turn_back(Person& person) {
  person.forwards = !person.forwards;
  person.next_walk = no_walk;
  person.crosses = person.asks = false;
}

Aim aim_of(const WalkwayGraph& graph, const PeopleAround& around, const std::vector<SeenVehicle>& vehicles,
           double since_s, std::uint32_t index, PeopleState& people) {
  Person& person = people.people[index];
  if (person.next_walk == no_walk) choose_next(graph, person);
  const Walk& until_now = graph.walks[person.walk];
  if (gone_m(until_now, person.forwards, person.at_m) >= leaves_at_m(graph, person)) enter_next(graph, person);
  // A way that leads against the side to which people keep is theirs all the same: `beside_m` is from it.
  const double beside = around.keeps_left ? -person.beside_m : person.beside_m;
  const Walk& walk = graph.walks[person.walk];
  const PlaceOnWalk here = place_on_walk(graph, walk, person.at_m);
  const Vec2 along = person.forwards ? here.along : -here.along;
  Aim aim;
  aim.faces = along;
  aim.at_m = place_ahead(graph, person, beside);
  aim.most_mps = person.desired_mps * share_in_group(people, index, along);
  person.asks = false;
  if (!walk.is_crossing()) {
    person.waits_s = 0.0;
    return aim;
  }
  const Crossing& crossing = graph.crossings[walk.crossing];
  const double kerb_m = person.forwards ? crossing.left_at_m : walk.length_m - crossing.right_at_m;
  const double to_kerb_m = kerb_m - gone_m(walk, person.forwards, person.at_m);
  const bool on_road = to_kerb_m < before_kerb_m - 0.4;
  if (on_road) person.crosses = true;
  if (!person.crosses && to_kerb_m < decides_m) {
    const Person& leader = people.people[person.leader];
    const bool follows = person.leader != index && !leader.outside && leader.walk == person.walk &&
                         leader.forwards == person.forwards && leader.crosses;
    const bool lit = crossing.kind == Crossing::Kind::light;
    person.crosses = (follows && !lit) || may_cross(graph, crossing, person.forwards, around, vehicles, person);
  }
  if (person.crosses) {
    const bool late = crossing.kind == Crossing::Kind::light &&
                      !may_cross(graph, crossing, person.forwards, around, vehicles, person);
    aim.most_mps *= late ? late_share : crossing_share;
    person.waits_s = 0.0;
    return aim;
  }
  // To his place at the kerb: in the first row, beside others.
  const double slot = 2.0 * drawn(person.ways, person.turns + index) - 1.0;
  const double wait_at_m = kerb_m - before_kerb_m;
  aim.at_m = lane_place(graph, walk, person.forwards, person.forwards ? wait_at_m : walk.length_m - wait_at_m, slot);
  const double to_place_m = glm::distance(aim.at_m, person.position_m);
  aim.most_mps = std::min(aim.most_mps, std::max(0.3, to_place_m));
  aim.stands = to_place_m < 0.25 || (to_kerb_m < before_kerb_m + 0.15 && person.stuck_s > 1.0) || person.stuck_s > 3.0;
  if (to_kerb_m < decides_m) person.waits_s += since_s;
  person.asks = crossing.kind == Crossing::Kind::zebra && to_kerb_m < decides_m;
  return aim;
}

std::vector<PersonCrossing> people_crossing(const WalkwayGraph& graph, const PeopleState& people) {
  std::vector<PersonCrossing> crossing_now;
  for (const Person& person : people.people) {
    if (person.outside) continue;
    const Walk& walk = graph.walks[person.walk];
    if (!walk.is_crossing() || (!person.crosses && !person.asks)) continue;
    const Crossing& crossing = graph.crossings[walk.crossing];
    const double at_m = person.at_m - crossing.left_at_m;
    const double length_m = crossing.right_at_m - crossing.left_at_m, over_m = 0.3;
    const bool is_over = person.forwards ? at_m > length_m + over_m : at_m < -over_m;
    if (is_over) continue;
    const double mps = person.forwards ? person.desired_mps : -person.desired_mps;
    crossing_now.push_back({walk.crossing, at_m, mps, !person.crosses});
  }
  std::ranges::stable_sort(crossing_now, {}, &PersonCrossing::crossing);
  return crossing_now;
}

}  // namespace septet::traffic
