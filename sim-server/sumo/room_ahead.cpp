#include "sim-server/sumo/room_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace septet::server {
namespace {

constexpr double nowhere_m = std::numeric_limits<double>::infinity();

/// The least x of the part of a line from a to b that lies within `half_m` of the x axis.
double nearest_in_strip_m(const Vec2& a, const Vec2& b, double half_m) {
  const double rise = b.y - a.y;
  double from = 0.0, to = 1.0;
  if (rise == 0.0) {
    if (std::abs(a.y) > half_m) return nowhere_m;
  } else {
    const double low = (-half_m - a.y) / rise, high = (half_m - a.y) / rise;
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
    if (from > to) return nowhere_m;
  }
  return std::min(a.x + from * (b.x - a.x), a.x + to * (b.x - a.x));
}

}  // namespace

PlanOutline plan_outline(const RigidTransform& world_from_vehicle, const VehicleModel& model) {
  const double front = model.front_m(), rear = -model.rear_overhang_m, half = 0.5 * model.width_m;
  PlanOutline corners{Vec2(front, half), Vec2(rear, half), Vec2(rear, -half), Vec2(front, -half)};
  for (Vec2& corner : corners) corner = Vec2(world_from_vehicle * Vec3(corner, 0.0));
  return corners;
}

double room_ahead_m(const RigidTransform& world_from_vehicle, const VehicleModel& model, double beside_m,
                    std::span<const PlanOutline> others) {
  const Vec2 middle(world_from_vehicle.position_m);
  const double heading = heading_rad(world_from_vehicle.orientation);
  const Vec2 forward(std::cos(heading), std::sin(heading)), left(-forward.y, forward.x);
  double nearest = nowhere_m;
  for (const PlanOutline& other : others) {
    PlanOutline seen;
    for (std::size_t i = 0; i < seen.size(); ++i)
      seen[i] = Vec2(glm::dot(other[i] - middle, forward), glm::dot(other[i] - middle, left));
    double x = nowhere_m;
    for (std::size_t i = 0; i < seen.size(); ++i)
      x = std::min(x, nearest_in_strip_m(seen[i], seen[(i + 1) % seen.size()], 0.5 * model.width_m + beside_m));
    if (x >= 0.0) nearest = std::min(nearest, std::max(0.0, x - model.front_m()));
  }
  return nearest;
}

}  // namespace septet::server
