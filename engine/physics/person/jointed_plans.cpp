#include "engine/physics/person/jointed_plans.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::person {
namespace {

// Masses of a person. The back is that of the pelvis: from there hips are kept from bending backwards.
enum PersonMass : std::size_t { head, neck, back, hip_left, hip_right, knee_left, knee_right, foot_left, foot_right };
// Masses of a machine.
enum MachineMass : std::size_t { rear_hub, front_hub, saddle, bar_left, bar_right, bracket_left, bracket_right };

constexpr double hips_x_m = 0.10;  // Middle of a person's model (engine/scenery/vehicles/pedestrian.cpp).
constexpr double hip_half_m = 0.09;

Rod stiff(const Plan& plan, std::size_t a, std::size_t b) {
  const double length_m = glm::length(plan.stands_at_m[b] - plan.stands_at_m[a]);
  return {a, b, length_m, length_m};
}

Plan person_plan() {
  Plan plan;
  // Winter: head 0.081; trunk with both arms 0.597; each thigh 0.100, shank with foot 0.061, halved to their ends.
  plan.mass_share = {0.081, 0.270, 0.130, 0.1485, 0.1485, 0.0733, 0.0733, 0.0377, 0.0377};
  const double knee_m = ankle_height_m + shin_m;
  plan.stands_at_m = {{hips_x_m + 0.02, 0, 1.64},
                      {hips_x_m, 0, 1.42},
                      {hips_x_m - 0.15, 0, hip_height_m},
                      {hips_x_m, hip_half_m, hip_height_m},
                      {hips_x_m, -hip_half_m, hip_height_m},
                      {hips_x_m, hip_half_m, knee_m},
                      {hips_x_m, -hip_half_m, knee_m},
                      {hips_x_m, hip_half_m, ankle_height_m},
                      {hips_x_m, -hip_half_m, ankle_height_m}};
  for (const std::size_t a : {neck, back, hip_left, hip_right})
    for (const std::size_t b : {neck, back, hip_left, hip_right})
      if (a < b) plan.rods.push_back(stiff(plan, a, b));
  plan.rods.push_back(stiff(plan, neck, head));
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    plan.rods.push_back(stiff(plan, hip_left + side, knee_left + side));
    plan.rods.push_back(stiff(plan, knee_left + side, foot_left + side));
    plan.limits.push_back({neck, knee_left + side, 0.42, 2.0});               // The hip bends to 130 degrees
    plan.limits.push_back({back, knee_left + side, 0.40, 2.0});               // and 20 degrees backwards.
    plan.limits.push_back({hip_left + side, foot_left + side, 0.34, 2.0});    // The knee bends to 130 degrees.
    plan.limits.push_back({head, hip_left + side, 0.62, 2.0});                // The neck bends to 60 degrees,
    plan.limits.push_back({hip_right - side, knee_left + side, 0.36, 0.56});  // a leg to 45 degrees aside.
  }
  plan.limits.push_back({head, back, 0.66, 2.0});
  plan.limits.push_back({knee_left, knee_right, 0.13, 0.80});
  plan.limits.push_back({foot_left, foot_right, 0.13, 1.30});
  plan.balls = {{head, head, 0.0, 0.11}, {neck, neck, 0.0, 0.13}};
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t hip = hip_left + side, knee = knee_left + side, foot = foot_left + side;
    for (const double t : {0.33, 0.67}) plan.balls.push_back({neck, hip, t, 0.13});
    for (const double t : {0.0, 0.33, 0.67}) plan.balls.push_back({hip, knee, t, 0.12 - 0.05 * t});
    for (const double t : {0.0, 0.5}) plan.balls.push_back({knee, foot, t, 0.065});
    plan.balls.push_back({foot, foot, 0.0, ankle_height_m});
  }
  // Searle's figure for clothed bodies on asphalt, which flight and tumbling were fitted with.
  plan.ground_friction = 0.66;
  // Hip and thigh have four balls: 2.4 kN at the touch, 5 kN (what EEVC's upper legform may find) at 8 cm. Harder edges
  // hold the hips before the bonnet, and the head comes down too near.
  plan.most_force_n = 600.0;
  return plan;
}

Plan machine_plan(double wheelbase_m, double radius_m, double bars_x_m, double bars_z_m, double bar_half_m,
                  double low_half_m, double friction) {
  Plan plan;
  plan.mass_share = {0.20, 0.18, 0.16, 0.08, 0.08, 0.15, 0.15};
  plan.stands_at_m = {{0, 0, radius_m},
                      {wheelbase_m, 0, radius_m},
                      {0.22, 0, 0.88},
                      {bars_x_m, bar_half_m, bars_z_m},
                      {bars_x_m, -bar_half_m, bars_z_m},
                      {0.44, low_half_m, radius_m + 0.01},
                      {0.44, -low_half_m, radius_m + 0.01}};
  for (std::size_t a = 0; a < plan.stands_at_m.size(); ++a)
    for (std::size_t b = a + 1; b < plan.stands_at_m.size(); ++b) plan.rods.push_back(stiff(plan, a, b));
  plan.balls = {{rear_hub, rear_hub, 0.0, radius_m},
                {front_hub, front_hub, 0.0, radius_m},
                {saddle, saddle, 0.0, 0.07},
                {bar_left, bar_left, 0.0, 0.05},
                {bar_right, bar_right, 0.0, 0.05},
                {bracket_left, bracket_left, 0.0, 0.08},
                {bracket_right, bracket_right, 0.0, 0.08},
                {saddle, front_hub, 0.5, 0.08}};
  plan.ground_friction = friction;
  return plan;
}

