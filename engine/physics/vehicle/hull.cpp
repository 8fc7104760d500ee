#include "engine/physics/vehicle/hull.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/math/plane_vector.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::vehicle {
namespace {

constexpr double blow_s = 0.25;  // End of the impact itself; later contact is sliding.
constexpr double let_go_s = 0.1, forgotten_s = 0.5;
constexpr double joint_m = 0.15;  // Limit of the extra depth with which a next stretch is met.

double crush_force_n(double mass_kg, double depth_m) {
  const Crush& crush = passenger_car_crush();
  const double stiffness_npm = 0.5 * mass_kg * crush.frequency_radps * crush.frequency_radps;
  return stiffness_npm * (depth_m + (crush.harder_times - 1.0) * std::max(0.0, depth_m - crush.crumple_m));
}

/// Loads along the curve of the crush, and unloads within a few centimetres.
double normal_force_n(double mass_kg, double depth_m, double& crush_m) {
  if (depth_m >= crush_m) {
    crush_m = depth_m;
    return crush_force_n(mass_kg, depth_m);
  }
  const double spring_m = 0.01 + 0.02 * crush_m;
  return crush_force_n(mass_kg, crush_m) * std::max(0.0, 1.0 - (crush_m - depth_m) / spring_m);
}

/// The hull in plan during one step: a rectangle in the body's level axes.
struct Plan {
  Vec2 centre_m, forward, mass_centre_m;
  Vec2 half_m;
  double low_m = 0.0, high_m = 0.0;

  Vec2 to_world(const Vec2& local) const { return centre_m + local.x * forward + local.y * left_of(forward); }
  Vec2 direction_to_world(const Vec2& local) const { return local.x * forward + local.y * left_of(forward); }
  Vec2 to_local(const Vec2& world) const {
    return {glm::dot(world - centre_m, forward), glm::dot(world - centre_m, left_of(forward))};
  }
  std::size_t zone(const Vec2& local) const {
    const auto third = [](double share) { return static_cast<std::size_t>(std::clamp(1.5 * (share + 1.0), 0.0, 2.0)); };
    return 3 * third(local.x / half_m.x) + third(local.y / half_m.y);
  }
};

Plan plan_of(const BodyParameters& body, const VehicleState& state) {
  Plan plan;
  const Vec3 forward = state.world_from_body.orientation * Vec3(1.0, 0.0, 0.0);
  const double level = std::hypot(forward.x, forward.y);
  plan.forward = level > 0.1 ? Vec2(forward) / level : Vec2(1.0, 0.0);
  plan.mass_centre_m = Vec2(state.world_from_body.position_m);
  plan.centre_m =
      plan.mass_centre_m + (0.5 * body.length_m - body.rear_overhang_m - body.mass_centre_x_m) * plan.forward;
  plan.half_m = {0.5 * body.length_m, 0.5 * body.width_m};
  const double ground_m = state.world_from_body.position_m.z - body.mass_centre_z_m;
  plan.low_m = ground_m + 0.2;  // The wheels climb lower obstacles.
  plan.high_m = ground_m + body.height_m;
  return plan;
}

struct Contact {
  Vec2 point_m, normal;  ///< World; from the obstacle to the car.
  double depth_m = 0.0;
  std::size_t zone = 0;
};

/// The obstacle as a circle at `middle_m`. `face`: in and out, the side of the hull through which it came.
std::optional<Contact> round_contact(const Plan& plan, const Vec2& middle_m, double radius_m, Vec2& face) {
  const Vec2 local = plan.to_local(middle_m);
  const Vec2 nearest = glm::clamp(local, -plan.half_m, plan.half_m);
  const Vec2 outwards = local - nearest;
  const double distance_m = glm::length(outwards);
  if (distance_m >= radius_m) return std::nullopt;
  if (distance_m > 1e-9) {
    const bool front = std::abs(outwards.x) > std::abs(outwards.y);
    face = front ? Vec2(outwards.x > 0.0 ? 1.0 : -1.0, 0.0) : Vec2(0.0, outwards.y > 0.0 ? 1.0 : -1.0);
    return Contact{plan.to_world(nearest), -plan.direction_to_world(outwards / distance_m), radius_m - distance_m,
                   plan.zone(nearest)};
  }
  if (face == Vec2(0.0)) {
    const Vec2 to_side = plan.half_m - glm::abs(local);
    face = to_side.x < to_side.y ? Vec2(local.x > 0.0 ? 1.0 : -1.0, 0.0) : Vec2(0.0, local.y > 0.0 ? 1.0 : -1.0);
  }
  const double to_face_m = glm::dot(plan.half_m, glm::abs(face)) - glm::dot(local, face);
  const Vec2 surface = local + to_face_m * face;
  return Contact{plan.to_world(local), -plan.direction_to_world(face), to_face_m + radius_m, plan.zone(surface)};
}

/// Visits the parts of the hull behind the line: its corners.
template <class Visit>
void for_each_line_contact(const Plan& plan, const Obstacle& line, double side, const Visit& visit) {
  const Vec2 along_m = line.to_m - line.from_m;
  const double length_m = glm::length(along_m);
  const Vec2 along = along_m / length_m, normal = side * left_of(along);
  for (const Vec2& sign : {Vec2(-1, -1), Vec2(-1, 1), Vec2(1, -1), Vec2(1, 1)}) {
    const Vec2 corner = plan.to_world(sign * plan.half_m);
    const double station_m = glm::dot(corner - line.from_m, along);
    if (station_m < 0.0 || station_m >= length_m) continue;
    const double depth_m = line.radius_m - glm::dot(corner - line.from_m, normal);
    if (depth_m > 0.0) visit(Contact{corner, normal, depth_m, plan.zone(sign * plan.half_m)});
  }
}

class Step {
 public:
  Step(const VehicleParameters& parameters, double dt_s, VehicleState& state, HullState& hull, HullReport& report)
      : body_(parameters.body),
        dt_s_(dt_s),
        state_(state),
        hull_(hull),
        report_(report),
        plan_(plan_of(body_, state)) {}

