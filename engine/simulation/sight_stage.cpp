#include "engine/simulation/sight_stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/core.h>

#include "engine/effects/smoke/visibility.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/sight/air.hpp"
#include "engine/sight/line_of_sight.hpp"
#include "engine/simulation/air_now.hpp"
#include "engine/world/participant_sight.hpp"
#include "engine/world/solid.hpp"

namespace septet::simulation {
namespace {

constexpr Tick look_ticks = 30;
constexpr double step_m = 1.0;
constexpr double most_spray_depth = 2.0;

/// False where a driver sees all of `farthest_sight_m`: the weather hides too little, and there is no smoke within that.
bool may_be_limited(const Air& air, const Participant& driver) {
  if (air.per_m * farthest_sight_m + most_spray_depth >= sight::reflecting_depth) return true;
  if (!air.smoke) return false;
  const smoke::Grid& grid = air.smoke->grid;
  const Vec3 at = grid.grid_from_world(driver.world_from_vehicle.position_m);
  const double reach = farthest_sight_m / grid.cell_m;
  return at.x > -reach && at.x < grid.nx + reach && at.y > -reach && at.y < grid.ny + reach;
}

/// A driver's way ahead: a line that bends as the road does where he is.
struct View {
  sight::Line line;
  double bonnet_m = 0.0;  ///< From the eye to the front bumper.
  Vec3 left{0.0};
  double curvature_per_m = 0.0;
  bool roofed = false;

