#pragma once
/// The car's hull against obstacles beside the road: forces, crush, and a report for the log.
///
/// In plan the hull is a rectangle. Where an obstacle enters it, the hull crushes like a spring that hardly returns
/// (McHenry's SMAC, 1973; Huang 2002, Vehicle Crash Mechanics, ch. 4): the force grows with the depth, 0.5 m ω² at each
/// corner or trunk, so that a flat wall, met by two corners, gives ω = 23.5 /s, a crush of V/ω and a quarter period of
/// 67 ms; past the crumple zone it grows faster. In unloading only a few centimetres spring back (restitution 0.2 at 14
/// m/s, 0.5 at 1 m/s: of the order that tests of bumpers and barriers give). Along the surface Coulomb's friction acts.
/// The forces act at the height of the centre of mass, and the obstacle does not move: the deflection of a rail is part
/// of the crush.
///
/// A yielding obstacle (a marker post, a bush) takes its momentum once and is met again only after the car has left it.
///
/// Call with each step of the vehicle, right after it: at 1 ms a car at 60 m/s enters an obstacle by 6 cm.

#include <array>
#include <span>
#include <vector>

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::vehicle {

/// One obstacle's contact with the hull, from the first touch until half a second after the last.
struct HullTouch {
  std::uint32_t run = 0;  ///< Run of the obstacle.
  ObstacleKind kind = ObstacleKind::tree;
  // State at the first touch, world frame.
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};  ///< Unit length, level, from the obstacle to the car.
  Vec3 velocity_mps{0.0};      ///< Velocity of the car's centre of mass.
  Vec3 angular_velocity_radps{0.0};
  double closing_speed_mps = 0.0;  ///< Along the normal, of the point.

  Vec2 delta_v_mps{0.0};  ///< Change of the car's velocity by the obstacle during the impact.
  double age_s = 0.0;     ///< Time since the first touch.
  double free_s = 0.0;    ///< Time since the last touch.
  double depth_m = 0.0;   ///< Depth in the last step.
  double side = 1.0;      ///< Side of a line on which the car is.
  Vec2 face{0.0};         ///< Outward normal of the hull's side through which a trunk came: body frame.
  bool over = false;      ///< The impact is over: `delta_v_mps` is final.
};

struct HullState {
  /// Deepest crush so far; the hull in thirds along and across, from right rear to left front.
  std::array<double, 9> crush_m{};
  std::vector<HullTouch> touches;  ///< In the order of their beginnings.
};

struct HullReport {
  std::vector<HullTouch> begun;  ///< Touched in this step for the first time.
  /// Touches whose impact is over, at the latest a quarter of a second after its beginning.
  std::vector<HullTouch> over;
};

/// Radius round the centre of mass that holds the hull.
double hull_reach_m(const VehicleParameters& parameters);

/// Pushes the car off the obstacles that it has entered. `obstacles`: all within hull_reach_m. Appends to `report`.
void advance_hull(const VehicleParameters& parameters, std::span<const Obstacle> obstacles, double dt_s,
                  VehicleState& state, HullState& hull, HullReport& report);

}  // namespace septet::vehicle
