#include "engine/simulation/operator_command.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/car_faults.hpp"
#include "engine/simulation/command_words.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/guidance.hpp"
#include "engine/simulation/storyboard_stage.hpp"

namespace septet::simulation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::string_view no_goal = "nowhere";
constexpr std::size_t longest_goal = 200;
// Within the ranges that models and pictures support.
constexpr std::array condition_table{
    Condition{"rain_mm_per_h", 0.0, 100.0, &Environment::rain_mm_per_h},
    Condition{"road_wetness", 0.0, 1.0, &Environment::road_wetness},
    Condition{"snow_cover", 0.0, 1.0, &Environment::snow_cover},
    Condition{"visibility_m", 20.0, 100000.0, &Environment::visibility_m},
    Condition{"cloud_cover", 0.0, 1.0, &Environment::cloud_cover},
    Condition{"temperature_k", 233.15, 323.15, &Environment::temperature_k},
    Condition{"wind_speed_mps", 0.0, 40.0, &Environment::wind_speed_mps},
    Condition{"wind_direction_rad", -2.0 * pi, 2.0 * pi, &Environment::wind_direction_rad},
    Condition{"sun_elevation_rad", -0.5 * pi, 0.5 * pi, &Environment::sun_elevation_rad},
    Condition{"sun_azimuth_rad", 0.0, 2.0 * pi, &Environment::sun_azimuth_rad},
    Condition{"sun_illuminance_lux", 0.0, 150000.0, &Environment::sun_illuminance_lux},
    Condition{"friction_scale", 0.05, 1.5, nullptr},
};

tl::unexpected<Error> no_command(std::string what) {
  return failure(std::move(what), "operator's command",
                 "write \"conditions NAME=VALUE …\", \"traffic vehicles=N\", \"trigger element=NAME\", \"place x_m=X "
                 "y_m=Y part=NAME\", \"remove thing=N\" "
                 "\"hide entity=NAME\", \"fault what=NAME\", \"repair what=NAME\", \"put x_m=X y_m=Y heading_rad=A "
                 "speed_mps=V\", \"hazard x_m=X y_m=Y name=NAME\", \"call name=NAME node=NODE PARAMETER=VALUE …\", "
                 "\"overlook\", \"errors "
                 "overlook=N late_brake=N telephone=N red=N\" or \"to PLACE\"");
}

Expected<OperatorCommand> parse_conditions(std::string_view text) {
  SetConditions set;
  while (!text.empty()) {
    const auto word = take_word(text);
    const auto equals = word.find('=');
    if (equals == std::string_view::npos) return no_command("a condition has no value");
    const auto found = std::ranges::find(condition_table, word.substr(0, equals), &Condition::name);
    if (found == condition_table.end()) return no_command("there is no such condition");
    double value = 0.0;
    if (!read_number(word.substr(equals + 1), value) || !(value >= found->least && value <= found->most))
      return no_command(fmt::format("{} is to be from {:g} to {:g}", found->name, found->least, found->most));
    if (std::ranges::find(set.values, &*found, &std::pair<const Condition*, double>::first) != set.values.end())
      return no_command(fmt::format("{} is given twice", found->name));
    set.values.emplace_back(&*found, value);
  }
  if (set.values.empty()) return no_command("no condition is given");
  return set;
}

/// "X y_m=Y part=NAME".
Expected<OperatorCommand> parse_place(std::string_view text) {
  constexpr std::string_view second = " y_m=", third = " part=";
  const auto y = text.find(second), part = text.find(third);
  PlacePart place;
  constexpr double furthest_m = 1e7;
  const auto is_place = [](double value) { return value >= -furthest_m && value <= furthest_m; };
  if (y == text.npos || part == text.npos || part < y || !read_number(text.substr(0, y), place.x_m) ||
      !read_number(text.substr(y + second.size(), part - y - second.size()), place.y_m) || !is_place(place.x_m) ||
      !is_place(place.y_m))
    return no_command("this is no place");
  place.part = text.substr(part + third.size());
  if (!part_of_name(place.part)) return no_command("there is no such thing");
  return place;
}

