#include "engine/simulation/step_edges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/road/road_locate.hpp"
#include "engine/simulation/ground_faces.hpp"
#include "engine/simulation/wheel_ground.hpp"

namespace septet::simulation {
namespace {

constexpr double noticed_m = 0.03;  ///< A lower step is a bump: the plane under the wheel jumps by it.

/// Ground around the plane on which a wheel stands.
class Surroundings {
 public:
  Surroundings(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised, double level_m,
               const road::RoadPosition& place, const vehicle::WheelGround& floor)
      : roads_(roads), raised_(raised), level_m_(level_m), place_(place), floor_(floor) {}

  /// Height of the ground over the plane under the wheel; 0 where no road is near.
  double rise_m(const Vec2& at) const {
    const auto height = height_m(at);
    return height ? *height - plane_m(at) : 0.0;
  }

  double top_m(const Vec2& at) const { return plane_m(at) + rise_m(at); }

  /// First step up on the path from a point along `ahead`, as far as `towards_m` (negative: backwards). It is seen if
  /// it is a quarter of `radius_m` long.
  std::optional<Vec2> first_step(const Vec2& from, const Vec2& ahead, double towards_m, double radius_m) const {
    const int looks = static_cast<int>(std::ceil(4.0 * std::abs(towards_m) / radius_m - 1e-9));
    double low_m = 0.0, high_m = 0.0;
    int look = 1;
    for (; look <= looks; ++look) {
      high_m = towards_m * look / looks;
      if (rise_m(from + high_m * ahead) >= noticed_m) break;
      low_m = high_m;
    }
    if (look > looks) return std::nullopt;
    for (int halving = 0; halving < 9; ++halving) {  // To a millimetre.
      const double middle_m = 0.5 * (low_m + high_m);
      (rise_m(from + middle_m * ahead) < noticed_m ? low_m : high_m) = middle_m;
    }
    if (rise_m(from + high_m * ahead) - rise_m(from + low_m * ahead) < noticed_m) return std::nullopt;  // A ramp.
    return from + high_m * ahead;
  }

 private:
  std::optional<double> height_m(const Vec2& at) const {
    const auto surface = road::surface_at(roads_, at, &place_, surface_reach_m, level_m_);
    if (!surface) return std::nullopt;
    return raised_ ? raised_->ground_at(at, surface->height_m) : surface->height_m;
  }
  double plane_m(const Vec2& at) const {
    const Vec2 away = at - Vec2(floor_.point_m);
    return floor_.point_m.z - glm::dot(Vec2(floor_.normal), away) / floor_.normal.z;
  }

  const road::RoadNetwork& roads_;
  const roadside::RaisedAreas* raised_;
  double level_m_;
  const road::RoadPosition& place_;
  const vehicle::WheelGround& floor_;
};

/// Level direction square to the edge, from two paths beside the wheel's; `ahead` where one of them meets no edge.
Vec2 across_edge(const Surroundings& around, const Vec2& centre, const Vec2& ahead, double towards_m, double radius_m) {
  constexpr double half_tyre_m = 0.1;
  const Vec2 left{-ahead.y, ahead.x};
  const double farther_m = towards_m + std::copysign(3.0 * half_tyre_m, towards_m);
  const auto on_right = around.first_step(centre - half_tyre_m * left, ahead, farther_m, radius_m);
  const auto on_left = around.first_step(centre + half_tyre_m * left, ahead, farther_m, radius_m);
  if (!on_right || !on_left) return ahead;
  const Vec2 along = glm::normalize(*on_left - *on_right);
  return {along.y, -along.x};
}

}  // namespace

void find_step_edges(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised, const Vec3& centre_m,
                     const Vec2& ahead, double radius_m, const road::RoadPosition& place, vehicle::WheelGround& wheel,
                     double way_m) {
  const double reach_m = radius_m + way_m;
  const bool near = raised && raised->is_near(centre_m, std::min(radius_m, 1.0));
  if (!near && !may_step(roads.roads[place.road], place.s_m, reach_m)) return;
  const Surroundings around(roads, near ? raised : nullptr, centre_m.z, place, wheel);
  const Vec2 centre(centre_m);
  const auto edge_towards = [&](double towards_m) -> std::optional<vehicle::StepEdge> {
    const auto at = around.first_step(centre, ahead, towards_m, radius_m);
    if (!at) return std::nullopt;
    return vehicle::StepEdge{Vec3(*at, around.top_m(*at)),
                             Vec3(across_edge(around, centre, ahead, towards_m, radius_m), 0.0)};
  };
  wheel.edges = {edge_towards(reach_m), edge_towards(-radius_m)};
}

}  // namespace septet::simulation
