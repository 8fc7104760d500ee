#include "engine/physics/person/jointed_body.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace septet::person {
namespace {

constexpr int steps = 8;             // Of about a millisecond.
constexpr int iterations = 12;       // Of impulses within a step.
constexpr double twice_at_m = 0.08;  // The deeper a vehicle is pressed in, the harder it is, by the square.
constexpr double still_mps = 0.08;
constexpr std::uint32_t still_ticks = 60;

/// One ball that touches something, through a step.
struct Contact {
  Ball ball;
  Vec3 normal;
  MovingSolid* vehicle = nullptr;  ///< Null: the ground.
  Vec3 surface_mps{0.0};           ///< Of the vehicle's turning; its velocity is added.
  double friction = 0.0, depth_m = 0.0;
  double share = 0.0;  ///< m/s of the ball a N·s.
  double most_ns = INFINITY;
  double given_ns = 0.0;
  Vec3 rubbed_ns{0.0};
};

class Step {
 public:
  Step(const Plan& plan, JointedBody& body) : plan_(plan), body_(body) {
    for (std::size_t i = 0; i < plan.mass_share.size(); ++i) per_kg_[i] = 1.0 / (plan.mass_share[i] * body.mass_kg);
  }

  void fall(double speed_mps) {
    for (std::size_t i = 0; i < plan_.mass_share.size(); ++i) body_.masses[i].velocity_mps.z -= speed_mps;
  }

  void touch_ground(const Ground& ground) {
    for (const Ball& ball : plan_.balls) {
      const double depth_m = ball.radius_m - glm::dot(position_m(ball) - ground.point_m, ground.normal);
      if (depth_m > 0.0)
        add({ball, ground.normal, nullptr, {}, plan_.ground_friction * ground.friction_factor, depth_m});
    }
  }

  /// `back_s`: time until the tick's end.
  void touch_vehicle(MovingSolid& vehicle, double back_s, double step_s) {
    const RigidTransform now{vehicle.world_from_vehicle.position_m - back_s * vehicle.velocity_mps,
                             vehicle.world_from_vehicle.orientation};
    const RigidTransform vehicle_from_world = inverse(now);
    for (const Ball& ball : plan_.balls) {
      const Vec3 at = position_m(ball), in_vehicle = vehicle_from_world * at;
      for (const Piece& piece : vehicle.pieces) {
        const Depth depth = depth_in(piece, in_vehicle, ball.radius_m);
        if (depth.depth_m <= 0.0) continue;
        const Vec3 normal = now.orientation * depth.normal;
        const Vec3 turning = glm::cross(vehicle.angular_velocity_radps, at - now.position_m);
        const double closing = -glm::dot(velocity_mps(ball) - vehicle.velocity_mps - turning, normal);
        note(ball, depth.part, closing, at - ball.radius_m * normal, normal, vehicle.touches);
        Contact contact{ball, normal, &vehicle, turning, plan_.vehicle_friction, depth.depth_m};
        const double deep = depth.depth_m / twice_at_m;
        contact.most_ns = plan_.most_force_n * (1.0 + deep * deep) * step_s;
        add(contact);
      }
    }
  }

  /// Impulses until rods keep their lengths and nothing goes deeper.
  void settle(double dt_s) {
    constexpr double tone_s = 0.35;  // What is left of muscles and joints resists bending.
    for (const Rod& limit : plan_.limits) resist(limit, dt_s / tone_s);
    for (int i = 0; i < iterations; ++i) {
      for (const Rod& limit : plan_.limits) keep(limit);
      for (Contact& contact : contacts_) press(contact);
      for (const Rod& rod : plan_.rods) keep(rod);
    }
  }