RigidTransform frame_of(const JointedBody& body, double ahead_s) {
  const auto at = [&](std::size_t i) { return body.masses[i].position_m + ahead_s * body.masses[i].velocity_mps; };
  Vec3 left, up, origin, fixed;
  if (body.kind == BodyKind::person) {
    const Vec3 hips = 0.5 * (at(hip_left) + at(hip_right));
    up = glm::normalize(at(neck) - hips);
    left = at(hip_left) - at(hip_right);
    origin = hips, fixed = Vec3(hips_x_m, 0.0, hip_height_m);
  } else {
    const Plan& plan = plan_of(body.kind);
    left = at(bar_left) - at(bar_right);
    const Vec3 forward = glm::normalize(at(front_hub) - at(rear_hub));
    up = glm::normalize(glm::cross(forward, left));
    left = glm::cross(up, forward);
    origin = at(rear_hub), fixed = plan.stands_at_m[rear_hub];
  }
  left = glm::normalize(left - glm::dot(left, up) * up);
  const glm::dmat3 axes(glm::cross(left, up), left, up);
  RigidTransform frame;
  frame.orientation = glm::normalize(glm::quat_cast(axes));
  frame.position_m = origin - frame.orientation * fixed;
  return frame;
}

}  // namespace

const Plan& plan_of(BodyKind kind) {
  static const Plan person = person_plan();
  static const Plan bicycle = machine_plan(1.05, 0.34, 0.86, 1.00, 0.28, 0.12, 0.50);
  static const Plan motorcycle = machine_plan(1.50, 0.31, 1.12, 1.02, 0.34, 0.20, 0.40);
  return kind == BodyKind::person ? person : kind == BodyKind::bicycle ? bicycle : motorcycle;
}

JointedBody standing_body(BodyKind kind, double mass_kg, const RigidTransform& world_from_body,
                          const Vec3& velocity_mps) {
  JointedBody body;
  body.kind = kind;
  body.mass_kg = mass_kg;
  const Plan& plan = plan_of(kind);
  for (std::size_t i = 0; i < plan.stands_at_m.size(); ++i)
    body.masses[i] = {world_from_body * plan.stands_at_m[i], velocity_mps};
  return body;
}

JointedBody riding_body(BodyKind machine, double mass_kg, const RigidTransform& world_from_machine,
                        const Vec3& velocity_mps) {
  JointedBody body = standing_body(BodyKind::person, mass_kg, world_from_machine, velocity_mps);
  const bool on_bicycle = machine == BodyKind::bicycle;
  const Vec3 hips = on_bicycle ? Vec3(0.22, 0.0, 0.95) : Vec3(0.30, 0.0, 0.88);
  // The trunk leans forward by 0.55 of its length.
  const double lean = 0.55, upright = std::sqrt(1.0 - lean * lean);
  const Plan& plan = plan_of(BodyKind::person);
  const Vec3 stood(hips_x_m, 0.0, hip_height_m);
  for (const std::size_t i :
       {std::size_t{head}, std::size_t{neck}, std::size_t{back}, std::size_t{hip_left}, std::size_t{hip_right}}) {
    const Vec3 from = plan.stands_at_m[i] - stood;
    body.masses[i].position_m =
        world_from_machine * (hips + Vec3(upright * from.x + lean * from.z, from.y, upright * from.z - lean * from.x));
  }
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    // Both feet midway round: a thigh ahead, the shin down to the bracket.
    const double below = on_bicycle ? 0.60 : 0.48, ahead = on_bicycle ? 0.20 : 0.16;
    const double reach2 = ahead * ahead + below * below, reach = std::sqrt(reach2);
    const double along = (thigh_m * thigh_m - shin_m * shin_m + reach2) / (2.0 * reach);
    const double across = std::sqrt(std::max(0.0, thigh_m * thigh_m - along * along));
    const double y = side == 0 ? hip_half_m : -hip_half_m;
    body.masses[knee_left + side].position_m =
        world_from_machine *
        (hips + Vec3((along * ahead + across * below) / reach, y, (-along * below + across * ahead) / reach));
    body.masses[foot_left + side].position_m = world_from_machine * (hips + Vec3(ahead, y, -below));
  }
  return body;
}

DrawnPose drawn_pose(const JointedBody& body) {
  constexpr double step_s = 1e-4;
  DrawnPose pose;
  pose.world_from_body = frame_of(body, 0.0);
  const RigidTransform later = frame_of(body, step_s);
  pose.velocity_mps = (later.position_m - pose.world_from_body.position_m) / step_s;
  Quat turn = later.orientation * glm::conjugate(pose.world_from_body.orientation);
  if (turn.w < 0.0) turn = -turn;
  pose.angular_velocity_radps = 2.0 / step_s * Vec3(turn.x, turn.y, turn.z);
  if (body.kind != BodyKind::person) return pose;
  const Quat body_from_world = glm::conjugate(pose.world_from_body.orientation);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const Vec3 foot =
        body_from_world * (body.masses[foot_left + side].position_m - body.masses[hip_left + side].position_m);
    // One who stands is drawn with knees a little bent (leg_to); what is drawn here adds to that.
    const LegAngles leg = leg_to(foot.x, -foot.z), stands = leg_to(0.0, thigh_m + shin_m);
    pose.joints_rad[side] = leg.thigh_rad - stands.thigh_rad;
    pose.joints_rad[2 + side] = leg.knee_rad - stands.knee_rad;
  }
  return pose;
}

double uprightness(const JointedBody& person) {
  const double feet_m = std::min(person.masses[foot_left].position_m.z, person.masses[foot_right].position_m.z);
  const Plan& plan = plan_of(BodyKind::person);
  return (person.masses[head].position_m.z - feet_m) / (plan.stands_at_m[head].z - plan.stands_at_m[foot_left].z);
}

}  // namespace septet::person
