#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/traffic/people/people_stages.hpp"

namespace septet::traffic {
namespace {

/// Walking speeds (Weidmann 1993), and the bounds within which they are drawn.
constexpr double mean_mps = 1.34, deviation_mps = 0.26, slowest_mps = 0.7, fastest_mps = 2.0;
/// A group is slower by this share for each who walks beside another (Moussaïd et al. 2010, figure 2).
constexpr double slower_in_group = 0.07;
/// Shares of those who walk alone, and of groups of two; the rest are three.
constexpr double alone_share = 0.6, pairs_share = 0.3;
constexpr int tries = 12;
/// Nobody comes in nearer to the driver where he would see it.
constexpr double seen_share = 0.6, seen_m = 150.0, hidden_m = 35.0, first_m = 6.0;
constexpr double leaves_share = 1.15;

/// Walks around the driver, with their lengths summed up.
struct Places {
  std::vector<WalkIndex> walks;
  std::vector<double> until_m;
};

Places places_within(const WalkwayGraph& graph, const Vec2& middle_m, double radius_m) {
  Places places;
  double sum_m = 0.0;
  for (WalkIndex index = 0; index < graph.walks.size(); ++index) {
    const Walk& walk = graph.walks[index];
    constexpr double least_m = 4.0;
    if (walk.is_crossing() || walk.length_m < least_m) continue;
    const Vec2 at(graph.points[walk.points.first + walk.points.count / 2].middle_m);
    if (glm::distance(at, middle_m) > radius_m + 0.5 * walk.length_m) continue;
    places.walks.push_back(index);
    places.until_m.push_back(sum_m += walk.length_m);
  }
  return places;
}

bool is_clear(const PeopleState& people, const Vec2& at_m) {
  constexpr double clear_m = 1.2;
  return std::ranges::none_of(people.people, [&](const Person& other) {
    return !other.outside &&
           glm::distance(other.position_m, at_m) < clear_m * (other.velocity_mps == Vec2(0.0) ? 0.7 : 1.0);
  });
}

bool is_seen(const PeopleAround& around, const Vec3& at_m, double seen_to_m) {
  const double distance_m = glm::distance(around.driver_eyes_m, at_m);
  if (distance_m > seen_to_m) return false;
  constexpr double head_m = 1.75;
  const bool hidden = around.walls != nullptr && distance_m > hidden_m &&
                      around.walls->hide(around.driver_eyes_m, at_m + Vec3(0.0, 0.0, head_m), around.gone);
  return !hidden;
}

/// Puts one on a ribbon, beside the places of others; false where somebody or something is there.
bool put(const WalkwayGraph& graph, bool keeps_left, WalkIndex index, bool forwards, double at_m, PeopleState& people,
         Person& person) {
  const Walk& walk = graph.walks[index];
  if (at_m < 0.5 || at_m > walk.length_m - 0.5) return false;
  const PlaceOnWalk place = place_on_walk(graph, walk, at_m);
  const Vec2 along = forwards ? place.along : -place.along, left(-along.y, along.x);
  const double beside = keeps_left ? -person.beside_m : person.beside_m;
  const Vec2 at = Vec2(place.middle_m) + beside * usable_half_m(place.half_m) * left;
  if (!is_clear(people, at)) return false;
  for (const WalkPost& post : graph.posts_of(walk))
    if (glm::distance(post.at_m, at) < post.radius_m + 2.0 * half_person_m) return false;
  person.outside = false;
  person.walk = index, person.forwards = forwards;
  person.next_walk = no_walk;
  person.position_m = at;
  const OnWalk on = locate_on_walk(graph, walk, at, at_m);
  person.at_m = on.at_m, person.left_m = on.left_m;
  person.height_m = place.middle_m.z + on.left_m * place.rises;
  person.velocity_mps = person.wanted_mps = person.desired_mps * along;
  person.heading_rad = std::atan2(along.y, along.x);
  person.turns_radps = person.waits_s = person.stuck_s = 0.0;
  person.crosses = person.asks = false;
  choose_next(graph, person);
  return true;
}

void take_away(Person& person) {
  person.outside = true;
  person.velocity_mps = person.wanted_mps = Vec2(0.0);
  person.turns_radps = 0.0;
  person.crosses = person.asks = false;
}

/// A group, of which nobody is there, comes in.
void try_to_enter(const WalkwayGraph& graph, const PeopleAround& around, const Places& places, double radius_m,
                  double seen_to_m, std::uint32_t first, PeopleState& people) {
  Person& leader = people.people[first];
  const double at = people.random.uniform(0.0, places.until_m.back());
  const auto k = static_cast<std::size_t>(std::ranges::upper_bound(places.until_m, at) - places.until_m.begin());
  const WalkIndex index = places.walks[std::min(k, places.walks.size() - 1)];
  const Walk& walk = graph.walks[index];
  const double at_m = people.random.uniform(0.0, walk.length_m);
  const bool forwards = people.random.below(2) == 0;
  const Vec3 there = place_on_walk(graph, walk, at_m).middle_m;
  const double distance_m = glm::distance(Vec2(there), Vec2(around.driver_eyes_m));
  if (distance_m > radius_m || distance_m < first_m || is_seen(around, there, seen_to_m)) return;
  if (!put(graph, around.keeps_left, index, forwards, at_m, people, leader)) return;
  leader.turns = 0;
  for (std::uint32_t n = first + 1; n < people.people.size() && people.people[n].leader == first; ++n) {
    people.people[n].turns = 0;
    // Beside him, else behind him.
    for (const double behind_m : {0.0, 1.3, 2.6})
      if (people.people[n].outside)
        put(graph, around.keeps_left, index, forwards, at_m - (forwards ? behind_m : -behind_m), people,
            people.people[n]);
  }
}

/// A group of one to three; those who walk beside each other keep 0.85 m apart where the ribbon is that wide.
void add_group(std::uint32_t most, PeopleState& people) {
  const double drawn = people.random.uniform();
  const std::uint32_t size = std::min(most, drawn < alone_share ? 1u : drawn < alone_share + pairs_share ? 2u : 3u);
  const double mps = std::clamp(mean_mps + deviation_mps * people.random.normal(), slowest_mps, fastest_mps) *
                     (1.0 - slower_in_group * (size - 1));
  const std::uint64_t ways = people.random.next_bits();
  const double alone_at = people.random.uniform(-0.9, -0.15);
  const auto first = static_cast<std::uint32_t>(people.people.size());
  for (std::uint32_t k = 0; k < size; ++k) {
    Person& person = people.people.emplace_back();
    person.id = first_person_participant + first + k;
    person.paint = static_cast<std::uint8_t>(people.random.below(12));
    person.desired_mps = mps;
    person.leader = first;
    person.beside_m = size == 1 ? alone_at : -0.95 + 0.95 * k;
    person.ways = ways;
  }
}

}  // namespace

PeopleState populate_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around,
                            std::uint64_t seed) {
  PeopleState people;
  people.random = Random(seed, 3);
  if (wish.count == 0 || graph.empty()) return people;
  people.people.reserve(wish.count);
  while (people.people.size() < wish.count)
    add_group(wish.count - static_cast<std::uint32_t>(people.people.size()), people);
  const Places places = places_within(graph, Vec2(around.driver_eyes_m), wish.radius_m);
  if (places.walks.empty()) return people;
  constexpr double all_is_unseen_m = 0.0;
  for (std::uint32_t k = 0; k < people.people.size(); ++k)
    for (int attempt = 0; attempt < 4 * tries && people.people[k].leader == k && people.people[k].outside; ++attempt)
      try_to_enter(graph, around, places, wish.radius_m, all_is_unseen_m, k, people);
  return people;
}

void recycle_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around,
                    PeopleState& people) {
  const Vec2 middle_m(around.driver_eyes_m);
  const double leaves_m = leaves_share * wish.radius_m;
  for (Person& person : people.people)
    if (!person.outside && glm::distance(person.position_m, middle_m) > leaves_m) take_away(person);
  if (std::ranges::none_of(people.people, &Person::outside)) return;
  const Places places = places_within(graph, middle_m, wish.radius_m);
  if (places.walks.empty()) return;
  const double seen_to_m = std::max(std::min(seen_m, 0.9 * wish.radius_m), seen_share * wish.radius_m);
  for (std::uint32_t k = 0; k < people.people.size(); ++k) {
    if (people.people[k].leader != k) continue;
    const auto is_one = [&](const Person& other) { return other.leader == k; };
    const bool all_outside =
        std::ranges::all_of(people.people, [&](const Person& other) { return !is_one(other) || other.outside; });
    for (int attempt = 0; all_outside && people.people[k].outside && attempt < tries; ++attempt)
      try_to_enter(graph, around, places, wish.radius_m, seen_to_m, k, people);
  }
}

}  // namespace septet::traffic
