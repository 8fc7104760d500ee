#include "sim-client/film/accident/camera_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/world/participant_shape.hpp"

namespace septet::film {
namespace {

constexpr double endless_from_m = 1e5;      ///< An obstacle that is higher has no upper end.
constexpr double step_of_sight_m = 0.5;     ///< Between points of a line of sight that are looked at.
constexpr double near_participant_m = 3.0;  ///< That far from its end a line of sight is the participant's own.

double distance_in_plan_m(const Vec2& p, const Obstacle& obstacle) {
  const Vec2 along = obstacle.to_m - obstacle.from_m;
  const double square = glm::dot(along, along);
  const double share = square > 0.0 ? std::clamp(glm::dot(p - obstacle.from_m, along) / square, 0.0, 1.0) : 0.0;
  const double radius_m =
      obstacle.kind == ObstacleKind::tree ? std::max(crown_radius_m, obstacle.radius_m) : obstacle.radius_m;
  return std::max(0.0, glm::length(p - obstacle.from_m - share * along) - radius_m);
}

double outside_of_range_m(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

/// Even number of crossings of a ray to the east: p is outside.
bool is_within(const Vec2& p, const std::vector<Obstacle>& walls) {
  bool inside = false;
  for (const Obstacle& wall : walls) {
    const Vec2 &a = wall.from_m, &b = wall.to_m;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// True if both ways have this instant at this index, which is so while both are there from the window's begin on.
const WayPoint* at_time(const Involved& one, double time_s) {
  const auto found = std::ranges::lower_bound(one.way, time_s - 1e-6, {}, &WayPoint::time_s);
  return found != one.way.end() && found->time_s < time_s + 1e-6 ? &*found : nullptr;
}

}  // namespace

double distance_from_body_m(const Vec3& p, const VehicleModel& model, const WayPoint& at) {
  const Vec3 apart = p - at.position_m;
  const double c = std::cos(at.heading_rad), s = std::sin(at.heading_rad);
  const double x = c * apart.x + s * apart.y, y = c * apart.y - s * apart.x;
  return glm::length(Vec3(outside_of_range_m(x, -model.rear_overhang_m, model.front_m()),
                          outside_of_range_m(y, -model.width_m / 2.0, model.width_m / 2.0),
                          outside_of_range_m(apart.z, 0.0, model.height_m)));
}

Solids::Solids(std::shared_ptr<const roadside::Obstacles> obstacles) : obstacles_(std::move(obstacles)) {
  if (!obstacles_) return;
  std::map<std::uint32_t, House> by_run;
  for (const Obstacle& obstacle : obstacles_->listed())
    if (obstacle.kind == ObstacleKind::house) by_run[obstacle.run].walls.push_back(obstacle);
  for (auto& [run, house] : by_run) {
    house.low_m = Vec2(1e300), house.high_m = Vec2(-1e300);
    for (const Obstacle& wall : house.walls)
      for (const Vec2& corner : {wall.from_m, wall.to_m})
        house.low_m = glm::min(house.low_m, corner), house.high_m = glm::max(house.high_m, corner);
    houses_.push_back(std::move(house));
  }
}

double Solids::standing_m(const Vec3& p, double reach_m) const {
  std::optional<double> known_top_m;  // The land's height costs more than all else.
  const auto top_m = [&] {
    if (!known_top_m) known_top_m = obstacles_->terrain().height_m(Vec2(p)) + endless_above_ground_m;
    return *known_top_m;
  };
  double least_m = reach_m;
  for (const Obstacle& obstacle : obstacles_->near(Vec2(p), reach_m + crown_radius_m)) {
    const double beside_m = distance_in_plan_m(Vec2(p), obstacle);
    if (beside_m >= least_m) continue;
    const bool endless = obstacle.high_m > endless_from_m;
    const double above_m =
        outside_of_range_m(p.z, endless ? -1e300 : obstacle.low_m, endless ? top_m() : obstacle.high_m);
    least_m = std::min(least_m, std::hypot(beside_m, above_m));
  }
  for (const House& house : houses_)
    if (p.x > house.low_m.x && p.y > house.low_m.y && p.x < house.high_m.x && p.y < house.high_m.y &&
        is_within(Vec2(p), house.walls))
      least_m = std::min(least_m, std::max(0.0, p.z - top_m()));
  return least_m;
}

double Solids::distance_m(const Vec3& p, double reach_m) const {
  if (!obstacles_) return reach_m;
  return std::clamp(p.z - obstacles_->terrain().height_m(Vec2(p)), 0.0, standing_m(p, reach_m));
}

bool Solids::holds(const Vec3& p) const { return obstacles_ && standing_m(p, step_of_sight_m) <= 0.0; }

CameraPose camera_pose(const Shot& shot, const Involved* pivot, const WayPoint& at) {
  if (shot.place_m) return {*shot.place_m, *shot.place_m};
  const VehicleModel model = pivot ? shape_of(pivot->model, pivot->box_size_m) : vehicle_models().front();
  const double heading_rad = shot.heading_rad + (shot.bearings == Bearings::vehicle ? at.heading_rad : 0.0);
  const Vec3 ahead(std::cos(at.heading_rad), std::sin(at.heading_rad), 0.0);
  const Vec3 aim_m = at.position_m + model.centre_x_m() * ahead + Vec3(0.0, 0.0, 0.5 * model.height_m);
  const Vec3 looks(std::cos(shot.pitch_rad) * std::cos(heading_rad), std::cos(shot.pitch_rad) * std::sin(heading_rad),
                   std::sin(shot.pitch_rad));
  return {aim_m - shot.distance_m * looks, aim_m};
}

bool is_clear(const Shot& shot, const AccidentFacts& facts, const Solids& solids) {
  const auto named = [&](const Involved& one) {
    return shot.participant == name_of(one) || shot.participant == std::to_string(one.number);
  };
  const auto pivot = std::ranges::find_if(facts.involved, named);
  if (!shot.place_m && pivot == facts.involved.end()) return false;
  const Involved& clock = shot.place_m ? facts.involved.front() : *pivot;
  double looked_until_s = -1e300;
  for (const WayPoint& at : clock.way) {
    if (at.time_s < shot.from_s - 1e-6 || at.time_s > shot.to_s + 1e-6) continue;
    const CameraPose pose = camera_pose(shot, shot.place_m ? nullptr : &clock, at);
    for (const auto* people : {&facts.involved, &facts.bystanders})
      for (const Involved& one : *people)
        if (const WayPoint* other = at_time(one, at.time_s))
          if (distance_from_body_m(pose.eye_m, shape_of(one.model, one.box_size_m), *other) < least_clearance_m)
            return false;
    if (solids.distance_m(pose.eye_m, 2.0 * least_clearance_m) < least_clearance_m) return false;
    if (at.time_s < looked_until_s + 0.1) continue;  // Lines of sight: ten times a second.
    looked_until_s = at.time_s;
    const Vec3 sight = pose.aim_m - pose.eye_m;
    const double length_m = glm::length(sight);
    for (double on_m = step_of_sight_m; on_m < length_m - near_participant_m; on_m += step_of_sight_m)
      if (solids.holds(pose.eye_m + on_m / length_m * sight)) return false;
  }
  return true;
}

std::optional<Shot> cleared(const Shot& shot, const AccidentFacts& facts, const Solids& solids) {
  if (is_clear(shot, facts, solids)) return shot;
  Shot moved = shot;
  if (shot.place_m) {
    for (const double higher_m : {2.0, 5.0, 10.0, 20.0, 30.0, 45.0}) {
      moved.place_m = *shot.place_m + Vec3(0.0, 0.0, higher_m);
      if (is_clear(moved, facts, solids)) return moved;
    }
    return std::nullopt;
  }
  for (const double share : {1.0, 0.75, 0.55})
    for (const double turned_deg : {0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 130.0, -130.0, 180.0}) {
      moved.distance_m = share * shot.distance_m;
      moved.heading_rad =
          std::remainder(shot.heading_rad + turned_deg / 180.0 * std::numbers::pi, 2.0 * std::numbers::pi);
      if (is_clear(moved, facts, solids)) return moved;
    }
  return std::nullopt;
}

}  // namespace septet::film
