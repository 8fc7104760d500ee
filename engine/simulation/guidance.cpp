#include "engine/simulation/guidance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/simulation/driver_car.hpp"

namespace septet::simulation {
namespace {

constexpr std::uint32_t guidance_look_ticks = 12;
constexpr std::size_t steps_ahead = 8;  ///< On which the car may be found at a look.
constexpr double middle_m = 1.4;        ///< Of the wheelbase, ahead of the rear axle.
constexpr double lane_within_m = 300.0, lane_before_m = 60.0;
constexpr double arrives_within_m = 8.0;
constexpr std::uint32_t seek_again_ticks = 600;

std::vector<traffic::PlaceOnLane> lanes_of_car(const Model& model, const traffic::LaneGraph& graph,
                                               const Participant& car) {
  const Vec3 ahead = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  return traffic::lanes_under(graph, model.roads, Vec2(car.world_from_vehicle.position_m + middle_m * ahead),
                              std::atan2(ahead.y, ahead.x));
}

/// The next turn on the instruments.
void show_next(const GuidanceState& guidance, Guidance& shown) {
  const traffic::RouteTurn* next = nullptr;
  for (std::size_t i = guidance.turn; i < guidance.turns.size() && !next; ++i)
    if (guidance.turns[i].is_told) next = &guidance.turns[i];
  if (!next) return;
  shown.next = next->word;
  const double to_go_m = guidance.arrived ? 0.0 : std::max(0.0, next->at_m - guidance.along_m);
  shown.to_next_m = static_cast<std::uint32_t>(10.0 * std::round(0.1 * to_go_m));
}

void say(GuidanceWord word, double in_m, Tick tick, GuidanceState& guidance, std::vector<Event>& events) {
  guidance.shown.told = word;
  ++guidance.shown.told_count;
  guidance.shown.told_at = tick;
  std::string detail =
      fmt::format("word={} when={} in_m={:.0f}", name_of(word.what), word.now ? "now" : "soon", std::max(0.0, in_m));
  if (word.exit > 0) detail += fmt::format(" exit={}", word.exit);
  events.push_back({"guidance", driver_participant, std::move(detail)});
}

/// Takes a route, from its begin.
void take(const Model& model, traffic::LaneRoute route, Tick tick, GuidanceState& guidance) {
  guidance.route = std::move(route);
  guidance.turns = traffic::route_turns(*guidance.graph, model.roads, guidance.route);
  guidance.step = guidance.turn = 0;
  guidance.along_m = 0.0;
  guidance.soon_told = guidance.now_told = guidance.lane_told = guidance.arrived = false;
  guidance.off_ticks = guidance.wait_ticks = 0;
  guidance.route_at = tick;
}

std::optional<traffic::LaneRoute> best_route(const GuidanceState& guidance,
                                             const std::vector<traffic::PlaceOnLane>& from) {
  for (const traffic::PlaceOnLane& place : from) {
    auto route = traffic::plan_route_over(*guidance.graph, place, guidance.goals);
    if (route && route->steps.size() <= most_guided_sections) return route;
  }
  return std::nullopt;
}

Expected<void> begin(const Model& model, GuidanceState guidance, State& state, std::vector<Event>& events) {
  const Participant car = driven_car(model, state).participant;
  const auto from = lanes_of_car(model, *guidance.graph, car);
  if (from.empty())
    return failure("the car stands in no lane that leads where it heads", "route", "drive onto a road first");
  auto route = best_route(guidance, from);
  if (!route) return failure("no lanes lead there from where the car is", "route", "choose another goal");
  events.push_back({"guidance", driver_participant,
                    fmt::format("word=route length_m={:.0f} time_s={:.0f}", route->length_m, route->time_s)});
  if (state.guidance) guidance.shown = state.guidance->shown;
  take(model, std::move(*route), state.tick, guidance);
  show_next(guidance, guidance.shown);
  guidance.shown_at = state.tick;
  state.guidance = std::move(guidance);
  return {};
}

std::shared_ptr<const traffic::LaneGraph> graph_of(const Model& model, const State& state) {
  if (state.guidance) return state.guidance->graph;
  return std::make_shared<const traffic::LaneGraph>(traffic::build_lane_graph(model.roads));
}

/// The car's place on the route, if it is on one of the next steps.
std::optional<traffic::PlaceOnLane> find_on_route(const std::vector<traffic::PlaceOnLane>& under,
                                                  GuidanceState& guidance) {
  const auto& graph = *guidance.graph;
  const auto& steps = guidance.route.steps;
  for (std::size_t i = guidance.step; i < std::min(guidance.step + steps_ahead, steps.size()); ++i)
    for (const traffic::PlaceOnLane& place : under) {
      if (!is_beside(graph.ways[place.way], graph.ways[steps[i].enters])) continue;
      const traffic::Way& left = graph.ways[steps[i].leaves];
      const double share = place.at_m / graph.ways[place.way].length_m;
      const double along_m = steps[i].begins_m + share * left.length_m;
      // A section may come twice on a route: not the place that lies behind.
      if (i == guidance.step && along_m < guidance.along_m - 20.0) continue;
      guidance.step = i;
      guidance.along_m = along_m;
      return place;
    }
  return std::nullopt;
}

void seek_another(const Model& model, const std::vector<traffic::PlaceOnLane>& under, Tick tick,
                  GuidanceState& guidance, std::vector<Event>& events) {
  auto route = best_route(guidance, under);
  if (route) {
    take(model, std::move(*route), tick, guidance);
    say({Guided::new_route, true, 0}, 0.0, tick, guidance, events);
    return;
  }
  if (guidance.shown.told.what != Guided::no_way || guidance.shown.told_count == 0)
    say({Guided::no_way, true, 0}, 0.0, tick, guidance, events);
  guidance.wait_ticks = seek_again_ticks;
}

void tell_lane(const traffic::PlaceOnLane& place, double to_go_m, Tick tick, GuidanceState& guidance,
               std::vector<Event>& events) {
  const auto& graph = *guidance.graph;
  if (guidance.lane_told || to_go_m > lane_within_m || to_go_m < lane_before_m) return;
  if (graph.ways[place.way].in_junction()) return;
  const auto lanes = traffic::lanes_towards_turn(graph, guidance.route, guidance.step);
  if (std::ranges::binary_search(lanes, place.way)) return;
  // Ways of a section are listed from left to right as its road runs.
  const bool to_left = (lanes.front() < place.way) == graph.ways[place.way].along_s;
  guidance.lane_told = true;
  say({to_left ? Guided::keep_left : Guided::keep_right, true, 0}, to_go_m, tick, guidance, events);
}

void tell_turn(const Participant& car, Tick tick, GuidanceState& guidance, std::vector<Event>& events) {
  const double speed_mps = glm::length(Vec2(car.velocity_mps));
  while (guidance.turn + 1 < guidance.turns.size() && guidance.along_m > guidance.turns[guidance.turn].at_m + 1.0) {
    ++guidance.turn;
    guidance.soon_told = guidance.now_told = guidance.lane_told = false;
  }
  // Crossings that are passed without a word are told about no more than they must be.
  std::size_t index = guidance.turn;
  double clear_from_m = index > 0 ? guidance.turns[index - 1].ends_m : 0.0;
  while (index + 1 < guidance.turns.size() && !guidance.turns[index].is_told)
    clear_from_m = guidance.turns[index++].ends_m;
  const traffic::RouteTurn& turn = guidance.turns[index];
  const bool is_goal = index + 1 == guidance.turns.size();
  const double to_go_m = turn.at_m - guidance.along_m;
  const bool is_clear = guidance.along_m >= clear_from_m - 5.0;
  GuidanceWord word = turn.word;
  if (is_goal) {
    if (to_go_m < arrives_within_m) {
      word.now = guidance.arrived = true;
      say(word, to_go_m, tick, guidance, events);
    } else if (!guidance.soon_told && is_clear && to_go_m < early_m) {
      guidance.soon_told = true;
      say(word, to_go_m, tick, guidance, events);
    }
    return;
  }
  if (!is_clear && to_go_m > 0.5 * again_m) return;
  if (!guidance.now_told && to_go_m < std::max(again_m, again_s * speed_mps)) {
    guidance.soon_told = guidance.now_told = word.now = true;
    say(word, to_go_m, tick, guidance, events);
  } else if (!guidance.soon_told && to_go_m < std::max(early_m, early_s * speed_mps)) {
    guidance.soon_told = true;
    say(word, to_go_m, tick, guidance, events);
  }
}

}  // namespace

Expected<void> guide(const Model& model, std::string_view place, State& state, std::vector<Event>& events) {
  if (place.empty()) {
    if (!state.guidance) return failure("nobody guides the driver", "route", "choose a goal first");
    state.guidance.reset();
    events.push_back({"guidance", driver_participant, "word=ended"});
    return {};
  }
  GuidanceState guidance;
  guidance.graph = graph_of(model, state);
  auto goal = traffic::find_goal(*guidance.graph, model.roads, place);
  if (!goal) return tl::unexpected(goal.error());
  guidance.goals.push_back(std::move(*goal));
  return begin(model, std::move(guidance), state, events);
}

Expected<void> guide_over(const Model& model, const std::vector<road::LanePosition>& places, State& state,
                          std::vector<Event>& events) {
  GuidanceState guidance;
  guidance.graph = graph_of(model, state);
  const auto from = lanes_of_car(model, *guidance.graph, driven_car(model, state).participant);
  for (const road::LanePosition& place : places) {
    std::vector<traffic::PlaceOnLane> lanes = traffic::lanes_at(*guidance.graph, model.roads, place.road, place.s_m);
    // A place in a lane is of its direction of travel.
    const traffic::WayIndex meant = traffic::way_at(*guidance.graph, model.roads, place.road, place.lane, place.s_m);
    if (meant != traffic::no_way)
      std::erase_if(lanes, [&](const traffic::PlaceOnLane& lane) {
        return !is_beside(guidance.graph->ways[lane.way], guidance.graph->ways[meant]);
      });
    const auto lies_behind = [&](const traffic::PlaceOnLane& lane) {
      return std::ranges::any_of(from, [&](const traffic::PlaceOnLane& car) {
        return is_beside(guidance.graph->ways[lane.way], guidance.graph->ways[car.way]) && lane.at_m <= car.at_m;
      });
    };
    if (guidance.goals.empty() && places.size() > 1 && std::ranges::any_of(lanes, lies_behind)) continue;
    if (lanes.empty()) return failure("nobody drives where the route leads", "route", "choose places on driving lanes");
    guidance.goals.push_back(std::move(lanes));
  }
  if (guidance.goals.empty()) return failure("the route has no place ahead", "route", "give it another waypoint");
  return begin(model, std::move(guidance), state, events);
}

void advance_guidance(const Model& model, const Participant& car, State& state, std::vector<Event>& events) {
  if (!state.guidance || state.tick % guidance_look_ticks != 0) return;
  GuidanceState& guidance = *state.guidance;
  if (guidance.arrived) return;
  const Guidance before = guidance.shown;
  const auto under = lanes_of_car(model, *guidance.graph, car);
  if (const auto place = find_on_route(under, guidance)) {
    guidance.off_ticks = 0;
    while (guidance.goals.size() > 1 && guidance.along_m > guidance.route.reached_m.front()) {
      guidance.goals.erase(guidance.goals.begin());
      guidance.route.reached_m.erase(guidance.route.reached_m.begin());
    }
    tell_turn(car, state.tick, guidance, events);
    if (!guidance.arrived) {
      const double to_go_m = guidance.turns[guidance.turn].at_m - guidance.along_m;
      tell_lane(*place, to_go_m, state.tick, guidance, events);
    }
  } else if (!under.empty()) {
    guidance.off_ticks += guidance_look_ticks;
    guidance.wait_ticks -= std::min(guidance.wait_ticks, guidance_look_ticks);
    if (guidance.off_ticks >= static_cast<std::uint32_t>(off_s * tick_rate_hz) && guidance.wait_ticks == 0)
      seek_another(model, under, state.tick, guidance, events);
  }
  show_next(guidance, guidance.shown);
  if (!(guidance.shown == before)) guidance.shown_at = state.tick;
}

bool complete_guidance(const Model& model, GuidanceState& guidance) {
  guidance.graph = std::make_shared<const traffic::LaneGraph>(traffic::build_lane_graph(model.roads));
  const auto ways = guidance.graph->ways.size();
  const auto is_place = [&](const traffic::PlaceOnLane& place) { return place.way < ways; };
  const auto is_step = [&](const traffic::RouteStep& step) { return step.enters < ways && step.leaves < ways; };
  const traffic::LaneRoute& route = guidance.route;
  if (guidance.goals.empty() || route.steps.empty() || guidance.step >= route.steps.size()) return false;
  if (route.reached_m.size() != guidance.goals.size() || route.steps.size() > most_guided_sections) return false;
  if (!is_place(route.from) || !is_place(route.to) || !std::ranges::all_of(route.steps, is_step)) return false;
  for (const auto& goal : guidance.goals)
    if (!std::ranges::all_of(goal, is_place)) return false;
  if (static_cast<std::size_t>(guidance.shown.next.what) > static_cast<std::size_t>(Guided::no_way)) return false;
  if (static_cast<std::size_t>(guidance.shown.told.what) > static_cast<std::size_t>(Guided::no_way)) return false;
  guidance.turns = traffic::route_turns(*guidance.graph, model.roads, route);
  return guidance.turn < guidance.turns.size();
}

void append_guidance(const State& state, std::vector<EffectKeyframe>& effects) {
  if (!state.guidance) return;
  const GuidanceState& guidance = *state.guidance;
  effects.push_back({guidance_effect_id, guidance_keyframe_kind, encode_guidance(guidance.shown), guidance.shown_at});
  GuidedRoute route;
  for (const traffic::RouteStep& step : guidance.route.steps) {
    const traffic::Way& way = guidance.graph->ways[step.enters];
    route.sections.push_back({way.road, way.section, way.lane, guidance.graph->ways[step.leaves].lane});
  }
  route.ends_m = guidance.route.to.at_m;
  effects.push_back(
      {guided_route_effect_id, guided_route_keyframe_kind, encode_guided_route(route), guidance.route_at});
}

}  // namespace septet::simulation