  void meet(const Obstacle& obstacle) {
    if (obstacle.high_m < plan_.low_m || obstacle.low_m > plan_.high_m) return;
    const bool line = obstacle.from_m != obstacle.to_m;
    if (line) {
      const HullTouch* known = find(obstacle.run);
      const double side = known ? known->side
                          : cross(obstacle.to_m - obstacle.from_m, plan_.mass_centre_m - obstacle.from_m) < 0.0 ? -1.0
                                                                                                                : 1.0;
      const double most_m = joint_m + (known ? known->depth_m : 0.0);
      for_each_line_contact(plan_, obstacle, side, [&](const Contact& contact) {
        if (contact.depth_m <= most_m) press(contact, obstacle, side, Vec2(0.0));
      });
    }
    const auto meet_round = [&](const Vec2& middle_m) {
      const HullTouch* known = find(obstacle.run);
      Vec2 face = known ? known->face : Vec2(0.0);
      if (const auto contact = round_contact(plan_, middle_m, obstacle.radius_m, face))
        if (!line || contact->depth_m <= joint_m + (known ? known->depth_m : 0.0)) press(*contact, obstacle, 1.0, face);
    };
    if (obstacle.open_from) meet_round(obstacle.from_m);
    if (line && obstacle.open_to) meet_round(obstacle.to_m);
  }

  void finish() {
    for (HullTouch& touch : hull_.touches) {
      touch.age_s += dt_s_;
      const auto entered = std::ranges::find(entered_, touch.run, &Entered::run);
      touch.depth_m = entered == entered_.end() ? 0.0 : entered->depth_m;
      touch.free_s = entered == entered_.end() ? touch.free_s + dt_s_ : 0.0;
      if (!touch.over && (touch.age_s > blow_s || touch.free_s > let_go_s)) {
        touch.over = true;
        report_.over.push_back(touch);
      }
    }
    std::erase_if(hull_.touches, [](const HullTouch& touch) { return touch.free_s > forgotten_s; });
  }

 private:
  HullTouch* find(std::uint32_t run) {
    const auto found = std::ranges::find(hull_.touches, run, &HullTouch::run);
    return found == hull_.touches.end() ? nullptr : &*found;
  }

  Vec2 velocity_at(const Vec2& point_m) const {
    const double yaw = (state_.world_from_body.orientation * state_.angular_velocity_radps).z;
    return Vec2(state_.velocity_mps) + yaw * left_of(point_m - plan_.mass_centre_m);
  }