  /// The place on the way at a place of its straight line.
  Vec3 bent(const Vec3& straight_m) const {
    const double ahead_m = glm::dot(straight_m - line.from_m, line.direction);
    return straight_m + 0.5 * curvature_per_m * ahead_m * ahead_m * left;
  }
};

View view_of(const Model& model, const Participant& driver) {
  const VehicleModel& body = vehicle_models()[driver.model];
  const RigidTransform& place = driver.world_from_vehicle;
  const Vec3 eyes_m = driver_eyes_m(body);
  View view;
  view.line = {place * eyes_m, place.orientation * Vec3(1.0, 0.0, 0.0)};
  view.bonnet_m = body.front_m() - eyes_m.x;
  view.left = place.orientation * Vec3(0.0, 1.0, 0.0);
  const auto found = road::locate(model.roads, Vec2(place.position_m));
  if (!found) return view;
  const road::RoadPoint point = road::evaluate(model.roads, found->position);
  const double along =
      std::cos(point.heading_rad) * view.line.direction.x + std::sin(point.heading_rad) * view.line.direction.y;
  view.curvature_per_m = std::copysign(1.0, along) * point.curvature_per_m;
  view.roofed = is_roofed(model.roads, found->position);
  return view;
}

/// The nearest vehicle on a driver's way.
struct Ahead {
  const Participant* vehicle = nullptr;
  double away_m = farthest_sight_m;
};

Ahead nearest_ahead(const std::vector<Participant>& participants, const Participant& driver, const View& view) {
  constexpr double beside_m = 2.0, beside_share = 0.02;
  Ahead nearest;
  for (const Participant& other : participants) {
    if (other.id == driver.id) continue;
    const VehicleModel body = shape_of(other);
    const Vec3 away = other.world_from_vehicle * Vec3(body.centre_x_m(), 0.0, 0.0) - view.line.from_m;
    const double ahead_m = glm::dot(away, view.line.direction);
    const double rear_m = ahead_m - 0.5 * body.length_m;
    if (!(rear_m > 0.0) || rear_m >= nearest.away_m) continue;
    const double aside_m = glm::dot(away, view.left) - 0.5 * view.curvature_per_m * ahead_m * ahead_m;
    if (std::abs(aside_m) < beside_m + beside_share * ahead_m) nearest = {&other, rear_m};
  }
  return nearest;
}

/// Distance of a wall of the smoke's room along the way.
double wall_m(const smoke::State& smoke, const View& view) {
  const smoke::Grid& grid = smoke.grid;
  for (double m = step_m; m < farthest_sight_m; m += step_m) {
    const Vec3 at = glm::floor(grid.grid_from_world(view.bent(view.line.from_m + m * view.line.direction)));
    const int i = static_cast<int>(at.x), j = static_cast<int>(at.y), k = static_cast<int>(at.z);
    if (grid.inside(i, j, k) && grid.wall[static_cast<std::size_t>(grid.index(i, j, k))] != 0) return m;
  }
  return farthest_sight_m;
}

/// What one driver sees.
struct DriverSight {
  double reflecting_m = farthest_sight_m, shining_m = farthest_sight_m;
  double road_m = farthest_sight_m;  ///< Of the road, or to a vehicle that shines: from the front bumper on.
  Ahead nearest;
  double transmittance = 1.0;  ///< To the nearest vehicle, or wall.
  double wall_m = farthest_sight_m;
};

DriverSight look(const Model& model, const State& state, const std::vector<Participant>& participants, const Air& air,
                 const Participant& driver) {
  const View view = view_of(model, driver);
  DriverSight seen;
  seen.nearest = nearest_ahead(participants, driver, view);
  if (air.smoke) seen.wall_m = wall_m(*air.smoke, view);
  const double end_m = std::min(seen.nearest.away_m, seen.wall_m);

  sight::Wake wake;
  double thins_m = 1.0;
  if (const Participant* vehicle = seen.nearest.vehicle) {
    const ParticipantKind kind = vehicle_models()[vehicle->model].kind;
    const double mps = glm::length(vehicle->velocity_mps);
    wake = sight::spray_wake(kind == ParticipantKind::lorry || kind == ParticipantKind::bus, mps,
                             state.scenario.environment.road_wetness);
    thins_m = std::max(1.0, mps * wake.thins_s);
  }
  const auto extinction_per_m = [&](const Vec3& straight_m) {
    double per_m = air.per_m;
    if (air.smoke) per_m += smoke::extinction_per_m(*air.smoke, view.bent(straight_m));
    const double behind_m = seen.nearest.away_m - glm::dot(straight_m - view.line.from_m, view.line.direction);
    if (wake.depth > 0.0 && behind_m > 0.0) per_m += wake.depth / thins_m * std::exp(-behind_m / thins_m);
    return per_m;
  };
  const auto seen_m = [&](const auto& is_seen) {
    return sight::seen_m(view.line, farthest_sight_m, step_m, extinction_per_m, is_seen);
  };
  const bool beams = has_beams(driver);
  const double lit_lx = view.roofed ? sight::full_light_lx : air.natural_lx;
  seen.reflecting_m = seen_m([&](double depth, double m) {
    return sight::sees_reflecting(depth, lit_lx + (beams ? sight::dipped_light_lx(m, depth) : 0.0));
  });
  seen.shining_m = seen_m([](double depth, double) { return depth <= sight::shining_depth; });
  double road_m = seen_m([](double depth, double) { return depth <= sight::reflecting_depth; });
  seen.transmittance = sight::transmittance(view.line, end_m, step_m, extinction_per_m);
  if (seen.nearest.vehicle && shines(state, *seen.nearest.vehicle) && seen.nearest.away_m <= seen.shining_m)
    road_m = std::max(road_m, seen.nearest.away_m);
  if (road_m < farthest_sight_m) seen.road_m = std::max(0.0, road_m - view.bonnet_m);
  return seen;
}

void note(const DriverSight& seen, ParticipantId driver, std::vector<Event>& events) {
  std::string detail =
      fmt::format("reflecting_m={:.1f} shining_m={:.1f} road_m={:.1f}", seen.reflecting_m, seen.shining_m, seen.road_m);
  const bool wall = seen.wall_m < seen.nearest.away_m;
  if (wall)
    detail += fmt::format(" wall_m={:.1f} transmittance={:.2g}", seen.wall_m, seen.transmittance);
  else if (seen.nearest.vehicle)
    detail += fmt::format(" vehicle={} vehicle_m={:.1f} transmittance={:.2g}", seen.nearest.vehicle->id,
                          seen.nearest.away_m, seen.transmittance);
  events.push_back({"visibility", driver, std::move(detail)});
}

}  // namespace

void look_through_air(const Model& model, const std::vector<Participant>& participants, State& state,
                      std::vector<Event>& events) {
  if (state.tick % look_ticks != 0) return;
  state.sights.clear();
  const Air air = air_of(state);
  const bool notes = state.tick % static_cast<Tick>(tick_rate_hz) == 0;
  for (const Participant& driver : participants) {
    if (driver.id != driver_participant && driver.id < first_traffic_participant) continue;
    if (is_solid(driver.id) || !may_be_limited(air, driver)) continue;
    const DriverSight seen = look(model, state, participants, air, driver);
    if (seen.road_m >= farthest_sight_m) continue;
    state.sights.push_back({driver.id, seen.road_m});
    if (notes) note(seen, driver.id, events);
  }
}

std::optional<EffectKeyframe> sight_keyframe(const State& state) {
  if (state.sights.empty()) return std::nullopt;
  EffectKeyframe keyframe;
  keyframe.id = limited_sight_effect_id;
  keyframe.kind = limited_sight_keyframe_kind;
  keyframe.data = encode_limited_sights(state.sights);
  keyframe.tick = state.tick - state.tick % look_ticks;
  return keyframe;
}

}  // namespace septet::simulation
