#include "engine/sight/lookout.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace septet::sight {
namespace {

/// Radius of a box in plan, however it is turned.
double reach_of_m(const Box& box) { return glm::length(box.half_m); }

}  // namespace

std::array<Vec3, 9> points_to_see(const Box& box) {
  constexpr double within = 0.95;
  std::array<Vec3, 9> points_m;
  std::size_t n = 0;
  for (const double up : {within, 0.0})
    for (const double ahead : {-within, within})
      for (const double left : {-within, within})
        points_m[n++] = box.world_from_box * (Vec3(ahead, left, up) * box.half_m);
  points_m[n] = box.world_from_box * (Vec3(0.0, 0.0, within) * box.half_m);
  return points_m;
}

Lookout::Lookout(const Vec3& eye_m, std::span<const OpaqueBody> bodies, const Walls* walls,
                 std::span<const std::uint32_t> gone)
    : eye_m_(eye_m), walls_(walls), gone_(gone) {
  around_.reserve(bodies.size());
  for (const OpaqueBody& body : bodies) {
    const double reach_m = reach_of_m(body.box);
    const Vec2 away_m = Vec2(body.box.world_from_box.position_m) - Vec2(eye_m);
    if (glm::length(away_m) < reach_m && entry_m(body.box, {eye_m, {0.0, 0.0, 1.0}}) == 0.0) continue;
    around_.push_back({body, away_m, glm::length(away_m) - reach_m, reach_m});
  }
  std::ranges::stable_sort(around_, {}, &Around::nearest_m);
}

std::vector<const Box*> Lookout::before_target(std::uint32_t target, const Box& box) const {
  std::vector<const Box*> before;
  const Vec2 way_m = Vec2(box.world_from_box.position_m) - Vec2(eye_m_);
  const double away_m = glm::length(way_m), reach_m = reach_of_m(box);
  const Vec2 ahead = away_m > 0.0 ? way_m / away_m : Vec2(1.0, 0.0);
  for (const Around& around : around_) {
    if (around.nearest_m > away_m + reach_m) break;
    if (around.body.id == target) continue;
    const double along_m = glm::dot(around.away_m, ahead);
    const double aside_m = ahead.x * around.away_m.y - ahead.y * around.away_m.x;
    // Lines to the box's ends lie within its reach of the line to its middle.
    if (along_m < -around.reach_m - reach_m || std::abs(aside_m) > around.reach_m + reach_m) continue;
    before.push_back(&around.body.box);
  }
  return before;
}

bool Lookout::is_hidden(std::span<const Box* const> before, const Vec3& point_m) const {
  const double away_m = glm::distance(eye_m_, point_m);
  if (!(away_m > 0.0)) return false;
  const Line line{eye_m_, (point_m - eye_m_) / away_m};
  const bool behind_body = std::ranges::any_of(before, [&](const Box* box) {
    const auto enters_m = entry_m(*box, line);
    return enters_m && *enters_m < away_m;
  });
  return behind_body || (walls_ && walls_->hide(eye_m_, point_m, gone_));
}

}  // namespace septet::sight