/// "X y_m=Y heading_rad=A speed_mps=V".
Expected<OperatorCommand> parse_put(std::string_view text) {
  PutCar put;
  constexpr double furthest_m = 1e7;
  const struct {
    std::string_view name;
    double PutCar::*value;
    double least, most;
  } numbers[] = {{"", &PutCar::x_m, -furthest_m, furthest_m},
                 {"y_m=", &PutCar::y_m, -furthest_m, furthest_m},
                 {"heading_rad=", &PutCar::heading_rad, -2.0 * pi, 2.0 * pi},
                 {"speed_mps=", &PutCar::speed_mps, 0.0, fastest_put_mps}};
  for (const auto& number : numbers) {
    const auto word = take_word(text);
    double& value = put.*number.value;
    if (!word.starts_with(number.name) || !read_number(word.substr(number.name.size()), value) ||
        !(value >= number.least && value <= number.most))
      return no_command("this is no place to put the car");
  }
  if (!text.empty()) return no_command("this is no place to put the car");
  return put;
}

/// "X y_m=Y name=NAME".
Expected<OperatorCommand> parse_hazard(std::string_view text) {
  constexpr std::string_view second = "y_m=", third = "name=";
  constexpr double furthest_m = 1e7;
  SetHazard set;
  const auto x = take_word(text), y = take_word(text);
  const auto is_place = [](double value) { return value >= -furthest_m && value <= furthest_m; };
  if (!read_number(x, set.x_m) || !y.starts_with(second) || !read_number(y.substr(second.size()), set.y_m) ||
      !is_place(set.x_m) || !is_place(set.y_m) || !text.starts_with(third) || text.size() == third.size())
    return no_command("this is no hazard and no place");
  set.name = text.substr(third.size());
  return set;
}

/// Applies `use` to each act and each event of the storyboard, as whole elements.
template <class Use>
void each_trigger(const scenario::Scenario& scenario, const Use& use) {
  for (const auto& story : scenario.stories)
    for (const auto& act : story.acts) {
      use(act);
      for (const auto& group : act.groups)
        for (const auto& maneuver : group.maneuvers)
          for (const auto& event : maneuver.events) use(event);
    }
}

Expected<void> apply(const Model&, const SetConditions& set, State& state, std::vector<Event>&) {
  for (const auto& [condition, value] : set.values)
    (condition->environment ? state.scenario.environment.*(condition->environment) : state.scenario.friction_scale) =
        value;
  return {};
}

Expected<void> apply(const Model& model, const SetTraffic& set, State& state, std::vector<Event>&) {
  const auto* swarm = first_swarm(model.scenario);
  if (!swarm)
    return failure("the scenario has no traffic of which there could be more or less", "traffic",
                   "give it a TrafficSwarmAction");
  auto wanted = *swarm;
  wanted.vehicle_count = set.vehicles;
  const Participant car = driven_car(model, state).participant;
  drop_traffic_bodies(state);
  state.traffic->start(swarm_parameters(wanted), foreign_vehicles(model, state, car));
  return {};
}

Expected<void> apply(const Model& model, const TriggerElement& trigger, State& state, std::vector<Event>& events) {
  const auto& names = model.scenario.element_names;
  const auto found = std::ranges::find(names, trigger.name);
  if (found == names.end())
    return failure("the storyboard has no such element", trigger.name.substr(0, 200),
                   "name an act or an event of the scenario");
  scenario::StepResult result;
  const auto element = static_cast<scenario::ElementIndex>(found - names.begin());
  auto done = scenario::trigger_element(model.scenario, model.roads, element, state.scenario, result);
  if (done) carry_out(model, result, driven_car(model, state).participant, state, events);
  return done;
}

Expected<void> apply(const Model& model, const PlacePart& place, State& state, std::vector<Event>&) {
  const auto part = part_of_name(place.part);
  if (!part) return no_command("there is no such thing");
  const RigidTransform car = driven_car(model, state).participant.world_from_vehicle;
  const Vec2 at(place.x_m, place.y_m);
  const double away_m = glm::length(at - Vec2(car.position_m));
  if (away_m < nearest_place_m || away_m > furthest_place_m)
    return failure(fmt::format("it would be {:.0f} m from the driver's car", away_m), "place",
                   fmt::format("choose a place from {:g} to {:g} m away", nearest_place_m, furthest_place_m));
  const auto ground = road::surface_at(model.roads, at);
  if (!ground) return failure("there is no road", "place", "choose a place on a road or just beside it");
  stand_part(*part, {Vec3(at, ground->height_m), orientation_from_angles(heading_rad(car.orientation), 0.0, 0.0)},
             state.effects);
  return {};
}

