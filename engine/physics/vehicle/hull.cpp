#include "engine/physics/vehicle/hull.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/physics/vehicle/hull_outline.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::vehicle {
namespace {

constexpr double blow_s = 0.25;  // End of the impact itself; later contact is sliding.
constexpr double let_go_s = 0.1, forgotten_s = 0.5;
constexpr double bumper_m = 0.02;  // Surfaces within this depth touch at the same time.

/// Adds what the hull's impacts will still change, but for that of one touch.
void add_due(const HullState& hull, const HullTouch* besides, const impact::Body& body, impact::Due& due) {
  for (const HullTouch& touch : hull.touches)
    if (&touch != besides)
      for (const impact::Pulse& pulse : touch.engagement.pulses) impact::add_due(pulse, body, due);
}

/// Of the members that a wall meets, a trunk or post presses half.
Crush crush_at(const Obstacle& obstacle, Crush at_wall) {
  if (obstacle.from_m == obstacle.to_m) at_wall.frequency_radps *= std::sqrt(impact::post_stiffness_share());
  return at_wall;
}

class CarHull : public HullBearer {
 public:
  CarHull(const BodyParameters& body, VehicleState& state) : body_(body), state_(state) {}
  Hull hull() const override {
    const HullOutline whole = hull_outline(body_, state_);
    return {{planar_body(body_, state_), whole.outline, passenger_car_crush()},
            whole.low_m,
            whole.high_m,
            state_.world_from_body.position_m.z,
            state_.velocity_mps,
            state_.world_from_body.orientation * state_.angular_velocity_radps};
  }
  void take(const impact::Body& before, const impact::Body& after, double dt_s) override {
    take_over(before, after, dt_s, state_);
  }

 private:
  const BodyParameters& body_;
  VehicleState& state_;
};

class Step {
 public:
  Step(double dt_s, const impact::Due& due, HullBearer& bearer, HullState& hull, HullReport& report)
      : dt_s_(dt_s), due_(due), bearer_(bearer), hull_(hull), report_(report) {}

  void meet(std::span<const Obstacle> obstacles) {
    const Hull whole = bearer_.hull();
    for (HullTouch& touch : hull_.touches) touch.free_s += dt_s_;
    const auto entered = entered_obstacles({whole.side.outline, whole.low_m, whole.high_m},
                                           whole.side.body.mass_centre_m, obstacles, hull_.touches);
    for (HullTouch& touch : hull_.touches) {
      const auto same = [&](const Entered& each) { return each.obstacle->run == touch.run; };
      if (std::ranges::none_of(entered, same)) let_run(touch);
    }
    for (const Entered& each : entered) press(each);
  }

  void finish() {
    for (HullTouch& touch : hull_.touches) {
      touch.age_s += dt_s_;
      if (!touch.over && (touch.age_s > blow_s || touch.free_s > let_go_s)) {
        touch.over = true;
        report_.over.push_back(touch);
      }
    }
    std::erase_if(hull_.touches,
                  [](const HullTouch& touch) { return touch.free_s > forgotten_s && touch.engagement.pulses.empty(); });
  }

 private:
  /// What the bearer's other impacts will still change.
  impact::Due due_besides(const HullTouch* touch, const impact::Body& body) const {
    impact::Due due = due_;
    add_due(hull_, touch, body, due);
    return due;
  }

  void take(const impact::Body& before, const impact::Side& own, HullTouch& touch) {
    bearer_.take(before, own.body, dt_s_);
    if (!touch.over) touch.delta_v_mps += own.body.velocity_mps - before.velocity_mps;
  }

  /// Gives what is left of an impact whose obstacle the hull has left.
  void let_run(HullTouch& touch) {
    if (touch.engagement.pulses.empty()) return;
    impact::Side own = bearer_.hull().side, other;
    const impact::Body before = own.body;
    impact::advance_pulses(dt_s_, touch.engagement, own, other);
    take(before, own, touch);
  }

