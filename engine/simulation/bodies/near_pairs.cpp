#include "engine/simulation/bodies/near_pairs.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/world/participant_shape.hpp"

namespace septet::simulation {
namespace {

/// No part of it is farther than this from its origin, in plan.
double reach_of(const VehicleModel& shape) {
  return std::hypot(std::max(shape.front_m(), shape.rear_overhang_m), 0.5 * shape.width_m);
}
std::vector<double> reaches() {
  std::vector<double> reach_m;
  for (const VehicleModel& model : vehicle_models()) reach_m.push_back(reach_of(model));
  return reach_m;
}

struct Hitter {
  double x_m = 0.0;
  std::size_t index = 0;
};

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Participant>& participants,
                                                            ParticipantId first_engine,
                                                            const std::vector<ParticipantId>& loose) {
  static const std::vector<double> reach_m = reaches();
  const auto reach_of_one_m = [&](const Participant& one) {
    return is_box(one) ? reach_of(shape_of(one)) : reach_m[one.model];
  };
  double longest_m = *std::ranges::max_element(reach_m);
  const auto is_hitter = [&](ParticipantId id) {
    return id < first_engine || (!loose.empty() && std::ranges::binary_search(loose, id));
  };
  std::vector<Hitter> hitters;
  for (std::size_t i = 0; i < participants.size(); ++i)
    if (is_hitter(participants[i].id)) {
      hitters.push_back({participants[i].world_from_vehicle.position_m.x, i});
      longest_m = std::max(longest_m, reach_of_one_m(participants[i]));
    }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (hitters.empty()) return pairs;
  std::ranges::sort(hitters, {}, &Hitter::x_m);
  // Most are far from all of them.
  const double west_m = hitters.front().x_m - 2.0 * longest_m, east_m = hitters.back().x_m + 2.0 * longest_m;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    const Participant& one = participants[i];
    const Vec2 at_m(one.world_from_vehicle.position_m);
    if (at_m.x < west_m || at_m.x > east_m) continue;
    const double most_m = reach_of_one_m(one) + longest_m;
    for (auto near = std::ranges::lower_bound(hitters, at_m.x - most_m, {}, &Hitter::x_m);
         near != hitters.end() && near->x_m <= at_m.x + most_m; ++near) {
      if (near->index == i || (near->index < i && is_hitter(one.id))) continue;  // Found from the other side.
      const Participant& other = participants[near->index];
      const Vec2 apart_m = Vec2(other.world_from_vehicle.position_m) - at_m;
      const double within_m = reach_of_one_m(one) + reach_of_one_m(other);
      if (glm::dot(apart_m, apart_m) < within_m * within_m)
        pairs.emplace_back(std::min(i, near->index), std::max(i, near->index));
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace septet::simulation
