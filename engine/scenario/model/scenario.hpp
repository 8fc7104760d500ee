#pragma once
/// A scenario as plain data: the content of an OpenSCENARIO XML 1.3 file, checked, with names turned into indices.
///
/// Made by read_scenario (scenario_reader.hpp), immutable afterwards. It is run by storyboard_runtime.hpp.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scenario/model/action.hpp"
#include "engine/scenario/model/condition.hpp"
#include "engine/scenario/model/entity.hpp"
#include "engine/scenario/model/game_settings.hpp"
#include "engine/scenario/model/signal_plan.hpp"

namespace septet::scenario {

struct FileHeader {
  int revision_major = 1, revision_minor = 0;
  std::string description, author, date;
};

enum class EventPriority : std::uint8_t { overwrite, skip, parallel };

struct Action {
  std::string name;
  ElementIndex element = no_element;
  ActionVariant what;
};

struct Event {
  std::string name;
  ElementIndex element = no_element;
  EventPriority priority = EventPriority::overwrite;
  std::uint32_t maximum_executions = 1;
  std::vector<Action> actions;
  Trigger start;
};

struct Maneuver {
  std::string name;
  ElementIndex element = no_element;
  std::vector<Event> events;
};

struct ManeuverGroup {
  std::string name;
  ElementIndex element = no_element;
  std::uint32_t maximum_executions = 1;
  std::vector<EntityIndex> actors;
  bool actors_are_triggering_entities = false;
  std::vector<Maneuver> maneuvers;
};

struct Act {
  std::string name;
  ElementIndex element = no_element;
  std::vector<ManeuverGroup> groups;
  Trigger start, stop;
};

struct Story {
  std::string name;
  ElementIndex element = no_element;
  std::vector<Act> acts;
};

/// One action of Init; `entity` is no_entity for a global one.
struct InitAction {
  EntityIndex entity = no_entity;
  ActionVariant what;
  std::string where;  ///< "file:line, <element>", for messages.
};

/// Limit: their numbers among the participants end where traffic's begin, and one tick must hold them all.
inline constexpr std::size_t most_entities = 990;
inline constexpr std::uint32_t most_swarm_vehicles = 3000;

struct Scenario {
  FileHeader header;
  std::string road_file;  ///< As the file gives it: relative to the scenario's folder.
  std::vector<SignalController> signals;
  std::vector<Entity> entities;
  /// Name and value of the parameters that can be given from outside.
  std::vector<std::pair<std::string, std::string>> parameters;
  std::vector<std::string> values;  ///< Values of parameters and variables when the scenario begins.
  std::vector<std::shared_ptr<const Route>> routes;
  std::vector<InitAction> init;
  std::vector<Story> stories;
  Trigger stop;
  std::optional<GameSettings> game;  ///< Set where the scenario is played as a game.
  ElementIndex storyboard_element = 0;
  std::uint32_t element_count = 1;
  std::uint32_t condition_count = 0;
  /// The name of each element, "story::act::group::maneuver::event::action", for messages and logs.
  std::vector<std::string> element_names;
};

std::optional<EntityIndex> find_entity(const Scenario& scenario, std::string_view name);

}  // namespace septet::scenario