  HullTouch& touch_of(const Entered& entered, const Hull& now, bool& fresh) {
    const Obstacle& obstacle = *entered.obstacle;
    const auto known = std::ranges::find(hull_.touches, obstacle.run, &HullTouch::run);
    fresh = known == hull_.touches.end();
    if (!fresh) return *known;
    const impact::Side& own = now.side;
    HullTouch touch;
    touch.run = obstacle.run;
    touch.kind = obstacle.kind;
    touch.velocity_mps = now.velocity_mps;
    touch.angular_velocity_radps = now.angular_velocity_radps;
    touch.side = entered.side;
    touch.mass_kg = own.body.mass_kg;
    impact::Side other;
    other.outline = entered.outline;
    if (const auto at = impact::touch_of(own, other, dt_s_)) {
      const impact::Side then = impact::moved_back(own, at->age_s);
      const Vec2& normal = at->place.normal;
      const Vec2 point_m = impact::engaged_point_m(then.outline, other.outline, at->place, bumper_m);
      touch.point_m = Vec3(point_m, now.middle_z_m);
      touch.normal = Vec3(-normal, 0.0);
      touch.closing_speed_mps = glm::dot(impact::velocity_at(own.body, point_m - then.body.mass_centre_m), normal);
    }
    touch.crushed_m = hull_.crush_m[hull_zone(own.outline, Vec2(touch.point_m))];
    return hull_.touches.emplace_back(touch);
  }

  void press(const Entered& entered) {
    const Obstacle& obstacle = *entered.obstacle;
    const Hull now = bearer_.hull();
    impact::Side own = now.side, other;
    other.outline = entered.outline;
    bool fresh = false;
    HullTouch& touch = touch_of(entered, now, fresh);
    touch.free_s = 0.0;
    own.crush = crush_at(obstacle, own.crush);
    own.crushed_m = touch.crushed_m;
    const impact::Body before = own.body;
    if (obstacle.yielding_kg > 0.0) {
      if (fresh) knock_over(obstacle, touch, own);
    } else {
      const impact::Due due = due_besides(&touch, own.body);
      const auto impact = impact::advance_engagement(obstacle.friction, dt_s_, touch.engagement, own, other, due);
      if (impact) note_crush(*impact, own, other, touch);
    }
    take(before, own, touch);
    if (fresh) report_.begun.push_back(touch);
  }

  static void knock_over(const Obstacle& obstacle, const HullTouch& touch, impact::Side& own) {
    impact::Body struck;
    struck.mass_kg = obstacle.yielding_kg;
    struck.mass_centre_m = Vec2(touch.point_m);  // It is struck through its middle, and does not spin.
    const impact::Place place{Vec2(touch.point_m), -Vec2(touch.normal)};
    const impact::Rule rule{impact::restitution(touch.closing_speed_mps), obstacle.friction};
    if (const auto impulse = impact::impulse_at(own.body, struck, place, rule))
      impact::exchange(*impulse, 1.0, own.body, struck);
  }

  void note_crush(const impact::Impact& impact, const impact::Side& own, const impact::Side& other,
                  const HullTouch& touch) {
    const double along_m = impact::crush_along_m(touch.engagement, own.outline, other.outline, impact.pulse.normal);
    double& deepest_m = hull_.crush_m[hull_zone(own.outline, impact.touch.place.point_m)];
    deepest_m = std::max(deepest_m, touch.crushed_m + along_m);
  }

  double dt_s_;
  const impact::Due& due_;
  HullBearer& bearer_;
  HullState& hull_;
  HullReport& report_;
};

}  // namespace

double hull_reach_m(const VehicleParameters& parameters) {
  const BodyParameters& body = parameters.body;
  const double front_m = body.length_m - body.rear_overhang_m - body.mass_centre_x_m;
  return std::hypot(std::max(front_m, body.length_m - front_m), 0.5 * body.width_m);
}

impact::Due due_to_hull(const HullState& hull, const impact::Body& body) {
  impact::Due due;
  add_due(hull, nullptr, body, due);
  return due;
}

void advance_hull(std::span<const Obstacle> obstacles, double dt_s, const impact::Due& due, HullBearer& bearer,
                  HullState& hull, HullReport& report) {
  if (obstacles.empty() && hull.touches.empty()) return;
  Step step(dt_s, due, bearer, hull, report);
  step.meet(obstacles);
  step.finish();
}

void advance_hull(const VehicleParameters& parameters, std::span<const Obstacle> obstacles, double dt_s,
                  const impact::Due& due, VehicleState& state, HullState& hull, HullReport& report) {
  CarHull car(parameters.body, state);
  advance_hull(obstacles, dt_s, due, car, hull, report);
}

}  // namespace septet::vehicle
