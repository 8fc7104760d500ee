#include "engine/physics/vehicle/hull_outline.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/math/plane_vector.hpp"
#include "engine/physics/impact/restitution.hpp"

namespace septet::vehicle {
namespace {

constexpr double climbed_m = 0.2;        // The wheels climb lower obstacles.
constexpr double thinnest_m = 0.001;     // An outline needs some rounding.
constexpr double beyond_joint_m = 30.0;  // A closed end lies beyond every hull that touches the stretch.

struct Line {
  Vec2 along, normal;  ///< Unit length; the normal points to the car.
};

Line line_of(const Obstacle& obstacle, double side) {
  const Vec2 along = glm::normalize(obstacle.to_m - obstacle.from_m);
  return {along, side * left_of(along)};
}

double side_of_line(const Obstacle& line, const Vec2& mass_centre_m, std::span<const HullTouch> touches) {
  const auto known = std::ranges::find(touches, line.run, &HullTouch::run);
  if (known != touches.end()) return known->side;
  return cross(line.to_m - line.from_m, mass_centre_m - line.from_m) < 0.0 ? -1.0 : 1.0;
}

/// True where the run goes on at this end of the stretch: `from_m` or `to_m`. Where it bends away from the car it ends,
/// as what the hull touches, at the bend.
bool goes_on(const Obstacle& stretch, bool at_end, const Line& line, std::span<const Obstacle> obstacles) {
  constexpr double joined_m = 1e-3, least_bend = 0.02;
  if (at_end ? stretch.open_to : stretch.open_from) return false;
  const Vec2& joint = at_end ? stretch.to_m : stretch.from_m;
  for (const Obstacle& next : obstacles) {
    if (next.run != stretch.run || &next == &stretch) continue;
    const Vec2 &near = at_end ? next.from_m : next.to_m, &far = at_end ? next.to_m : next.from_m;
    if (glm::distance(near, joint) > joined_m) continue;
    return glm::dot(far - near, line.normal) > -least_bend * glm::distance(far, near);
  }
  return true;
}

impact::Outline line_outline(const Obstacle& stretch, const Line& line, const HullOutline& hull,
                             std::span<const Obstacle> obstacles) {
  const Vec2 from_m = stretch.from_m - (goes_on(stretch, false, line, obstacles) ? beyond_joint_m : 0.0) * line.along,
             to_m = stretch.to_m + (goes_on(stretch, true, line, obstacles) ? beyond_joint_m : 0.0) * line.along;
  impact::Outline outline = impact::wall_outline(from_m, to_m, std::max(thinnest_m, stretch.radius_m));
  const double near_m = glm::length(hull.outline.half_m) + stretch.radius_m;
  const auto is_near = [&](const Vec2& end_m) { return glm::distance(end_m, hull.outline.centre_m) < near_m; };
  // At an open end the hull may also be met along the wall.
  if (!(stretch.open_from && is_near(stretch.from_m)) && !(stretch.open_to && is_near(stretch.to_m)))
    outline.front = line.normal;
  return outline;
}

}  // namespace

HullOutline hull_outline(const BodyParameters& body, const VehicleState& state) {
  const Vec3 ahead = state.world_from_body.orientation * Vec3(1.0, 0.0, 0.0);
  const double level = std::hypot(ahead.x, ahead.y);
  const Vec2 forward = level > 0.1 ? Vec2(ahead) / level : Vec2(1.0, 0.0);
  const double middle_m = 0.5 * body.length_m - body.rear_overhang_m - body.mass_centre_x_m;
  const double ground_m = state.world_from_body.position_m.z - body.mass_centre_z_m;
  return {impact::box_outline(Vec2(state.world_from_body.position_m) + middle_m * forward, forward,
                              {0.5 * body.length_m, 0.5 * body.width_m}, impact::vehicle_corner_m()),
          ground_m + climbed_m, ground_m + body.height_m};
}

std::size_t hull_zone(const impact::Outline& outline, const Vec2& place_m) {
  const auto third = [](double share) { return static_cast<std::size_t>(std::clamp(1.5 * (share + 1.0), 0.0, 2.0)); };
  const Vec2 arm_m = place_m - outline.centre_m;
  return 3 * third(glm::dot(arm_m, outline.forward) / outline.half_m.x) +
         third(glm::dot(arm_m, left_of(outline.forward)) / outline.half_m.y);
}

std::vector<Entered> entered_obstacles(const HullOutline& hull, const Vec2& mass_centre_m,
                                       std::span<const Obstacle> obstacles, std::span<const HullTouch> touches) {
  std::vector<Entered> entered;
  std::vector<double> depths_m;
  for (const Obstacle& obstacle : obstacles) {
    if (obstacle.high_m < hull.low_m || obstacle.low_m > hull.high_m) continue;
    const bool is_line = obstacle.from_m != obstacle.to_m;
    const double radius_m = std::max(thinnest_m, obstacle.radius_m);
    const impact::Outline own = is_line ? impact::wall_outline(obstacle.from_m, obstacle.to_m, radius_m)
                                        : impact::post_outline(obstacle.from_m, radius_m);
    if (!impact::contact_of(hull.outline, own)) continue;
    Entered found{&obstacle, own};
    double depth_m = 0.0;
    if (is_line) {
      found.side = side_of_line(obstacle, mass_centre_m, touches);
      const Line line = line_of(obstacle, found.side);
      found.outline = line_outline(obstacle, line, hull, obstacles);
      depth_m = radius_m + impact::reach_beside_m(hull.outline, -line.normal, obstacle.from_m, line.along,
                                                  glm::distance(obstacle.from_m, obstacle.to_m));
    }
    const auto same = std::ranges::find(entered, obstacle.run, [](const Entered& each) { return each.obstacle->run; });
    if (same == entered.end()) {
      entered.push_back(found);
      depths_m.push_back(depth_m);
    } else if (double& deepest_m = depths_m[static_cast<std::size_t>(same - entered.begin())]; depth_m > deepest_m) {
      *same = found;
      deepest_m = depth_m;
    }
  }
  return entered;
}

}  // namespace septet::vehicle