Expected<void> apply(const Model&, const RemovePiece& remove, State& state, std::vector<Event>&) {
  if (!remove_piece(remove.id, state.effects))
    return failure("it is not there any more", fmt::format("thing {}", remove.id), "name another one");
  return {};
}

/// True for an entity that may be hidden: it has a body that the scenario moves.
bool can_hide(const Model& model, std::size_t entity) {
  return entity != model.driver_entity && model.scenario.entities[entity].kind != scenario::EntityKind::misc_object;
}

/// False for one that has not come into the world yet, so that there is no place at which to show it.
bool has_place(const scenario::EntityState& entity) {
  return entity.active || entity.world_from_entity.position_m != Vec3(0.0);
}

Expected<void> apply(const Model& model, const ShowEntity& show, State& state, std::vector<Event>&) {
  const auto found = scenario::find_entity(model.scenario, show.name);
  if (!found || !can_hide(model, *found))
    return failure("the scenario moves nobody of this name", show.name.substr(0, 200), "name another one");
  scenario::EntityState& entity = state.scenario.entities[*found];
  if (!has_place(entity)) return failure("it has not come yet", show.name, "wait until the storyboard brings it");
  if (entity.active == show.shown)
    return failure(show.shown ? "it is there already" : "it is not there", show.name, "choose the other");
  if (entity.external) return failure("somebody else moves it", show.name, "name one that the scenario moves");
  if (show.shown && entity.world_from_entity.position_m == Vec3(0.0) && !entity.on_road)
    return failure("it has never been anywhere", show.name, "let the storyboard place it first");
  entity.active = show.shown;
  return {};
}

Expected<void> apply(const Model&, const SetFault& set, State& state, std::vector<Event>&) {
  if (has_failed(set.fault, state) == set.failed)
    return failure(set.failed ? "it has failed already" : "it is whole", std::string(fault_names()[set.fault]),
                   "choose the other");
  set_fault(set.fault, set.failed, state);
  return {};
}

/// True for an act in which something begins to endanger the driver.
bool is_hazard(const scenario::Act& act) {
  for (const auto& group : act.groups)
    for (const auto& maneuver : group.maneuvers)
      for (const auto& event : maneuver.events)
        for (const auto& action : event.actions)
          if (std::holds_alternative<scenario::HazardAction>(action.what)) return true;
  return false;
}

/// The one whom a hazard's act places first; no_entity where there is nobody.
scenario::EntityIndex first_actor(const scenario::Act& act) {
  return act.groups.empty() || act.groups.front().actors.empty() ? scenario::no_entity
                                                                 : act.groups.front().actors.front();
}

/// The hazards' acts that may be set now.
std::vector<const scenario::Act*> settable_acts(const scenario::Scenario& scenario,
                                                const scenario::ScenarioState& state) {
  std::vector<const scenario::Act*> found;
  for (const auto& story : scenario.stories)
    for (const auto& act : story.acts) {
      const scenario::EntityIndex first = first_actor(act);
      if (first == scenario::no_entity || state.entities[first].active || state.entities[first].external) continue;
      if (state.elements[act.element].status == scenario::ElementStatus::standby && is_hazard(act))
        found.push_back(&act);
    }
  return found;
}

/// The drivable lane with the nearest middle, among those along the heading if one is given and there are any.
std::optional<road::LanePosition> lane_to_put_on(const road::RoadNetwork& roads, const Vec2& at_m,
                                                 const std::optional<double>& heading_rad) {
  const auto place = road::locate(roads, at_m, nullptr, furthest_put_m);
  if (!place) return std::nullopt;
  const road::Road& road = roads.roads[place->position.road];
  const road::LaneSection& section = road::section_at(road, place->position.s_m);
  constexpr double least_width_m = 2.0;
  std::optional<road::LanePosition> nearest;
  bool is_along = false;
  double nearest_m = 0.0;
  for (const road::Lane& lane : section.lanes) {
    if (lane.id == 0 || !road::is_drivable(lane.type)) continue;
    const road::LanePosition here{place->position.road, lane.id, place->position.s_m, 0.0};
    const road::LanePoint point = road::evaluate_lane(roads, here);
    if (point.lane_width_m < least_width_m) continue;
    const bool along = !heading_rad || std::cos(point.driving_heading_rad - *heading_rad) > 0.0;
    const double away_m = std::abs(point.t_m - place->position.t_m);
    if (nearest && (is_along != along ? is_along : away_m >= nearest_m)) continue;
    nearest = here;
    is_along = along;
    nearest_m = away_m;
  }
  return nearest;
}