  void move(double dt_s) {
    for (std::size_t i = 0; i < plan_.mass_share.size(); ++i)
      body_.masses[i].position_m += dt_s * body_.masses[i].velocity_mps;
    // What the impulses left of errors is put right in the places alone, so that it adds no speed.
    constexpr double share = 0.25, slack_m = 0.002, most_m = 0.01, rises_mps = 0.6;
    for (const Contact& contact : contacts_) {
      const double most = contact.vehicle ? rises_mps * dt_s : most_m;
      const double way_m = std::min(most, share * (contact.depth_m - slack_m));
      if (way_m > 0.0) shift(contact.ball, contact.normal * (way_m / own_share(contact.ball)));
    }
    for (int i = 0; i < 4; ++i) {
      for (const Rod& rod : plan_.rods) straighten(rod);
      for (const Rod& limit : plan_.limits) straighten(limit);
    }
  }

 private:
  Vec3 position_m(const Ball& ball) const {
    return (1.0 - ball.t) * body_.masses[ball.a].position_m + ball.t * body_.masses[ball.b].position_m;
  }
  Vec3 velocity_mps(const Ball& ball) const {
    return (1.0 - ball.t) * body_.masses[ball.a].velocity_mps + ball.t * body_.masses[ball.b].velocity_mps;
  }
  double own_share(const Ball& ball) const {
    return (1.0 - ball.t) * (1.0 - ball.t) * per_kg_[ball.a] + ball.t * ball.t * per_kg_[ball.b];
  }
  void shift(const Ball& ball, const Vec3& amount) {
    body_.masses[ball.a].position_m += (1.0 - ball.t) * per_kg_[ball.a] * amount;
    body_.masses[ball.b].position_m += ball.t * per_kg_[ball.b] * amount;
  }
  void push(const Ball& ball, const Vec3& impulse_ns) {
    body_.masses[ball.a].velocity_mps += (1.0 - ball.t) * per_kg_[ball.a] * impulse_ns;
    body_.masses[ball.b].velocity_mps += ball.t * per_kg_[ball.b] * impulse_ns;
  }

  static void note(const Ball& ball, Part part, double closing_mps, const Vec3& point_m, const Vec3& normal,
                   Touches& touches) {
    if (!touches.body) touches.body = part;
    if (ball.a == 0 && ball.t == 0.0 && !touches.head) touches.head = part;
    if (closing_mps <= touches.closing_mps) return;
    touches.closing_mps = closing_mps, touches.point_m = point_m, touches.normal = normal;
  }

  Vec3 sliding_mps(const Contact& contact) const {
    Vec3 relative = velocity_mps(contact.ball) - contact.surface_mps;
    if (contact.vehicle) relative -= contact.vehicle->velocity_mps;
    return relative;
  }

  void add(Contact contact) {
    contact.share = own_share(contact.ball) + (contact.vehicle ? 1.0 / contact.vehicle->mass_kg : 0.0);
    contacts_.push_back(contact);
  }

  void exchange(const Contact& contact, const Vec3& impulse_ns) {
    push(contact.ball, impulse_ns);
    if (!contact.vehicle) return;
    contact.vehicle->velocity_mps -= impulse_ns / contact.vehicle->mass_kg;
    contact.vehicle->taken_ns -= impulse_ns;
  }

  void press(Contact& contact) {
    const double approach = -glm::dot(sliding_mps(contact), contact.normal);
    const double given = std::clamp(contact.given_ns + approach / contact.share, 0.0, contact.most_ns);
    exchange(contact, (given - contact.given_ns) * contact.normal);
    contact.given_ns = given;
    // Friction stops the sliding, as far as the pressure of the whole step lets it.
    Vec3 along = sliding_mps(contact);
    along -= glm::dot(along, contact.normal) * contact.normal;
    Vec3 rubbed = contact.rubbed_ns - along / contact.share;
    const double length = glm::length(rubbed), most = contact.friction * contact.given_ns;
    if (length > most) rubbed *= most / length;
    exchange(contact, rubbed - contact.rubbed_ns);
    contact.rubbed_ns = rubbed;
  }

