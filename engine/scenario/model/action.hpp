#pragma once
/// Actions of the storyboard and of Init (OpenSCENARIO XML 1.3), as plain data. SI units throughout.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scenario/model/condition.hpp"
#include "engine/scenario/model/position.hpp"
#include "engine/scenario/model/trajectory.hpp"
#include "engine/world/call.hpp"
#include "engine/world/lamps.hpp"
#include "engine/world/people.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::scenario {

enum class DynamicsShape : std::uint8_t { step, linear, sinusoidal, cubic };
enum class DynamicsDimension : std::uint8_t { time, distance, rate };

/// Transition of a quantity from one value to another: in a time (s), over a distance (m), or at a rate (units/s; for
/// curved shapes the greatest rate). A rate of 0 keeps the value: it ends at once where that is the target already,
/// else never.
struct TransitionDynamics {
  DynamicsShape shape = DynamicsShape::step;
  DynamicsDimension dimension = DynamicsDimension::time;
  double value = 0.0;
};

struct SpeedAction {
  TransitionDynamics dynamics;
  EntityIndex reference = no_entity;  ///< no_entity: value is the speed.
  double value = 0.0;                 ///< m/s; added to the reference's speed, or multiplied with it if `factor`.
  bool factor = false;
  bool continuous = false;  ///< Follows the reference's speed without end.
};

/// Bounds of an action on its entity; infinite where the file gives no bound.
struct DynamicConstraints {
  double max_speed_mps = std::numeric_limits<double>::infinity();
  double max_acceleration_mps2 = max_speed_mps, max_deceleration_mps2 = max_speed_mps;
  /// Bounds on the growth of the two.
  double max_acceleration_rate_mps3 = max_speed_mps, max_deceleration_rate_mps3 = max_speed_mps;
};

/// Speeds to be reached in sequence (speed_profile.hpp).
struct SpeedProfileAction {
  struct Entry {
    std::optional<double> time_s;  ///< Time after the entry before; absent: as soon as the bounds allow.
    double speed_mps = 0.0;
  };
  std::vector<Entry> entries;
  EntityIndex reference = no_entity;  ///< Speeds are added to that of this entity.
  bool smooth = false;                ///< followingMode "follow".
  std::optional<DynamicConstraints> limits;
};

/// LongitudinalDistanceAction and LateralDistanceAction (keep_distance.hpp).
struct KeepDistanceAction {
  bool lateral = false;
  EntityIndex reference = no_entity;
  double distance_m = 0.0;
  std::optional<double> time_gap_s;  ///< Instead of the distance: at the speed of the one behind.
  /// Target side of the reference: 1 ahead or to the left of the actor, −1 behind or to the right; absent: its side at
  /// the start.
  std::optional<double> reference_side;
  CoordinateSystem system = CoordinateSystem::entity;
  bool freespace = false;
  bool continuous = false;                   ///< Without end, else until the distance is reached.
  std::optional<DynamicConstraints> limits;  ///< Absent: at once and rigidly.
};

/// Two entities reach their targets at the same time (synchronize.hpp).
struct SynchronizeAction {
  EntityIndex master = no_entity;
  Position target, master_target;
  double tolerance_m = 0.0, master_tolerance_m = 0.0;
  enum class FinalSpeed : std::uint8_t { any, absolute, master_plus, master_times };
  FinalSpeed final_speed = FinalSpeed::any;
  double final_value = 0.0;  ///< m/s, or the factor.
  /// Driven at the final speed already for this distance, or time, before the target.
  double steady_m = 0.0, steady_s = 0.0;
};

struct LaneChangeAction {
  TransitionDynamics dynamics;
  EntityIndex reference = no_entity;  ///< no_entity: `lane` is the lane's id.
  int lane = 0;                       ///< With a reference: lanes to the left of its lane, as it drives.
  double target_offset_m = 0.0;       ///< From the centre of the target lane, positive to the left as the actor drives.
};

struct LaneOffsetAction {
  DynamicsShape shape = DynamicsShape::step;
  std::optional<double> max_lateral_acceleration_mps2;
  EntityIndex reference = no_entity;  ///< no_entity: `offset_m` is from the lane's centre.
  double offset_m = 0.0;              ///< Positive to the left as the actor drives.
  bool continuous = false;            ///< Keeps the offset without end, once reached.
};

struct TeleportAction {
  Position position;
};

/// EntityAction: an entity comes into the world, standing, or leaves it. One that is there is moved by neither the
/// first, nor one that has crashed or is driven by a person by either.
struct AddEntityAction {
  EntityIndex entity = no_entity;
  Position position;
};
struct DeleteEntityAction {
  EntityIndex entity = no_entity;
};

/// Replaces the entity's route at junctions from now on.
struct AssignRouteAction {
  std::shared_ptr<const Route> route;
};
/// Replaces it by the route to a single place.
struct AcquirePositionAction {
  Position position;
};