/// True where a vehicle that is put at a place would stand in somebody.
bool is_taken(const Model& model, const State& state, const Vec3& place_m) {
  std::vector<Participant> others;
  append_others(model, state, others);
  return std::ranges::any_of(others, [&](const Participant& other) {
    return glm::distance(other.world_from_vehicle.position_m, place_m) < free_around_put_m;
  });
}

Expected<void> apply(const Model& model, const PutCar& put, State& state, std::vector<Event>&) {
  const auto lane = lane_to_put_on(model.roads, {put.x_m, put.y_m}, put.heading_rad);
  if (!lane)
    return failure(fmt::format("there is no lane to drive in within {:g} m", furthest_put_m), "put",
                   "choose a place on a road");
  const road::LanePoint point = road::evaluate_lane(model.roads, *lane);
  if (is_taken(model, state, point.road.position_m))
    return failure("somebody stands there", "put", "choose another place, or wait");
  state.car = vehicle::standstill(model.car, road::world_from_lane(point), put.speed_mps);
  state.hull = {};
  state.impacts.clear();
  std::erase_if(state.bodies.contacts, [](const BodyContact& contact) { return contact.first == driver_participant; });
  const road::RoadPosition here{lane->road, lane->s_m, point.t_m};
  state.wheel_roads.fill(here);
  state.kerbs = {};
  state.strikes = {};
  state.car_road = here;
  state.touching.clear();
  if (state.examiner) state.examiner = ExaminerState{};
  return {};
}

Expected<void> apply(const Model& model, const SetHazard& set, State& state, std::vector<Event>& events) {
  const auto acts = settable_acts(model.scenario, state.scenario);
  const auto act = std::ranges::find(acts, set.name, [](const scenario::Act* one) { return one->name; });
  if (act == acts.end())
    return failure("the scenario has no such hazard that is yet to be set", set.name.substr(0, 200),
                   "name one of those that the page offers");
  const Participant car = driven_car(model, state).participant;
  const auto lane = lane_to_put_on(model.roads, {set.x_m, set.y_m}, std::nullopt);
  if (!lane)
    return failure(fmt::format("there is no lane to drive in within {:g} m", furthest_put_m), "hazard",
                   "choose a place on a road");
  const Vec3 place_m = road::evaluate_lane(model.roads, *lane).road.position_m;
  const double away_m = glm::distance(place_m, car.world_from_vehicle.position_m);
  if (away_m < nearest_hazard_m || away_m > furthest_hazard_m)
    return failure(fmt::format("it would be {:.0f} m from the driver's car", away_m), "hazard",
                   fmt::format("choose a place from {:g} to {:g} m away", nearest_hazard_m, furthest_hazard_m));
  if (is_taken(model, state, place_m))
    return failure("somebody stands there", "hazard", "choose another place, or wait");
  scenario::bring_into_world(model.roads, first_actor(**act), *lane, state.scenario);
  scenario::StepResult result;
  auto done = scenario::trigger_element(model.scenario, model.roads, (*act)->element, state.scenario, result);
  if (done) carry_out(model, result, car, state, events);
  return done;
}

Expected<void> apply(const Model& model, const StandSolid& stand, State& state, std::vector<Event>&) {
  return stand_solid(model, stand, state);
}

Expected<void> apply(const Model&, const ClearSolid& clear, State& state, std::vector<Event>&) {
  return clear_solid(clear, state);
}

Expected<void> apply(const Model& model, const ShowStanding& show, State& state, std::vector<Event>&) {
  return show_standing(model, show, state);
}

Expected<void> apply(const Model&, const Call& call, State&, std::vector<Event>& events) {
  events.push_back(event_of(call));
  return {};
}