  double error_m(const Rod& rod, Vec3& along) const {
    along = body_.masses[rod.b].position_m - body_.masses[rod.a].position_m;
    const double length_m = glm::length(along);
    if (length_m < 1e-9) return 0.0;
    along /= length_m;
    return length_m < rod.least_m ? length_m - rod.least_m : length_m > rod.most_m ? length_m - rod.most_m : 0.0;
  }

  void pull(const Rod& rod, const Vec3& along, double speed_mps) {
    const double impulse_ns = speed_mps / (per_kg_[rod.a] + per_kg_[rod.b]);
    body_.masses[rod.a].velocity_mps += impulse_ns * per_kg_[rod.a] * along;
    body_.masses[rod.b].velocity_mps -= impulse_ns * per_kg_[rod.b] * along;
  }
  double parting_mps(const Rod& rod, const Vec3& along) const {
    return glm::dot(body_.masses[rod.b].velocity_mps - body_.masses[rod.a].velocity_mps, along);
  }

  void keep(const Rod& rod) {
    Vec3 along;
    const double error = error_m(rod, along), parting = parting_mps(rod, along);
    const bool is_stiff = rod.least_m == rod.most_m;
    if (is_stiff || (error < 0.0 && parting < 0.0) || (error > 0.0 && parting > 0.0)) pull(rod, along, parting);
  }

  void resist(const Rod& rod, double share) {
    Vec3 along;
    error_m(rod, along);
    pull(rod, along, share * parting_mps(rod, along));
  }

  void straighten(const Rod& rod) {
    Vec3 along;
    const double error = error_m(rod, along);
    if (error == 0.0) return;
    const Vec3 way = 0.5 * error / (per_kg_[rod.a] + per_kg_[rod.b]) * along;
    body_.masses[rod.a].position_m += per_kg_[rod.a] * way;
    body_.masses[rod.b].position_m -= per_kg_[rod.b] * way;
  }

  const Plan& plan_;
  JointedBody& body_;
  std::array<double, most_masses> per_kg_{};
  std::vector<Contact> contacts_;
};

}  // namespace

bool lies_still(const JointedBody& body) { return body.still_ticks >= still_ticks; }

void advance_body(const std::optional<Ground>& ground, double gravity_mps2, double dt_s,
                  std::span<MovingSolid> vehicles, JointedBody& body) {
  const Plan& plan = plan_of(body.kind);
  for (MovingSolid& vehicle : vehicles) vehicle.touches = {};
  const double step_s = dt_s / steps;
  for (int i = 0; i < steps; ++i) {
    Step step(plan, body);
    step.fall(gravity_mps2 * step_s);
    if (ground) step.touch_ground(*ground);
    for (MovingSolid& vehicle : vehicles) step.touch_vehicle(vehicle, (steps - 1 - i) * step_s, step_s);
    step.settle(step_s);
    step.move(step_s);
  }
  double fastest = 0.0;
  for (std::size_t i = 0; i < plan.mass_share.size(); ++i)
    fastest = std::max(fastest, glm::dot(body.masses[i].velocity_mps, body.masses[i].velocity_mps));
  body.still_ticks = fastest < still_mps * still_mps ? body.still_ticks + 1 : 0;
  if (lies_still(body))
    for (PointMass& mass : body.masses) mass.velocity_mps = Vec3(0.0);
}

Vec3 mass_centre_m(const JointedBody& body) {
  const Plan& plan = plan_of(body.kind);
  Vec3 centre(0.0);
  for (std::size_t i = 0; i < plan.mass_share.size(); ++i) centre += plan.mass_share[i] * body.masses[i].position_m;
  return centre;
}

Vec3 momentum_ns(const JointedBody& body) {
  const Plan& plan = plan_of(body.kind);
  Vec3 momentum(0.0);
  for (std::size_t i = 0; i < plan.mass_share.size(); ++i)
    momentum += plan.mass_share[i] * body.mass_kg * body.masses[i].velocity_mps;
  return momentum;
}

}  // namespace septet::person
