#pragma once
/// A hull against obstacles beside the road, by the law of all impacts (engine/physics/impact): crush, impulse, and a
/// report for the log. The driver's car has one, and so has every body that a crash has set loose.
///
/// In plan the hull is a rectangle with rounded corners, of the mass and yaw inertia of its bearer. Each run of
/// obstacles (all stretches of one rail, one trunk) is engaged by itself, as a body that stands fast: the deflection of
/// a rail is part of the crush. A flat wall gives a crush of V/ω and a quarter period of 67 ms with ω = 23.5 /s; a trunk
/// or a post meets half the members, and goes deeper by √2. Where the hull was crushed before, it is stiffer from the
/// start.
///
/// A yielding obstacle (a marker post, a bush) gives its impulse at once and is met again only after the car has left
/// it.
///
/// Call with each step of the bearer, right after it.

#include <array>
#include <span>
#include <vector>

#include "engine/physics/impact/engagement.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::vehicle {

/// One obstacle's contact with the hull, from the first touch until half a second after the last. The whole hull
/// counts, also where it is crushed.
struct HullTouch {
  std::uint32_t run = 0;  ///< Run of the obstacle.
  ObstacleKind kind = ObstacleKind::tree;
  // State at the first touch, world frame.
  Vec3 point_m{0.0};
  Vec3 normal{1.0, 0.0, 0.0};  ///< Unit length, level, from the obstacle to the hull.
  Vec3 velocity_mps{0.0};      ///< Velocity of the centre of mass.
  Vec3 angular_velocity_radps{0.0};
  double closing_speed_mps = 0.0;  ///< Along the normal, of the point.

  double mass_kg = 0.0;           ///< Of the hull's bearer.
  impact::Engagement engagement;  ///< Of the hull as the first body.
  double crushed_m = 0.0;         ///< Crush of the hull at that place by earlier touches.
  Vec2 delta_v_mps{0.0};          ///< Change of the velocity by the obstacle during the impact.
  double age_s = 0.0;             ///< Time since the first touch.
  double free_s = 0.0;            ///< Time since the last touch.
  double side = 1.0;              ///< Side of a line on which the hull is.
  bool over = false;              ///< The impact is over: `delta_v_mps` is final.
};

struct HullState {
  /// Deepest crush so far by impacts that began there; the hull in thirds along and across, from right rear to left front.
  std::array<double, 9> crush_m{};
  std::vector<HullTouch> touches;  ///< In the order of their beginnings.
};

struct HullReport {
  std::vector<HullTouch> begun;  ///< Touched in this step for the first time.
  /// Touches whose impact is over, at the latest a quarter of a second after its beginning.
  std::vector<HullTouch> over;
};

/// A hull at an instant, as obstacles meet it.
struct Hull {
  impact::Side side;                 ///< In plan, with its whole outline, and its crush at a wall.
  double low_m = 0.0, high_m = 0.0;  ///< World z: what is lower or higher is no obstacle.
  double middle_z_m = 0.0;           ///< Of the centre of mass.
  Vec3 velocity_mps{0.0};            ///< Of the centre of mass.
  Vec3 angular_velocity_radps{0.0};
};

/// Whose hull it is. Each push is taken at once, so that the next obstacle meets what it has left.
class HullBearer {
 public:
  virtual ~HullBearer() = default;
  virtual Hull hull() const = 0;
  /// Takes over what an obstacle has changed within `dt_s`.
  virtual void take(const impact::Body& before, const impact::Body& after, double dt_s) = 0;
};

/// Radius round the centre of mass that holds the hull.
double hull_reach_m(const VehicleParameters& parameters);

/// What impacts with obstacles will still change of the bearer's motion.
impact::Due due_to_hull(const HullState& hull, const impact::Body& body);

/// Crushes the hull at the obstacles that it has entered, and gives its bearer their impulses. `obstacles`: all that it
/// may reach. `due`: to the bearer by impacts with others. Appends to `report`.
void advance_hull(std::span<const Obstacle> obstacles, double dt_s, const impact::Due& due, HullBearer& bearer,
                  HullState& hull, HullReport& report);

/// The same of the driver's car; `obstacles`: all within hull_reach_m.
void advance_hull(const VehicleParameters& parameters, std::span<const Obstacle> obstacles, double dt_s,
                  const impact::Due& due, VehicleState& state, HullState& hull, HullReport& report);

}  // namespace septet::vehicle