Expected<void> apply(const Model& model, const OverlookWish& wish, State& state, std::vector<Event>&) {
  if (wish.whom.empty()) return state.traffic->overlook(wish.who, driver_participant);
  const auto whom = scenario::find_entity(model.scenario, wish.whom);
  if (!whom) return failure("the scenario has nobody of this name", wish.whom, "name an entity of the scenario");
  return state.traffic->overlook(wish.who, number_of(model, *whom));
}

Expected<void> apply(const Model&, const PeopleErrorRates& rates, State& state, std::vector<Event>&) {
  return state.traffic->set_errors(rates);
}

Expected<void> apply(const Model& model, const GuideDriver& wish, State& state, std::vector<Event>& events) {
  return guide(model, wish.to, state, events);
}

}  // namespace

std::span<const Condition> conditions() { return condition_table; }

double value_of(const Condition& condition, const scenario::ScenarioState& state) {
  return condition.environment ? state.environment.*(condition.environment) : state.friction_scale;
}

std::string text_of(const OperatorCommand& command) {
  if (const auto* traffic = std::get_if<SetTraffic>(&command))
    return fmt::format("traffic vehicles={}", traffic->vehicles);
  if (const auto* trigger = std::get_if<TriggerElement>(&command)) return "trigger element=" + trigger->name;
  if (const auto* place = std::get_if<PlacePart>(&command))
    return fmt::format("place x_m={} y_m={} part={}", place->x_m, place->y_m, place->part);
  if (const auto* remove = std::get_if<RemovePiece>(&command)) return fmt::format("remove thing={}", remove->id);
  if (const auto* fault = std::get_if<SetFault>(&command))
    return fmt::format("{} what={}", fault->failed ? "fault" : "repair", fault_names()[fault->fault]);
  if (const auto* put = std::get_if<PutCar>(&command))
    return fmt::format("put x_m={} y_m={} heading_rad={} speed_mps={}", put->x_m, put->y_m, put->heading_rad,
                       put->speed_mps);
  if (const auto* set = std::get_if<SetHazard>(&command))
    return fmt::format("hazard x_m={} y_m={} name={}", set->x_m, set->y_m, set->name);
  if (const auto* show = std::get_if<ShowEntity>(&command))
    return fmt::format("{} entity={}", show->shown ? "show" : "hide", show->name);
  if (const auto* stand = std::get_if<StandSolid>(&command)) return text_of(*stand);
  if (const auto* clear = std::get_if<ClearSolid>(&command)) return text_of(*clear);
  if (const auto* show = std::get_if<ShowStanding>(&command)) return text_of(*show);
  if (const auto* guided = std::get_if<GuideDriver>(&command))
    return "to " + (guided->to.empty() ? std::string(no_goal) : guided->to);
  if (const auto* call = std::get_if<Call>(&command)) return "call " + septet::text_of(*call);
  if (const auto* rates = std::get_if<PeopleErrorRates>(&command)) return "errors " + septet::text_of(*rates);
  if (const auto* wish = std::get_if<OverlookWish>(&command)) {
    const std::string words = septet::text_of(*wish);
    return words.empty() ? "overlook" : "overlook " + words;
  }
  std::string text = "conditions";
  for (const auto& [condition, value] : std::get<SetConditions>(command).values)
    text += fmt::format(" {}={}", condition->name, value);
  return text;
}