/// Fields that the file does not give stay as they are.
struct EnvironmentAction {
  std::string name;
  std::optional<double> sun_azimuth_rad, sun_elevation_rad, sun_illuminance_lux;
  std::optional<double> visibility_m, cloud_cover, rain_mm_per_h, snow_mm_per_h, road_wetness, friction_scale,
      snow_cover;
  std::optional<double> frost;  ///< Frost on the driver's windscreen as the drive begins, 0 to 1 of a frosty morning's.
  std::optional<double> temperature_k, wind_speed_mps, wind_direction_rad;
};

enum class LightMode : std::uint8_t { off, on, flashing };

/// LightStateAction. `lamps` are those of the standard's light type; the indicators flash by themselves.
struct LightStateAction {
  Lamps lamps;
  LightMode mode = LightMode::off;
};

/// UserDefinedAction with type "septet:siren" and content "ENTITY on" or "ENTITY off": the standard
/// knows lights, but no siren.
struct SirenAction {
  EntityIndex entity = no_entity;
  bool on = false;
};

/// UserDefinedActions for effects without an action in the standard. Type "septet:spill", content "ENTITY PART [X Y
/// SLIDE [SIDE]]": a breakable part (debris/breakable_part.hpp: "ice-slab", "traffic-cone", …) appears on the entity's
/// roof at (X, Y) of its frame and slides backwards with SLIDE m/s, and to the left with SIDE m/s if there is a fifth
/// number; an ice slab lies there from the start of the drive. Type "septet:black-ice", content "ROAD LANE S LENGTH
/// MM" or "ENTITY LENGTH MM": that stretch of a lane, or of the lane in which an entity stands, from it on ahead, is under ice
/// of MM thickness. Type "septet:ignite" or "septet:extinguish", content
/// "ENTITY": it begins or ceases to burn.
struct EffectAction {
  enum class Kind : std::uint8_t { spill, ignite, extinguish, freeze };
  Kind kind = Kind::spill;
  EntityIndex entity = no_entity;
  std::string part;
  double x_m = 0.0, y_m = 0.0, slide_mps = 0.0, side_mps = 0.0;
  std::string road;  ///< Id in the file of the road to be frozen.
  int lane = 0;
  double s_m = 0.0, length_m = 0.0, thickness_m = 0.0;
};

/// TrafficSwarmAction: keep `vehicle_count` vehicles around the central entity, within the ellipse
/// and outside the circle.
struct TrafficSwarmAction {
  std::string name;
  EntityIndex central = no_entity;
  double inner_radius_m = 0.0;
  double semi_major_axis_m = 0.0;  ///< Along the central entity's x axis.
  double semi_minor_axis_m = 0.0;
  double offset_m = 0.0;  ///< Offset of the ellipse's centre along the central entity's x axis.
  std::uint32_t vehicle_count = 0;
  double lowest_initial_speed_mps = 0.0,
         highest_initial_speed_mps = 0.0;  ///< Both 0: the traffic's own drivers choose.
  double same_direction_weight = 1.0, opposite_direction_weight = 1.0;
  struct CategoryWeight {
    std::string category;
    double weight = 0.0;
  };
  std::vector<CategoryWeight> categories;
};

/// A parameter or variable is set, added to or multiplied. Parts of the file that use it were read before: only
/// conditions see it.
struct ValueAction {
  enum class Kind : std::uint8_t { set, add, multiply };
  std::uint32_t value = 0;  ///< Index in ScenarioState::values.
  Kind kind = Kind::set;
  std::string text;     ///< New value.
  double number = 0.0;  ///< Addend or factor.
};

struct TrafficStopAction {
  std::string name;
};

/// UserDefinedAction with type "septet:overlook" and an OverlookWish as content: somebody of the traffic overlooks an
/// entity for one encounter.
struct OverlookAction {
  std::optional<ParticipantId> who;  ///< Empty: the next one who would have to give way.
  EntityIndex whom = no_entity;      ///< no_entity: the driver's car.
};

/// UserDefinedAction with type "septet:hazard" and the hazard's name as content: from now on the actors of its group, or
/// the surroundings where there are no actors, endanger the driver, who is to react (docs/hazards.md).
struct HazardAction {
  std::string name;
};

/// PeopleErrorRates (engine/world/people_errors.hpp): a UserDefinedAction with type "septet:errors" and their text as
/// content. They hold from then on, also for later swarms.
///
/// PeopleWish (engine/world/people.hpp): a UserDefinedAction with type "septet:people" and its text as content: people
/// walk around the driver's car from then on, in the place of those before.
///
/// Call (engine/world/call.hpp): a UserDefinedAction with type "septet:call" and the call's text as content, without
/// its author.
///
/// Empty: the file used an action that is not supported yet, which was reported when it was read. It ends at once.
using ActionVariant =
    std::variant<std::monostate, SpeedAction, SpeedProfileAction, KeepDistanceAction, SynchronizeAction,
                 LaneChangeAction, LaneOffsetAction, TeleportAction, FollowTrajectoryAction, AssignRouteAction,
                 AcquirePositionAction, EnvironmentAction, LightStateAction, SirenAction, EffectAction, ValueAction,
                 TrafficSwarmAction, TrafficStopAction, Call, OverlookAction, PeopleErrorRates, PeopleWish,
                 AddEntityAction, DeleteEntityAction, HazardAction>;

}  // namespace septet::scenario