  HullTouch& begin(const Contact& contact, const Obstacle& obstacle, double side) {
    HullTouch touch;
    touch.run = obstacle.run;
    touch.kind = obstacle.kind;
    touch.point_m = Vec3(contact.point_m, state_.world_from_body.position_m.z);
    touch.normal = Vec3(contact.normal, 0.0);
    touch.velocity_mps = state_.velocity_mps;
    touch.angular_velocity_radps = state_.world_from_body.orientation * state_.angular_velocity_radps;
    touch.closing_speed_mps = -glm::dot(velocity_at(contact.point_m), contact.normal);
    touch.side = side;
    report_.begun.push_back(touch);
    return hull_.touches.emplace_back(touch);
  }

  void press(const Contact& contact, const Obstacle& obstacle, double side, const Vec2& face) {
    HullTouch* touch = find(obstacle.run);
    const bool fresh = !touch;
    if (fresh) touch = &begin(contact, obstacle, side);
    if (face != Vec2(0.0)) touch->face = face;
    auto entered = std::ranges::find(entered_, obstacle.run, &Entered::run);
    if (entered == entered_.end()) entered = entered_.insert(entered, {obstacle.run, 0.0});
    entered->depth_m = std::max(entered->depth_m, contact.depth_m);
    const Vec2 arm = contact.point_m - plan_.mass_centre_m, velocity = velocity_at(contact.point_m);
    const auto effective_kg = [&](const Vec2& way) {
      const double turn = cross(arm, way);
      return 1.0 / (1.0 / body_.mass_kg + turn * turn / body_.inertia_kgm2.z);
    };
    if (obstacle.yielding_kg > 0.0) {
      if (!fresh || touch->closing_speed_mps <= 0.0) return;
      const double own = effective_kg(contact.normal), both = own * obstacle.yielding_kg / (own + obstacle.yielding_kg);
      push(both * touch->closing_speed_mps * contact.normal, arm, *touch);
      return;
    }
    const double normal_ns = dt_s_ * normal_force_n(body_.mass_kg, contact.depth_m, hull_.crush_m[contact.zone]);
    const Vec2 sliding = velocity - glm::dot(velocity, contact.normal) * contact.normal;
    Vec2 impulse_ns = normal_ns * contact.normal;
    if (const double slide_mps = glm::length(sliding); slide_mps > 1e-6) {
      const Vec2 way = sliding / slide_mps;
      impulse_ns -= std::min(obstacle.friction * normal_ns, 0.5 * effective_kg(way) * slide_mps) * way;
    }
    push(impulse_ns, arm, *touch);
  }

  void push(const Vec2& impulse_ns, const Vec2& arm, HullTouch& touch) {
    const Vec3 change(impulse_ns / body_.mass_kg, 0.0);
    const Vec3 turn = glm::conjugate(state_.world_from_body.orientation) *
                      Vec3(0.0, 0.0, cross(arm, impulse_ns) / body_.inertia_kgm2.z);
    state_.velocity_mps += change;
    state_.angular_velocity_radps += turn;
    state_.acceleration_mps2 += change / dt_s_;
    state_.whole_acceleration_mps2 += change / dt_s_;
    state_.angular_acceleration_radps2 += turn / dt_s_;
    if (!touch.over) touch.delta_v_mps += Vec2(change);
  }

  const BodyParameters& body_;
  double dt_s_;
  VehicleState& state_;
  HullState& hull_;
  HullReport& report_;
  Plan plan_;
  struct Entered {
    std::uint32_t run;
    double depth_m;
  };
  std::vector<Entered> entered_;  // Depths in this step.
};

}  // namespace

double hull_reach_m(const VehicleParameters& parameters) {
  const BodyParameters& body = parameters.body;
  const double front_m = body.length_m - body.rear_overhang_m - body.mass_centre_x_m;
  return std::hypot(std::max(front_m, body.length_m - front_m), 0.5 * body.width_m);
}

void advance_hull(const VehicleParameters& parameters, std::span<const Obstacle> obstacles, double dt_s,
                  VehicleState& state, HullState& hull, HullReport& report) {
  if (obstacles.empty() && hull.touches.empty()) return;
  Step step(parameters, dt_s, state, hull, report);
  for (const Obstacle& obstacle : obstacles) step.meet(obstacle);
  step.finish();
}

}  // namespace septet::vehicle