Expected<OperatorCommand> parse_operator_command(std::string_view text) {
  if (constexpr std::string_view begin = "conditions "; text.starts_with(begin))
    return parse_conditions(text.substr(begin.size()));
  if (constexpr std::string_view begin = "trigger element="; text.starts_with(begin) && text.size() > begin.size())
    return TriggerElement{std::string(text.substr(begin.size()))};
  if (constexpr std::string_view begin = "traffic vehicles="; text.starts_with(begin)) {
    std::uint32_t vehicles = 0;
    if (!read_number(text.substr(begin.size()), vehicles) || vehicles > scenario::most_swarm_vehicles)
      return no_command(fmt::format("vehicles are to be from 0 to {}", scenario::most_swarm_vehicles));
    return SetTraffic{vehicles};
  }
  if (constexpr std::string_view begin = "place x_m="; text.starts_with(begin))
    return parse_place(text.substr(begin.size()));
  if (constexpr std::string_view begin = "remove thing="; text.starts_with(begin)) {
    RemovePiece remove;
    if (!read_number(text.substr(begin.size()), remove.id)) return no_command("this is no thing's number");
    return remove;
  }
  if (constexpr std::string_view begin = "put x_m="; text.starts_with(begin))
    return parse_put(text.substr(begin.size()));
  if (constexpr std::string_view begin = "hazard x_m="; text.starts_with(begin))
    return parse_hazard(text.substr(begin.size()));
  if (constexpr std::string_view begin = "stand "; text.starts_with(begin))
    return read_stand(text.substr(begin.size()));
  if (constexpr std::string_view begin = "clear "; text.starts_with(begin))
    return read_clear(text.substr(begin.size()));
  if (constexpr std::string_view begin = "gone "; text.starts_with(begin))
    return read_standing(text.substr(begin.size()), false);
  if (constexpr std::string_view begin = "back "; text.starts_with(begin))
    return read_standing(text.substr(begin.size()), true);
  if (constexpr std::string_view begin = "call "; text.starts_with(begin)) return read_call(text.substr(begin.size()));
  if (constexpr std::string_view begin = "errors "; text.starts_with(begin))
    return read_error_rates(text.substr(begin.size()));
  if (constexpr std::string_view word = "overlook"; text == word) return OverlookWish{};
  if (constexpr std::string_view begin = "overlook "; text.starts_with(begin) && text.size() > begin.size())
    return read_overlook_wish(text.substr(begin.size()));
  if (constexpr std::string_view begin = "to "; text.starts_with(begin) && text.size() > begin.size()) {
    const std::string_view to = text.substr(begin.size());
    if (to.size() > longest_goal || !printable_characters(to)) return no_command("this is no goal");
    return GuideDriver{to == no_goal ? std::string() : std::string(to)};
  }
  for (const bool failed : {false, true}) {
    const std::string_view begin = failed ? "fault what=" : "repair what=";
    if (!text.starts_with(begin)) continue;
    const auto fault = fault_of_name(text.substr(begin.size()));
    if (!fault) return no_command("the car has nothing of this name that fails");
    return SetFault{*fault, failed};
  }
  for (const bool shown : {false, true}) {
    const std::string_view begin = shown ? "show entity=" : "hide entity=";
    if (text.starts_with(begin) && text.size() > begin.size())
      return ShowEntity{std::string(text.substr(begin.size())), shown};
  }
  return no_command("there is no such command");
}

Expected<void> apply_operator_command(const Model& model, const OperatorCommand& command, State& state,
                                      std::vector<Event>& events) {
  return std::visit([&](const auto& what) { return apply(model, what, state, events); }, command);
}

const scenario::TrafficSwarmAction* first_swarm(const scenario::Scenario& scenario) {
  for (const auto& action : scenario.init)
    if (const auto* swarm = std::get_if<scenario::TrafficSwarmAction>(&action.what)) return swarm;
  for (const auto& story : scenario.stories)
    for (const auto& act : story.acts)
      for (const auto& group : act.groups)
        for (const auto& maneuver : group.maneuvers)
          for (const auto& event : maneuver.events)
            for (const auto& action : event.actions)
              if (const auto* swarm = std::get_if<scenario::TrafficSwarmAction>(&action.what)) return swarm;
  return nullptr;
}

std::vector<Hideable> hideable(const Model& model, const scenario::ScenarioState& state) {
  std::vector<Hideable> list;
  for (std::size_t i = 0; i < state.entities.size(); ++i)
    if (can_hide(model, i) && !state.entities[i].external && has_place(state.entities[i]))
      list.push_back({model.scenario.entities[i].name, state.entities[i].active});
  return list;
}

std::vector<std::string> settable_hazards(const scenario::Scenario& scenario, const scenario::ScenarioState& state) {
  std::vector<std::string> names;
  for (const scenario::Act* act : settable_acts(scenario, state)) names.push_back(act->name);
  return names;
}

std::vector<std::string> triggers(const scenario::Scenario& scenario, const scenario::ScenarioState& state) {
  std::vector<std::string> names;
  each_trigger(scenario, [&](const auto& what) {
    if (state.elements[what.element].status == scenario::ElementStatus::standby)
      names.push_back(scenario.element_names[what.element]);
  });
  return names;
}

}  // namespace septet::simulation
