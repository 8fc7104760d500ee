#pragma once
/// The state of a running scenario: its entities' places and its storyboard's progress. Plain data.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scenario/model/scenario.hpp"
#include "engine/world/lamps.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::scenario {

/// A quantity on its way from one value to another (transition.hpp).
struct Transition {
  DynamicsShape shape = DynamicsShape::step;
  bool over_distance = false;  ///< `extent` is metres travelled, else seconds.
  double extent = 0.0;
  double progress = 0.0;  ///< In the unit of `extent`.
  double from = 0.0, to = 0.0;
};

struct SpeedProfile;
struct Meeting;

/// Target place of an entity relative to another.
struct DistanceControl {
  KeepDistanceAction what;
  double side = 1.0;  ///< Target side of the other one: ahead or to the left (1), or not (−1).
};

/// Control of an entity's speed: a profile, a distance, a meeting or else the transition; `action` is the requesting
/// storyboard element (no_element: Init).
struct SpeedControl {
  bool active = false;
  ElementIndex action = no_element;
  Transition transition;
  EntityIndex follow = no_entity;  ///< Continuous: the speed is follow_factor · v + follow_delta_mps of this entity.
  double follow_factor = 1.0, follow_delta_mps = 0.0;
  std::shared_ptr<const SpeedProfile> profile;  ///< Added to the speed of `follow`, if there is one.
  double profile_s = 0.0;
  std::shared_ptr<const DistanceControl> distance;
  std::shared_ptr<const Meeting> meeting;
};

/// Control of an entity's lateral motion: its offset from the lane's centre as a transition.
struct LateralControl {
  bool active = false;
  ElementIndex action = no_element;
  Transition transition;     ///< Transition of LanePosition::offset_m, along +t.
  bool lane_change = false;  ///< Indicates while it runs.
  bool to_the_left = false;
  std::shared_ptr<const DistanceControl> distance;  ///< Instead of the transition.
  double left_mps = 0.0, left_mps2 = 0.0;           ///< Speed and acceleration of the entity in that.
  std::optional<double> left_way_m;                 ///< Distance left in the step before.
};

/// An obstacle in an entity's path.
struct InTheWay {
  double gap_m = 0.0;  ///< From bumper to bumper.
  double speed_mps = 0.0;
};

struct Path;

/// Control of an entity's motion along a path instead of its lane.
struct PathControl {
  bool active = false;
  ElementIndex action = no_element;
  std::shared_ptr<const Path> path;
  bool timed = false;      ///< The path's times give its place, else its speed does.
  double clock_s = 0.0;    ///< Now, on the path's clock.
  double station_m = 0.0;  ///< Its station on the path.
};

struct PlannedRoute;

/// The roads of an entity's route (route.hpp).
struct RouteState {
  std::shared_ptr<const std::vector<road::RoadIndex>> roads;
  std::size_t at = 0;  ///< Index of its present or last road.
};

struct EntityState {
  bool active = false;    ///< True with a position.
  bool external = false;  ///< Moved from outside (the driver's car): see place_external.
  bool on_road = false;   ///< `lane` holds; else the entity stands at its given pose.
  road::LanePosition lane;
  bool along_s = true;              ///< It drives towards increasing s.
  double heading_offset_rad = 0.0;  ///< Heading of the entity against its lane's direction, from its given orientation.
  RigidTransform world_from_entity;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  Vec3 velocity_mps{0.0}, acceleration_vector_mps2{0.0}, angular_velocity_radps{0.0};  ///< World.
  std::optional<InTheWay> in_the_way;  ///< Obstacle for which it brakes, whatever its script says (mind_the_way).
  /// A lateral action that has not begun waits while the place beside is taken, likewise.
  bool beside_is_taken = false;
  double held_back_mps = 0.0;  ///< Deficit to its script's speed because of the obstacle, or after it.
  double travelled_m = 0.0;
  double at_road_end_s = 0.0;  ///< Time since it came to the end of its road: it has left.
  double standing_s = 0.0;
  double wheel_angle_rad = 0.0;  ///< Angle of the wheels' rolling, [0, 2π).
  double strides = 0.0;          ///< Of one on foot, made since a heel of the left foot struck, [0, 1).
  Lamps lamps;
  SpeedControl speed_control;
  LateralControl lateral_control;
  PathControl path_control;
  RouteState route;
};

enum class ElementStatus : std::uint8_t { standby, running, complete };
enum class ElementTransition : std::uint8_t { none, start, end, stop, skip };

struct ElementState {
  bool initialised = false;  ///< Its parent has started: the element is in standby or beyond.
  ElementStatus status = ElementStatus::standby;
  ElementTransition last_transition = ElementTransition::none;
  std::uint64_t transition_sequence = 0;  ///< Orders transitions and evaluations within a step.
  std::uint32_t executions = 0;
};

struct ConditionState {
  bool evaluated = false;
  bool last_value = false;
  std::uint64_t sequence = 0;  ///< Sequence number of the last evaluation.
  bool delayed_value = false;
  struct Change {
    double time_s = 0.0;
    bool value = false;
  };
  std::vector<Change> delayed;  ///< Changes of the value that the delay still holds back, in order.
};

struct ScenarioState {
  double time_s = 0.0;
  std::uint64_t sequence = 1;
  std::uint64_t step_sequence = 0;  ///< `sequence` at the start of the current step.
  bool finished = false;            ///< The storyboard's stop trigger has fired.
  Environment environment;
  double friction_scale = 1.0;        ///< RoadCondition's frictionScaleFactor: of every surface.
  std::vector<EntityState> entities;  ///< As Scenario::entities.
  std::vector<std::string> values;    ///< As Scenario::values.
  /// Planned routes, indexed as Scenario::routes; null where a waypoint depends on an entity's place.
  std::vector<std::shared_ptr<const PlannedRoute>> routes;
  std::vector<ElementState> elements;  ///< By ElementIndex.
  std::vector<ConditionState> conditions;
};

}  // namespace septet::scenario
