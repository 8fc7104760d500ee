#pragma once
/// Conditions and triggers (OpenSCENARIO XML 1.3), as plain data. SI units throughout.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scenario/model/position.hpp"

namespace septet::scenario {

/// Index of a storyboard element's state in ScenarioState::elements.
using ElementIndex = std::uint32_t;
inline constexpr ElementIndex no_element = std::numeric_limits<ElementIndex>::max();

/// Index of a parameter's or variable's value in ScenarioState::values.
using ValueIndex = std::uint32_t;

enum class Rule : std::uint8_t { equal, not_equal, less, less_or_equal, greater, greater_or_equal };
enum class Edge : std::uint8_t { none, rising, falling, rising_or_falling };
enum class CoordinateSystem : std::uint8_t { entity, lane, road, world };
enum class DistanceType : std::uint8_t { longitudinal, lateral, euclidean };
enum class Direction : std::uint8_t { total, longitudinal, lateral, vertical };

/// Measure of a distance between two objects.
struct DistanceMeasure {
  CoordinateSystem system = CoordinateSystem::entity;
  DistanceType type = DistanceType::euclidean;
  bool freespace = false;  ///< Between the bounding boxes, else between the reference points.
};

struct Comparison {
  Rule rule = Rule::greater;
  double value = 0.0;
};

// By value.
struct SimulationTimeCondition {
  Comparison comparison;
};
/// Condition on a parameter or variable: Scenario::values.
struct ValueCondition {
  ValueIndex value = 0;
  Rule rule = Rule::equal;
  std::string compared;  ///< As numbers where both are, else as texts (parameter_value.hpp).
};
/// State of a signal by its controller, as the file writes it.
struct TrafficSignalCondition {
  std::string signal, state;
};
/// Phase of a controller.
struct TrafficSignalControllerCondition {
  std::size_t controller = 0;  ///< Index in Scenario::signals.
  std::string phase;
};
/// State of a storyboard element, or its transition in this step.
enum class ElementPhase : std::uint8_t {
  standby_state,
  running_state,
  complete_state,
  start_transition,
  end_transition,
  stop_transition,
  skip_transition
};
struct StoryboardElementStateCondition {
  ElementIndex element = no_element;
  ElementPhase phase = ElementPhase::complete_state;
};

// By entity: of each triggering entity.
struct EndOfRoadCondition {
  double duration_s = 0.0;
};
/// True while its box meets that of an entity, or of any of a kind.
struct CollisionCondition {
  EntityIndex entity = no_entity;
  std::optional<EntityKind> kind;
};
struct StandStillCondition {
  double duration_s = 0.0;
};
struct TraveledDistanceCondition {
  double distance_m = 0.0;
};
struct ReachPositionCondition {
  Position position;
  double tolerance_m = 0.0;
};
struct SpeedCondition {
  Comparison comparison;
  Direction direction = Direction::total;
};
struct AccelerationCondition {
  Comparison comparison;
  Direction direction = Direction::total;
};
struct RelativeSpeedCondition {
  EntityIndex entity = no_entity;
  Comparison comparison;  ///< Speed of the triggering entity minus that of the other.
};
struct DistanceCondition {
  Position position;
  DistanceMeasure measure;
  Comparison comparison;
};
struct RelativeDistanceCondition {
  EntityIndex entity = no_entity;
  DistanceMeasure measure;
  Comparison comparison;
};
struct TimeHeadwayCondition {
  EntityIndex entity = no_entity;
  DistanceMeasure measure;
  Comparison comparison;
};
struct TimeToCollisionCondition {
  EntityIndex entity = no_entity;  ///< no_entity: `position`.
  Position position;
  DistanceMeasure measure;
  Comparison comparison;
};

/// Lanes to the left of the triggering entity's own as it drives, both ends included.
struct RelativeLaneRange {
  int from = 0, to = 0;
};
/// True without another entity within these distances in these lanes (empty: in all).
struct RelativeClearanceCondition {
  std::vector<RelativeLaneRange> lanes;
  std::vector<EntityIndex> entities;  ///< Empty: all others.
  double forward_m = 0.0, backward_m = 0.0;
  bool freespace = true;
  bool opposite_lanes = false;
};

/// Empty: not supported yet, reported when the file was read; never true.
using ConditionVariant =
    std::variant<std::monostate, SimulationTimeCondition, ValueCondition, StoryboardElementStateCondition,
                 EndOfRoadCondition, CollisionCondition, StandStillCondition, TraveledDistanceCondition,
                 ReachPositionCondition, SpeedCondition, AccelerationCondition, RelativeSpeedCondition,
                 DistanceCondition, RelativeDistanceCondition, TimeHeadwayCondition, TimeToCollisionCondition,
                 RelativeClearanceCondition, TrafficSignalCondition, TrafficSignalControllerCondition>;

struct Condition {
  std::string name;
  double delay_s = 0.0;
  Edge edge = Edge::none;
  std::vector<EntityIndex> triggering_entities;
  bool all_entities = false;  ///< Every triggering entity must fulfil it, else any.
  ConditionVariant test;
  std::uint32_t state = 0;  ///< Index in ScenarioState::conditions.
};

struct ConditionGroup {
  std::vector<Condition> conditions;  ///< All must hold.
};

/// True when any group holds. A trigger without a group is never true, except that a missing or
/// empty start trigger of an act or event means "at once".
struct Trigger {
  std::vector<ConditionGroup> groups;
};

}  // namespace septet::scenario
