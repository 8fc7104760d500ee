#include "engine/physics/vehicle/wheel_load.hpp"

#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/published_chassis.hpp"
#include "engine/physics/vehicle/tyre.hpp"
#include "engine/physics/vehicle/wheel_damage.hpp"

namespace septet::vehicle {
namespace {

double squared(double x) { return x * x; }

/// Spin after one step. The brake holds up to its torque and never turns the wheel.
double spin_wheel(double spin_radps, double torque_nm, double brake_nm, double inertia_kgm2, double dt_s,
                  double& brake_used_nm) {
  const double free_radps = spin_radps + dt_s * torque_nm / inertia_kgm2;
  const double most_radps = dt_s * brake_nm / inertia_kgm2;
  const double taken_radps = std::clamp(free_radps, -most_radps, most_radps);
  brake_used_nm = -taken_radps * inertia_kgm2 / dt_s;
  return free_radps - taken_radps;
}

/// Surface that carries a wheel: its ground's plane, or the edge that it presses deepest.
struct Carrier {
  Vec3 normal{0.0};       ///< Unit length, world frame.
  double height_m = 0.0;  ///< Height of the wheel's centre over it.
  double leverage = 1.0;  ///< Change of that height by a motion along the normal.
  bool is_edge = false;
};

/// The wheel is a disc: its distance from an edge is measured within its own plane, and the force on it is the gradient
/// of that distance, so that an edge oblique to the wheel pushes it aside and gives no energy.
std::optional<Carrier> carried_by(const StepEdge& edge, const Vec3& plane_normal, const Vec3& centre_m,
                                  const Vec3& forward) {
  constexpr double least_cosine = 0.35;  // A wheel that heads along an edge rubs it with its side.
  const Vec3 to_centre = centre_m - edge.point_m;
  const double up_m = std::max(0.0, glm::dot(to_centre, plane_normal));  // Below the edge stands the step's face.
  const double heading_across = glm::dot(edge.across, forward);
  const double cosine = std::copysign(std::max(std::abs(heading_across), least_cosine), heading_across);
  const double ahead_m = glm::dot(to_centre, edge.across) / cosine;
  const double distance_m = std::hypot(ahead_m, up_m);
  if (!(distance_m > 1e-6)) return std::nullopt;  // A hub on the edge is pushed nowhere.
  const Vec3 gradient = (up_m * plane_normal + ahead_m / cosine * edge.across) / distance_m;
  const double leverage = glm::length(gradient);
  return Carrier{gradient / leverage, distance_m, leverage, true};
}

Carrier carrier_of(const WheelGround& ground, const Vec3& centre_m, const Vec3& forward) {
  Carrier carrier{ground.normal, glm::dot(ground.normal, centre_m - ground.point_m)};
  for (const auto& edge : ground.edges) {
    if (!edge) continue;
    const auto on_edge = carried_by(*edge, ground.normal, centre_m, forward);
    if (on_edge && on_edge->height_m < carrier.height_m) carrier = *on_edge;
  }
  return carrier;
}

/// Where a wheel stands over the plane that carries it.
struct WheelContact {
  Vec3 normal{0.0};
  double height_m = 0.0;      ///< Of the wheel's centre.
  double deflection_m = 0.0;  ///< Of the tyre; negative in the air.
  Vec3 across{0.0};           ///< Along the ground, where the wheel heads; not unit length.
  double across_size = 0.0;
  double leverage = 1.0;  ///< As the carrier's.
  bool on_edge = false;
  bool touching = false;  ///< False in the air, or where the wheel lies on its side or above the car.
};

WheelContact find_contact(const WheelSurroundings& around, int index, const WheelPlace& place) {
  const VehicleParameters& parameters = around.parameters;
  const RigidTransform& world_from_body = around.state.world_from_body;
  const Vec3& axis = place.spin_axis;
  const Vec3 centre_m = world_from_body * place.centre_m;
  const Vec3 forward = world_from_body.orientation * glm::cross(axis, Vec3(0.0, 0.0, 1.0));
  const Carrier met = carrier_of(around.ground, centre_m, forward / glm::length(forward));
  WheelContact contact;
  contact.normal = glm::conjugate(world_from_body.orientation) * met.normal;
  const Vec3 measured_m =
      parameters.as_published ? published_measured_m(parameters, index, place.centre_m) : place.centre_m;
  contact.height_m = met.height_m + glm::dot(contact.normal, measured_m - place.centre_m);
  // From 0.6 of the radius on the rim would be flat; the force stays at its value there.
  const double radius_m = parameters.tyre.radius_m;
  contact.deflection_m = std::min(radius_m - contact.height_m, 0.6 * radius_m);
  contact.across = glm::cross(axis, contact.normal);
  contact.across_size = glm::length(contact.across);
  contact.leverage = met.leverage;
  contact.on_edge = met.is_edge;
  contact.touching =
      contact.deflection_m > 0.0 && contact.normal.z > (met.is_edge ? -0.3 : 0.3) && contact.across_size > 0.3;
  return contact;
}

/// A round wheel's lowest point lies under its centre, however the body pitches; sideways it follows the axle.
Vec3 contact_point_m(const WheelContact& contact, const WheelPlace& place) {
  const Vec3& normal = contact.normal;
  Vec3 point_m = place.centre_m - contact.height_m * normal;
  if (!contact.on_edge) {
    point_m.y = place.contact_left_m;
    point_m.z = place.centre_m.z - contact.height_m * (1.0 - squared(normal.x)) / normal.z;
  }
  return point_m;
}

/// Velocity of the contact's point on the car. Sets how a rigid axle's contact moves with the wheel's travel.
Vec3 patch_velocity_mps(const WheelSurroundings& around, int index, const WheelContact& contact,
                        const WheelState& wheel, WheelLoad& load) {
  const SuspensionParameters& suspension = around.parameters.suspension[axle_of(index)];
  Vec3 path_mps = wheel.travel_rate_mps * Vec3(load.place.contact_slope, 1.0);
  if (suspension.rigid_axle) {
    // Its joint hangs on the axle: the lower the wheel's centre, the deeper the joint lies under the contact, which
    // moves only as the axle leans.
    load.place.contact_slope.y +=
        side_of(index) * (contact.height_m - around.known.centre_z_m[axle_of(index)]) / (0.5 * suspension.track_m);
    const double opposite_rate_mps = around.state.wheels[static_cast<std::size_t>(index ^ 1)].travel_rate_mps;
    path_mps.y = 0.5 * (wheel.travel_rate_mps - opposite_rate_mps) * load.place.contact_slope.y;
  }
  return around.velocity_mps + glm::cross(around.state.angular_velocity_radps, load.contact_m) + path_mps;
}

/// Radial force of the tyre, which never pulls.
double radial_load_n(const TyreParameters& tyre, const WheelGround& ground, const WheelContact& contact, double out_mps,
                     const WheelState& wheel) {
  double load_n =
      contact.leverage * std::max(0.0, radial_force_n(tyre, wheel.damage, contact.deflection_m, ground.yields) -
                                           tyre.vertical_damping_nspm * contact.leverage * out_mps);
  // A wheel whose hub lies under the ground has not been driven there: it is lifted out slowly, not thrown.
  constexpr double most_out_mps = 1.0;
  if (contact.height_m < 0.0) load_n *= std::clamp(1.0 - out_mps / most_out_mps, 0.0, 1.0);
  return load_n;
}

/// Force of a tyre that touches the ground, into wheel and load. Returns the torque of its rolling resistance.
double push_tyre(const WheelSurroundings& around, int index, const WheelContact& met, double effective_radius_m,
                 WheelState& wheel, WheelLoad& load) {
  const VehicleParameters& parameters = around.parameters;
  const TyreParameters& tyre = parameters.tyre;
  const WheelGround& ground = around.ground;
  const Vec3 forward =
      parameters.as_published ? published_heading(wheel.steer_rad, met.normal) : met.across / met.across_size;
  const Vec3 left = glm::cross(met.normal, forward);
  load.contact_m = contact_point_m(met, load.place);
  const Vec3 patch_mps = patch_velocity_mps(around, index, met, wheel, load);
  const double load_n = radial_load_n(tyre, ground, met, glm::dot(patch_mps, met.normal), wheel);
  TyreContact contact;
  contact.load_n = load_n;
  contact.friction = ground.friction * wheel.damage.grip();
  contact.firmness = wheel.damage.firmness();
  contact.rolling_mps = wheel.spin_radps * effective_radius_m;
  contact.forward_mps = glm::dot(patch_mps, forward);
  contact.sliding_mps = {contact.forward_mps - contact.rolling_mps, glm::dot(patch_mps, left)};
  contact.inclination_rad = glm::dot(load.place.spin_axis, met.normal);
  if (parameters.as_published)
    publish_contact(parameters, around.known, index, around.state, around.velocity_mps, load.place.spin_axis,
                    met.normal, met.height_m, contact);
  contact.length_m = std::sqrt(8.0 * tyre.radius_m * met.deflection_m);
  if (!(load_n > 1.0)) return 0.0;
  const TyreForce steady = steady_force(tyre, contact);
  const double most_n = 1.3 * load_n * ground.friction / tyre.reference_friction;
  const Vec2 force_n = relax(steady, most_n, around.dt_s, wheel.deflection_m);
  wheel.force_n = Vec3(force_n, load_n);
  wheel.aligning_nm = -steady.trail_m * force_n.y;
  wheel.slip = steady.slip.x;
  wheel.slip_angle_rad = std::atan(steady.slip.y);
  load.force_n = force_n.x * forward + force_n.y * left + load_n * met.normal;
  load.rolling_n = force_n.x * forward;
  load.rolling_torque_nm = force_n.x * effective_radius_m;
  load.lean_nm = load_n * force_n.y * parameters.suspension[axle_of(index)].contact_by_lateral_force_mpn;
  load.aligning_nm = wheel.aligning_nm * met.normal;
  return ground.rolling_resistance * wheel.damage.rolling_resistance() * load_n * effective_radius_m *
         (tyre.rolling_resistance + tyre.rolling_resistance_s2pm2 * squared(contact.rolling_mps));
}

/// New spin by drive, brake, tyre and rolling resistance; what the shaft has of them goes into the load.
void advance_spin(const WheelSurroundings& around, int index, double rolling_nm, WheelState& wheel, WheelLoad& load) {
  const double drive_nm = around.input.drive_torque_nm[index];
  const double brake_nm = std::max(0.0, around.input.brake_torque_nm[index]);
  double friction_nm = 0.0;
  wheel.spin_radps =
      spin_wheel(wheel.spin_radps, drive_nm - load.rolling_torque_nm, brake_nm + rolling_nm,
                 around.parameters.suspension[axle_of(index)].wheel_inertia_kgm2, around.dt_s, friction_nm);
  load.brake_torque_nm = friction_nm * brake_nm / std::max(brake_nm + rolling_nm, 1e-12);
  load.shaft_torque_nm = drive_nm + load.brake_torque_nm;
  wheel.spin_rad += around.dt_s * wheel.spin_radps;
  constexpr double turn_rad = 6.283185307179586;
  wheel.spin_rad -= turn_rad * std::floor(wheel.spin_rad / turn_rad);
}

}  // namespace

WheelLoad advance_wheel(const WheelSurroundings& around, int index, WheelState& wheel) {
  const TyreParameters& tyre = around.parameters.tyre;
  WheelLoad load;
  wheel.steer_rad = wheel_steer_rad(around.parameters, index, wheel, around.input.steer_rad);
  load.place = place_wheel(around.parameters, around.known, index, wheel, wheel.steer_rad);
  const WheelContact contact = find_contact(around, index, load.place);
  const double effective_radius_m =
      tyre.published ? tyre.radius_m : tyre.radius_m - std::clamp(contact.deflection_m, 0.0, 0.1) / 3.0;
  wheel.force_n = Vec3(0.0);
  wheel.aligning_nm = 0.0;
  wheel.squeeze_m = contact.touching ? contact.deflection_m : 0.0;
  press_wheel(tyre, around.ground.yields ? 0.0 : wheel.squeeze_m, around.dt_s, wheel.damage);
  const double rolling_nm = contact.touching ? push_tyre(around, index, contact, effective_radius_m, wheel, load) : 0.0;
  if (wheel.force_n.z <= 0.0) {
    wheel.deflection_m = Vec2(0.0);
    wheel.slip = wheel.slip_angle_rad = 0.0;
  }
  advance_spin(around, index, rolling_nm, wheel, load);
  return load;
}

}  // namespace septet::vehicle
