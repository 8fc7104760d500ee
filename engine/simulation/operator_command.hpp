#pragma once
/// What somebody beside the drive, an operator, changes of it: weather, light, grip, traffic, the storyboard's next event.
///
/// A command is applied between two ticks, and is input like the driver's: it is logged as its text, with the tick that it came before, and
/// running the drive again applies it there. The text comes back as the same command to the last bit:
///
///     conditions rain_mm_per_h=20 road_wetness=0.6
///     traffic vehicles=120
///     trigger element=Story::Act::Group::Maneuver::Event
///     place x_m=120.5 y_m=-3.25 part=traffic-cone
///     remove thing=3
///     hide entity=NAME
///     show entity=NAME
///     fault what=tyre_front_left
///     repair what=tyre_front_left
///     put x_m=120.5 y_m=-3.25 heading_rad=0.5 speed_mps=13

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// A condition of weather, light or road that may be set while driving.
struct Condition {
  std::string_view name;                       ///< As the environment calls it, unit in the name.
  double least = 0.0, most = 1.0;              ///< What may be asked for.
  double Environment::*environment = nullptr;  ///< Null: the scenario's friction scale.
};
std::span<const Condition> conditions();
double value_of(const Condition& condition, const scenario::ScenarioState& state);

struct SetConditions {
  std::vector<std::pair<const Condition*, double>> values;  ///< Each condition once.
  bool operator==(const SetConditions&) const = default;
};
/// The scenario's traffic is laid out anew around the driver's car, with this many vehicles.
struct SetTraffic {
  std::uint32_t vehicles = 0;
  bool operator==(const SetTraffic&) const = default;
};
/// An act or an event of the storyboard begins now.
struct TriggerElement {
  std::string name;  ///< As Scenario::element_names has it.
  bool operator==(const TriggerElement&) const = default;
};
/// A thing that can be hit stands on the road, or beside it, from now on: a part by its name ("traffic-cone"), as the driver's car faces.
struct PlacePart {
  std::string part;
  double x_m = 0.0, y_m = 0.0;  ///< World.
  bool operator==(const PlacePart&) const = default;
};
/// A thing that stands or lies on the road, placed by whomever, or a piece of one, is taken away.
struct RemovePiece {
  std::uint32_t id = 0;  ///< Of lying_pieces() (effects/effects_stage.hpp).
  bool operator==(const RemovePiece&) const = default;
};
/// Somebody of the scenario is not there any more, seen and met by nobody, or is there again where he was.
struct ShowEntity {
  std::string name;
  bool shown = false;
  bool operator==(const ShowEntity&) const = default;
};
/// Something of the driver's car fails, or is whole again: `fault` of fault_names() (car_faults.hpp).
struct SetFault {
  std::size_t fault = 0;
  bool failed = false;
  bool operator==(const SetFault&) const = default;
};
/// The driver's car, as new, stands or rolls in the middle of the lane that is nearest to a place, among those that run as it heads if there
/// is one. Time, traffic and storyboard go on; its faults stay.
struct PutCar {
  double x_m = 0.0, y_m = 0.0;  ///< World, of the middle of its rear axle.
  double heading_rad = 0.0;     ///< From x to y.
  double speed_mps = 0.0;
  bool operator==(const PutCar&) const = default;
};
using OperatorCommand =
    std::variant<SetConditions, SetTraffic, TriggerElement, PlacePart, RemovePiece, ShowEntity, SetFault, PutCar>;

/// How far from a road the car may be put, the fastest that it may roll, and how far whoever is there has to be.
inline constexpr double furthest_put_m = 200.0, fastest_put_mps = 70.0, free_around_put_m = 8.0;

/// How far from the driver's car a thing may be placed: nearer it would stand in the car, further it would be gone at once.
inline constexpr double nearest_place_m = 8.0, furthest_place_m = 500.0;

std::string text_of(const OperatorCommand& command);
/// Error: it is no command, or asks for a value out of its range.
Expected<OperatorCommand> parse_operator_command(std::string_view text);

/// Between two ticks. Events are appended. Error: this drive cannot do that, or not now; then nothing has changed.
Expected<void> apply_operator_command(const Model& model, const OperatorCommand& command, State& state,
                                      std::vector<Event>& events);

/// The swarm that `SetTraffic` takes its mix and its reach from: the scenario's first; null where it has none.
const scenario::TrafficSwarmAction* first_swarm(const scenario::Scenario& scenario);

/// Whom `ShowEntity` may name: those of the scenario who move, the driver's car not among them, and whether they are there.
struct Hideable {
  std::string name;
  bool shown = false;
};
std::vector<Hideable> hideable(const Model& model, const scenario::ScenarioState& state);

/// What may be triggered now: acts and events that have not begun.
std::vector<std::string> triggers(const scenario::Scenario& scenario, const scenario::ScenarioState& state);

}  // namespace septet::simulation
