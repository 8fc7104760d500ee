#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/traffic/people/people_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double horizon_m = 5.0, reaction_s = 0.5, near_m = 6.5;
constexpr double room_m = apart_m + 0.04, step_rad = std::numbers::pi / 12.0;
constexpr int directions = 24;

/// Something to keep clear of, as a circle.
struct Body {
  Vec2 from_me_m{0.0}, velocity_mps{0.0};
  double radius_m = 0.0;
};

/// How far one gets at a velocity before he touches a body.
double free_m(const Body& body, const Vec2& velocity_mps, double mps) {
  const Vec2 d = body.from_me_m, v = velocity_mps - body.velocity_mps;
  const double towards = glm::dot(d, v), c = glm::dot(d, d) - body.radius_m * body.radius_m;
  if (c <= 0.0) {
    // Too near already: away from it, or along it.
    constexpr double along_cos = 0.3;
    return glm::dot(d, velocity_mps) > along_cos * glm::length(d) * mps ? 0.0 : horizon_m;
  }
  if (towards <= 0.0) return horizon_m;
  const double a = glm::dot(v, v), root = towards * towards - a * c;
  if (root <= 0.0) return horizon_m;
  return std::min(horizon_m, mps * (towards - std::sqrt(root)) / a);
}

/// How far one gets before he is so far beyond his ribbon's borders.
double within_m(const PlaceOnWalk& place, double left_m, const Vec2& direction, double beyond_m) {
  if (beyond_m > 1.0) return horizon_m;
  const Vec2 left(-place.along.y, place.along.x);
  const double outwards = glm::dot(direction, left), most_m = usable_half_m(place.half_m) + beyond_m;
  if (std::abs(outwards) < 0.05) return horizon_m;
  const double room = outwards > 0.0 ? most_m - left_m : most_m + left_m;
  return room <= 0.0 ? 0.0 : std::min(horizon_m, room / std::abs(outwards));
}

/// A vehicle as three circles along its middle.
void add_vehicle(const SeenVehicle& vehicle, const Person& person, std::vector<Body>& bodies) {
  const Vec2 apart = vehicle.middle_m - person.position_m;
  const double reach_m = vehicle.half_length_m + near_m;
  if (glm::dot(apart, apart) > reach_m * reach_m) return;
  const double radius_m = vehicle.half_width_m + half_person_m + 0.15;
  const double inner_m = std::max(0.0, vehicle.half_length_m - vehicle.half_width_m);
  const int count = 1 + static_cast<int>(std::ceil(inner_m / std::max(vehicle.half_width_m, 0.3)));
  for (int k = -count; k <= count; ++k)
    bodies.push_back({apart + inner_m * k / count * vehicle.heading, vehicle.velocity_mps, radius_m});
}

}  // namespace

Vec2 step_to(const WalkwayGraph& graph, const std::vector<SeenVehicle>& vehicles, const Neighbourhood& near,
             std::uint32_t index, const Aim& aim, double side, const PeopleState& people) {
  const Person& person = people.people[index];
  const Vec2 way = aim.at_m - person.position_m;
  const double way_m = glm::length(way);
  if (way_m < 0.05 || aim.most_mps <= 0.0) return Vec2(0.0);
  const Vec2 ahead = way / way_m;
  std::vector<Body> bodies;
  for_near(people, near, index, person.position_m, near_m, [&](std::uint32_t k) {
    const Person& other = people.people[k];
    const Vec2 apart = other.position_m - person.position_m;
    constexpr double level_m = 2.0;
    if (glm::dot(apart, apart) < near_m * near_m && std::abs(other.height_m - person.height_m) < level_m)
      bodies.push_back({apart, other.velocity_mps, room_m});
    return true;
  });
  const Walk& walk = graph.walks[person.walk];
  for (const WalkPost& post : graph.posts_of(walk)) {
    const Vec2 apart = post.at_m - person.position_m;
    if (glm::dot(apart, apart) < near_m * near_m) bodies.push_back({apart, Vec2(0.0), post.radius_m + half_person_m});
  }
  // On a pavement what stands or creeps is in the way; what drives keeps to its lane.
  constexpr double creeps_mps = 2.0;
  for (const SeenVehicle& vehicle : vehicles)
    if (walk.is_crossing() || glm::dot(vehicle.velocity_mps, vehicle.velocity_mps) < creeps_mps * creeps_mps)
      add_vehicle(vehicle, person, bodies);
  const PlaceOnWalk place = place_on_walk(graph, walk, person.at_m);
  const bool on_pavement = walk.is_crossing() && (person.at_m < graph.crossings[walk.crossing].left_at_m ||
                                                  person.at_m > graph.crossings[walk.crossing].right_at_m);
  // Who is stuck also looks beside and behind himself, and minds less where that leads.
  constexpr double looks_round_s = 1.5;
  const bool is_stuck = person.stuck_s > looks_round_s;
  // A crossing has no borders on the pavements at its ends; who is stuck steps over them.
  const double beyond_m = on_pavement ? 1e9 : is_stuck ? 0.3 : 0.0;
  const int widest = is_stuck ? directions / 2 : directions / 4;
  double best = 1e300, best_free_m = 0.0;
  Vec2 chosen(0.0);
  for (int n = 0; n <= 2 * widest; ++n) {
    // Straight on, then by turns to the side to which people keep and to the other.
    const int steps = (n + 1) / 2;
    const double angle = side * step_rad * steps * (n % 2 == 0 ? -1.0 : 1.0);
    const Vec2 direction(ahead.x * std::cos(angle) - ahead.y * std::sin(angle),
                         ahead.x * std::sin(angle) + ahead.y * std::cos(angle));
    double free = within_m(place, person.left_m, direction, beyond_m);
    const Vec2 velocity = aim.most_mps * direction;
    for (const Body& body : bodies) {
      if (free <= 0.0) break;
      free = std::min(free, free_m(body, velocity, aim.most_mps));
    }
    if (is_stuck && free < 0.1) continue;
    const double reach_m = std::min(horizon_m, std::max(way_m, 1.0) + 2.0);
    // No further than to where he is nearest to his aim; who is stuck goes some way at least.
    const double least_m = is_stuck ? 0.4 : 0.0;
    const double goes_m = std::min(free, std::max(reach_m * std::cos(angle), least_m));
    double cost = reach_m * reach_m + goes_m * goes_m - 2.0 * reach_m * goes_m * std::cos(angle);
    // Not hither and thither: a direction near the present one is a little better.
    cost -= 0.15 * glm::dot(direction, person.velocity_mps);
    if (cost < best - 1e-9) best = cost, best_free_m = free, chosen = direction;
  }
  return std::min(aim.most_mps, best_free_m / reaction_s) * chosen;
}

}  // namespace septet::traffic
