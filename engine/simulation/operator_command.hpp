#pragma once
/// An operator's changes of the drive: weather, light, grip, traffic, the storyboard's next event; and the solids that
/// editors stand in the scene (solids.hpp), what they hide of it (standing.hpp), calls to all who listen
/// (engine/world/call.hpp), and errors of people in the traffic (engine/world/people_errors.hpp).
///
/// A command is applied between two ticks, and is input like the driver's: it is logged as its text, with the tick that
/// it came before, and running the drive again applies it there. The text parses to the same command to the last bit:
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
///     clear solid=3
///     gone x_m=412.5 y_m=-81 name="tree/412.5/-81.0"
///     call name=lift node=stimuli/barrier seconds=3 by=lab
///     hazard x_m=120.5 y_m=-3.25 name=ball and child
///     overlook who=1007 whom=NAME
///     errors overlook=6 late_brake=20 telephone=10 red=2
///     to Bahnhofsplatz
///     to nowhere

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/simulation/standing.hpp"
#include "engine/simulation/state.hpp"
#include "engine/world/call.hpp"
#include "engine/world/people_errors.hpp"

namespace septet::simulation {

/// A condition of weather, light or road that may be set while driving.
struct Condition {
  std::string_view name;                       ///< As the environment calls it, unit in the name.
  double least = 0.0, most = 1.0;              ///< Accepted range.
  double Environment::*environment = nullptr;  ///< Null: the scenario's friction scale.
};
std::span<const Condition> conditions();
double value_of(const Condition& condition, const scenario::ScenarioState& state);

struct SetConditions {
  std::vector<std::pair<const Condition*, double>> values;  ///< Each condition once.
  bool operator==(const SetConditions&) const = default;
};
/// Lays out the scenario's traffic anew around the driver's car, with this many vehicles.
struct SetTraffic {
  std::uint32_t vehicles = 0;
  bool operator==(const SetTraffic&) const = default;
};
/// Begins an act or an event of the storyboard now.
struct TriggerElement {
  std::string name;  ///< As in Scenario::element_names.
  bool operator==(const TriggerElement&) const = default;
};
/// Stands a thing that can be hit on the road, or beside it: a part by its name ("traffic-cone"), with the heading of
/// the driver's car.
struct PlacePart {
  std::string part;
  double x_m = 0.0, y_m = 0.0;  ///< World.
  bool operator==(const PlacePart&) const = default;
};
/// Takes away a standing or lying thing on the road, of any origin, or a piece of one.
struct RemovePiece {
  std::uint32_t id = 0;  ///< Id of a piece in lying_pieces() (effects/effects_stage.hpp).
  bool operator==(const RemovePiece&) const = default;
};
/// Hides an entity of the scenario, which is then neither seen nor met, or shows it again where it was.
struct ShowEntity {
  std::string name;
  bool shown = false;
  bool operator==(const ShowEntity&) const = default;
};
/// Makes a part of the driver's car fail, or repairs it: `fault` of fault_names() (car_faults.hpp).
struct SetFault {
  std::size_t fault = 0;
  bool failed = false;
  bool operator==(const SetFault&) const = default;
};
/// Puts the driver's car, as new, standing or rolling, in the middle of the lane nearest to a place, among those along
/// its heading if there is one. Time, traffic and storyboard go on; its faults stay.
struct PutCar {
  double x_m = 0.0, y_m = 0.0;  ///< World, of the middle of its rear axle.
  double heading_rad = 0.0;     ///< Counter-clockwise from x.
  double speed_mps = 0.0;
  bool operator==(const PutCar&) const = default;
};
/// Guides the driver to a place (guidance.hpp), or no more.
struct GuideDriver {
  std::string to;  ///< Empty: no more.
  bool operator==(const GuideDriver&) const = default;
};
/// Sets a hazard of the scenario: the first actor of its act comes into the world in the middle of the lane nearest to a
/// place, and the act begins.
struct SetHazard {
  std::string name;             ///< Of its act.
  double x_m = 0.0, y_m = 0.0;  ///< World.
  bool operator==(const SetHazard&) const = default;
};
using OperatorCommand =
    std::variant<SetConditions, SetTraffic, TriggerElement, PlacePart, RemovePiece, ShowEntity, SetFault, PutCar,
                 StandSolid, ClearSolid, ShowStanding, Call, OverlookWish, PeopleErrorRates, GuideDriver, SetHazard>;

/// Bounds of PutCar: distance from a road, speed, and distance to other participants.
inline constexpr double furthest_put_m = 200.0, fastest_put_mps = 70.0, free_around_put_m = 8.0;

/// Distances from the driver's car at which a thing may be placed: nearer it would stand in the car, further it would
/// be removed at once.
inline constexpr double nearest_place_m = 8.0, furthest_place_m = 500.0;

/// A hazard is set no nearer, so that it does not come out of nothing before the driver's eyes, and no further.
inline constexpr double nearest_hazard_m = 40.0, furthest_hazard_m = 1000.0;

std::string text_of(const OperatorCommand& command);
/// Error: not a command, or a value out of its range.
Expected<OperatorCommand> parse_operator_command(std::string_view text);

/// Call between two ticks. Events are appended. Error: this drive cannot do that, or not now; then nothing has changed.
Expected<void> apply_operator_command(const Model& model, const OperatorCommand& command, State& state,
                                      std::vector<Event>& events);

/// The swarm from which `SetTraffic` takes its mix and its reach: the scenario's first; null where it has none.
const scenario::TrafficSwarmAction* first_swarm(const scenario::Scenario& scenario);

/// An entity that `ShowEntity` may name: moving ones of the scenario, except the driver's car, and whether they are
/// shown.
struct Hideable {
  std::string name;
  bool shown = false;
};
std::vector<Hideable> hideable(const Model& model, const scenario::ScenarioState& state);

/// Names of the hazards that may be set now: acts that have not begun, with a HazardAction in them, whose first actor is
/// not in the world.
std::vector<std::string> settable_hazards(const scenario::Scenario& scenario, const scenario::ScenarioState& state);

/// Elements that may be triggered now: acts and events that have not begun.
std::vector<std::string> triggers(const scenario::Scenario& scenario, const scenario::ScenarioState& state);

}  // namespace septet::simulation
