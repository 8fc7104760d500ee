#include "engine/simulation/game.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/core.h>

#include "engine/road/road_locate.hpp"
#include "engine/scenario/run/start_action.hpp"
#include "engine/simulation/operator_command.hpp"

namespace septet::simulation {
namespace {

constexpr Tick count_every_ticks = 12;
constexpr double points_ps = 10.0, own_lane_factor = 2.0;
constexpr double more_often = 0.12;       ///< Growth of the leader's rate of changes on each level.
constexpr double move_lane_s = 3.5;       ///< Duration of a change by one lane; by two it is half as long again.
constexpr std::uint64_t game_stream = 7;  ///< Stream of the drive's seed.

const char* name_of(GameEnd end) {
  switch (end) {
    case GameEnd::none:
      return "none";
    case GameEnd::lost:
      return "lost";
    case GameEnd::crash:
      return "crash";
    case GameEnd::time:
      return "time";
  }
  return "";
}

int lane_of(const Model& model, const State& state, const Participant& car) {
  const Vec3& at = car.world_from_vehicle.position_m;
  const auto place = road::locate(model.roads, {at.x, at.y}, state.car_road ? &*state.car_road : nullptr, 60.0);
  return place ? place->lanes.lane : 0;
}

/// Another of its lanes, one or two away.
int next_lane(const scenario::GameSettings& settings, int lane, Random& random) {
  const int reach = 1 + static_cast<int>(random.below(2));
  const int way = random.below(2) == 0 ? -reach : reach;
  const auto within = [&](int there) { return there >= settings.first_lane && there <= settings.last_lane; };
  for (const int there : {lane + way, lane - way, lane + (way > 0 ? 1 : -1), lane - (way > 0 ? 1 : -1)})
    if (within(there)) return there;
  return std::clamp(lane, settings.first_lane, settings.last_lane);
}

void move_leader(const Model& model, const scenario::GameSettings& settings, State& state) {
  GameState& game = *state.game;
  const scenario::EntityState& leader = state.scenario.entities[settings.leader];
  if (game.standing.survived_s < game.next_move_s || leader.lateral_control.active || !leader.on_road) return;
  const double often = 1.0 + more_often * (game.standing.level - 1);
  game.next_move_s = game.standing.survived_s + settings.move_s / often * game.random.uniform(0.75, 1.25);
  const int lane = next_lane(settings, leader.lane.lane, game.random);
  if (lane == leader.lane.lane) return;
  scenario::LaneChangeAction change;
  change.dynamics = {scenario::DynamicsShape::sinusoidal, scenario::DynamicsDimension::time,
                     move_lane_s * (std::abs(lane - leader.lane.lane) > 1 ? 1.5 : 1.0)};
  change.lane = lane;
  scenario::StepResult nothing_asked;  // A change of lane requests nothing of other stages.
  (void)scenario::start_action(model.scenario, model.roads, change, scenario::no_element, {settings.leader},
                               state.scenario, nothing_asked);
}

/// Number of vehicles by which the swarm may still grow.
std::uint32_t more_vehicles(const Model& model, const scenario::GameSettings& settings, std::uint32_t level) {
  const auto* swarm = first_swarm(model.scenario);
  const std::uint64_t there =
      (swarm ? swarm->vehicle_count : 0) + std::uint64_t{settings.more_vehicles} * std::uint64_t{level - 1};
  return there <= scenario::most_swarm_vehicles ? settings.more_vehicles : 0;
}

void count(const Model& model, const scenario::GameSettings& settings, const Participant& car, State& state,
           std::vector<Event>& events) {
  GameStanding& standing = state.game->standing;
  constexpr double seconds = static_cast<double>(count_every_ticks) * tick_s;
  const Tick counts = state.tick / count_every_ticks;
  standing.survived_s = static_cast<double>(counts) * seconds;
  const scenario::EntityState& leader = state.scenario.entities[settings.leader];
  const Vec3 away = leader.world_from_entity.position_m - car.world_from_vehicle.position_m;
  standing.leader_m = leader.active ? glm::length(away) : 0.0;
  const bool is_ahead = glm::dot(away, car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0)) > 0.0;
  standing.away_s = leader.active && standing.leader_m > settings.lost_m ? standing.away_s + seconds : 0.0;
  if (leader.active && is_ahead && standing.leader_m <= settings.near_m) {
    const bool in_its_lane = lane_of(model, state, car) == leader.lane.lane;
    standing.points += seconds * points_ps * standing.level * (in_its_lane ? own_lane_factor : 1.0);
  }
  const auto level = 1 + static_cast<std::uint32_t>(standing.survived_s / settings.level_s);
  if (level > standing.level && standing.survived_s < settings.seconds) {
    standing.level = level;
    const std::uint32_t more = more_vehicles(model, settings, level);
    state.traffic->worsen(more);
    events.push_back({"game", std::nullopt,
                      fmt::format("level={} more_vehicles={} points={:.0f} survived_s={:.1f}", level, more,
                                  standing.points, standing.survived_s)});
  }
  // A leader at the end of its road is gone: nobody is left to follow, and the game ends as survived.
  if (standing.away_s >= settings.lost_s)
    standing.end = GameEnd::lost;
  else if (standing.survived_s >= settings.seconds || !leader.active)
    standing.end = GameEnd::time;
}

/// Who ran into whom in the last collision, as that tells it ("driver", "other", "nobody"); of what stands beside the
/// road nobody is told: then it was the driver.
std::string_view whose_crash(const std::vector<Event>& events) {
  const auto last = std::ranges::find(events.rbegin(), events.rend(), "collision", &Event::kind);
  if (last != events.rend())
    for (const std::string_view whose : {"other", "nobody"})
      if (last->detail.ends_with(fmt::format("by={}", whose))) return whose;
  return "driver";
}

}  // namespace

GameState initial_game(const scenario::GameSettings& settings, std::uint64_t seed) {
  GameState game;
  game.random = Random(seed, game_stream);
  game.next_move_s = 0.5 * settings.move_s * game.random.uniform(0.75, 1.25);
  return game;
}

void advance_game(const Model& model, const Participant& car, State& state, std::vector<Event>& events) {
  if (!state.game || state.game->standing.end != GameEnd::none) return;
  const scenario::GameSettings& settings = *model.scenario.game;
  GameStanding& standing = state.game->standing;
  if (state.tick == 1) events.push_back({"game", std::nullopt, "state=begins level=1"});
  if (state.tick % count_every_ticks == 0) {
    count(model, settings, car, state, events);
    move_leader(model, settings, state);
  }
  if (state.diagnostics.collisions > 0) standing.end = GameEnd::crash;
  if (standing.end == GameEnd::none) return;
  const std::string whose = standing.end == GameEnd::crash ? fmt::format(" by={}", whose_crash(events)) : "";
  events.push_back({"game", std::nullopt,
                    fmt::format("state=over why={}{} level={} points={:.0f} survived_s={:.1f}", name_of(standing.end),
                                whose, standing.level, standing.points, standing.survived_s)});
}

}  // namespace septet::simulation
