#include "engine/simulation/bodies/loose_hull.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/effects/body_box.hpp"

namespace septet::simulation {
namespace {

class LooseHull : public vehicle::HullBearer {
 public:
  explicit LooseHull(LooseBody& loose) : loose_(loose) {}
  vehicle::Hull hull() const override {
    const debris::Box box = body_box(participant_of(loose_));
    const double middle_z_m = box.world_from_box.position_m.z;
    return {side_of(loose_),
            middle_z_m - box.half_size_m.z,
            middle_z_m + box.half_size_m.z,
            middle_z_m,
            Vec3(loose_.body.velocity_mps, loose_.climb_mps),
            Vec3(0.0, 0.0, loose_.body.yaw_rate_radps)};
  }
  void take(const impact::Body& /*before*/, const impact::Body& after, double /*dt_s*/) override {
    loose_.body = after;
  }

 private:
  LooseBody& loose_;
};

}  // namespace

bool is_engaged(const LooseBody& loose) {
  return std::ranges::any_of(loose.hull.touches, [](const vehicle::HullTouch& touch) {
    return !touch.over || !touch.engagement.pulses.empty();
  });
}

std::vector<Obstacle> obstacles_near(const Model& model, std::span<const std::uint32_t> gone, const LooseBody& loose) {
  if (!model.obstacles) return {};
  const double reach_m = glm::length(side_of(loose).outline.half_m);
  return model.obstacles->near(loose.body.mass_centre_m, reach_m + glm::length(loose.body.velocity_mps) * tick_s, gone);
}

void meet_obstacles(std::span<const Obstacle> obstacles, double dt_s, const impact::Due& due, LooseBody& loose,
                    vehicle::HullReport& report) {
  LooseHull bearer(loose);
  vehicle::advance_hull(obstacles, dt_s, due, bearer, loose.hull, report);
}

}  // namespace septet::simulation
