#pragma once
/// Readers of the elements of a scenario, and their shared data while one scenario is read. Used by the scenario reader
/// only.

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/read/scenario_xml.hpp"

namespace septet::scenario {

/// Bounds on a scenario's sizes.
constexpr int most_lanes = 1000;
constexpr double most_mps = 1000.0;

struct Reading {
  const ScenarioFiles& files;
  Scenario scenario;
  std::unordered_map<std::string, EntityIndex> entities;                 ///< By name.
  std::map<std::string, ValueIndex, std::less<>> parameters, variables;  ///< By name.
  std::vector<std::shared_ptr<XmlFile>> xml_files;                       ///< The scenario first, then catalogs.
  std::vector<std::pair<std::string, std::string>> catalog_locations;    ///< Element name, folder.
  /// Catalogs by name: their <Catalog> elements. Filled on the first reference to a catalog.
  std::map<std::string, Element> catalogs;
  bool catalogs_loaded = false;
  /// The file is checked, not driven: it may be a catalog or a distribution, or name no road.
  bool checking = false;
  /// A catalog is checked: its entries' names are declared elsewhere.
  bool names_are_elsewhere = false;
  std::vector<Element> used_entries;   ///< Entries of catalogs that were referred to.
  std::vector<Element> init_elements;  ///< Element of each action in Scenario::init.
  /// Every position of the file, for checks once the road is known.
  std::vector<std::pair<Element, Position>> positions;
  ElementIndex next_element = 1;           ///< Index of the storyboard element to be read next.
  std::vector<std::string> element_types;  ///< Type of each storyboard element, in the words of the standard.
};

/// The parameters of `element`'s <ParameterDeclarations> over those of its surroundings. `assigned`
/// values win; one of the wrong type or against its constraints is an error.
Element with_declared_parameters(const Element& element, const Parameters& assigned = {});
/// Parameters of the root, with values from outside the file, each of which must be declared.
Element with_outside_parameters(const Element& root, const std::vector<ParameterValue>& values);

/// Checks every entry of a catalog.
void check_catalog(Reading& reading, const Element& catalog);
/// Checks a ParameterValueDistribution.
void check_distribution(Reading& reading, const Element& distribution);

/// <CatalogReference> inside `parent` resolved to the catalog's entry of one of these kinds of
/// element, with its parameters; empty if there is none or it cannot be found (an error).
Element resolve_catalog_reference(Reading& reading, const Element& parent,
                                  std::initializer_list<std::string_view> kinds);

/// <TrafficSignals> of the road network.
void read_signals(Reading& reading, const Element& signals);
void read_entities(Reading& reading, const Element& entities);
/// A vehicle, pedestrian or misc object, from the scenario or a catalog.
void read_object(const Element& object, Entity& entity);
/// An entity by name; an unknown one is an error and no_entity.
EntityIndex read_entity_reference(Reading& reading, const Element& element, const char* attribute = "entityRef");
BoundingBox read_bounding_box(const Element& parent);

/// The position inside `parent`, an element of the standard's type Position.
Position read_position(Reading& reading, const Element& parent);
/// The <Orientation> of a position: without a type it is relative in 1.3 and absolute before.
Orientation read_orientation(const Reading& reading, const Element& position);
RoutePosition read_route_position(Reading& reading, const Element& position);
Route read_route(Reading& reading, const Element& route);
/// The route inside `parent`, its own or one of a catalog.
std::shared_ptr<const Route> read_route_in(Reading& reading, const Element& parent);
/// The position that stands in the element itself.
Position read_position_in(Reading& reading, const Element& position);

/// Opens the scenario's road and reports places that are not on it.
void check_on_road(Reading& reading, const Element& logic_file);

/// Numbers the root's parameters and reads its <VariableDeclarations>.
void read_values(Reading& reading, const Element& root);
/// The named parameter (`parameterRef`) or variable (`variableRef`); an unknown one is an error and 0.
ValueIndex read_value_reference(Reading& reading, const Element& element, const char* attribute);

/// The attribute `rule`.
Rule read_rule(const Element& element);
TransitionDynamics read_dynamics(const Element& element);
Trajectory read_trajectory(Reading& reading, const Element& trajectory);
ActionVariant read_follow_trajectory(Reading& reading, const Element& action);
ActionVariant read_longitudinal_distance(Reading& reading, const Element& action);
ActionVariant read_lateral_distance(Reading& reading, const Element& action);
ActionVariant read_speed_profile(Reading& reading, const Element& action);
ActionVariant read_synchronize(Reading& reading, const Element& action);
ActionVariant read_private_action(Reading& reading, const Element& action);
ActionVariant read_global_action(Reading& reading, const Element& action);
ActionVariant read_user_defined_action(Reading& reading, const Element& action);
/// The rules of a game; a mistake is an error of `command`.
void read_game(Reading& reading, const Element& command);
EnvironmentAction read_environment_action(Reading& reading, const Element& action);
EnvironmentAction read_environment(const Element& environment);
TrafficSwarmAction read_traffic_swarm(Reading& reading, const Element& action);

Trigger read_trigger(Reading& reading, const Element& trigger);
void read_storyboard(Reading& reading, const Element& storyboard);
/// Checks a maneuver of a catalog.
void check_maneuver(Reading& reading, const Element& maneuver);

/// The storyboard element of this name, or "path::name"; zero or several matches are an error or a warning.
ElementIndex read_element_reference(Reading& reading, const Element& condition);

}  // namespace septet::scenario
