#include "engine/simulation/effects/fire_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/tunnel_shape.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::simulation {
namespace {

constexpr double cell_m = 1.0;
/// In open air: length of the box either way. In a tunnel: the farthest from the fire, less where the box would have
/// more cells than `most_tube_cells` because the tube bends.
constexpr double open_reach_m = 110.0, tube_reach_m = 800.0;
constexpr int most_tube_cells = 500'000;
/// Limit of all smoke together, beside the debris' limit: net::max_tick_bytes holds both.
constexpr std::size_t most_keyframe_bytes = 140 * 1024;

/// Soot grows over minutes: once a second is often enough.
constexpr std::uint64_t soot_interval_steps = 60;

/// Height of the tube's inside over the road at t; none outside of it. `left`: the tube with positive t.
double clear_height_m(const road::Road& road, double s_m, double t_m, bool left) {
  using namespace roadside::tunnel_shape;
  const road::RoadExtent extent = road::road_extent(road, s_m);
  const double from_middle = left ? t_m : -t_m;
  const double to_wall = (left ? extent.left_t_m : -extent.right_t_m) + wall_clear_m - from_middle;
  if (from_middle < middle_wall_m || to_wall < 0.0) return 0.0;
  return to_wall < haunch_width_m ? std::lerp(haunch_m, ceiling_m, to_wall / haunch_width_m) : ceiling_m;
}

RigidTransform lower_corner(const RigidTransform& place, int ny) {
  return {place * Vec3(-open_reach_m, -0.5 * ny * cell_m, -0.5), place.orientation};
}

/// Seat of the fire: over the bonnet of a car, at the front of the load of anything bigger.
Vec3 seat_of_fire(const Participant& vehicle) {
  const VehicleModel model = shape_of(vehicle);
  return vehicle.world_from_vehicle * Vec3(model.front_m() - 0.25 * model.length_m, 0.0, 0.85 * model.height_m);
}

/// Emissions of a burning vehicle; values and sources in fires.toml.
struct Power {
  double first_mw = 0.0, growth_mwps = 0.0, full_mw = 0.0;
  double radiated_share = 0.0, soot_yield = 0.0, combustion_mjpkg = 1.0, extinction_m2pg = 0.0;
  double births_per_s = 0.0;  ///< At full power.

  double full_extinction_m2ps() const { return full_mw / combustion_mjpkg * 1000.0 * soot_yield * extinction_m2pg; }
};
struct Source {
  double radius_m = 0.0, heat = 0.0, cooling_s = 10.0, sinking = 0.0, lifetime_s = 0.0;
  std::array<float, 3> albedo{};
  double extinction_area_m2 = 0.0, glow = 0.0;
  double height_m = 0.0;  ///< Over the seat of the fire.
  double first_rate_per_s = 0.0, growth_per_s2 = 0.0, full_rate_per_s = 0.0;
  Power power{};  ///< Where it has any, rates and cross-sections are those of its soot.
};
namespace sources {
#define SEPTET_ENTRY(name, ...) constexpr Source name __VA_ARGS__;
#include "engine/simulation/effects/fires.toml.inc"
}  // namespace sources

smoke::Emitter emitter_of(const Source& source, const Vec3& seat_m) {
  smoke::Emitter emitter;
  emitter.position_m = seat_m + Vec3(0.0, 0.0, source.height_m);
  emitter.radius_m = source.radius_m;
  emitter.heat = source.heat;
  emitter.cooling_s = source.cooling_s;
  emitter.sinking = source.sinking;
  emitter.lifetime_s = source.lifetime_s;
  emitter.albedo = source.albedo;
  emitter.extinction_area_m2 = source.extinction_area_m2;
  emitter.glow = source.glow;
  if (const Power& power = source.power; power.births_per_s > 0.0) {
    emitter.extinction_area_m2 = power.full_extinction_m2ps() / power.births_per_s;
    emitter.warmth_j = (1.0 - power.radiated_share) * power.full_mw * 1e6 / power.births_per_s;
  }
  return emitter;
}

void add_fire(const Participant& vehicle, FireState& state) {
  if (state.smoke->emitters.size() + 2 > smoke::max_emitters) return;
  const Vec3 seat_m = seat_of_fire(vehicle);
  state.fires.push_back({vehicle.id, state.smoke->emitters.size(), state.smoke->emitters.size() + 1, 0.0, true});
  for (const Source& source : {sources::flames, sources::soot})
    state.smoke->emitters.push_back(emitter_of(source, seat_m));
}

double rate_per_s(const Source& source, double burning_s) {
  const auto grown = [&](double first, double growth, double full) {
    return std::min(full, first + growth * burning_s);
  };
  if (const Power& power = source.power; power.births_per_s > 0.0)
    return grown(power.first_mw, power.growth_mwps, power.full_mw) / power.full_mw * power.births_per_s;
  return grown(source.first_rate_per_s, source.growth_per_s2, source.full_rate_per_s);
}

void burn(const Fire& fire, const Source& source, const std::optional<Vec3>& seat_m, smoke::Emitter& emitter) {
  emitter.rate_per_s = fire.burning ? rate_per_s(source, fire.burning_s) : 0.0;
  if (seat_m) emitter.position_m = *seat_m + Vec3(0.0, 0.0, source.height_m);
}

void feed(const std::vector<Participant>& participants, double step_s, FireState& state) {
  for (Fire& fire : state.fires) {
    fire.burning_s += step_s;
    const auto vehicle = std::ranges::find(participants, fire.vehicle, &Participant::id);
    const std::optional<Vec3> seat_m =
        vehicle == participants.end() ? std::nullopt : std::optional(seat_of_fire(*vehicle));
    burn(fire, sources::flames, seat_m, state.smoke->emitters[fire.flames]);
    burn(fire, sources::soot, seat_m, state.smoke->emitters[fire.smoke]);
  }
}

std::vector<smoke::Obstacle> obstacles_in(const smoke::Grid& grid, const std::vector<Participant>& participants) {
  std::vector<smoke::Obstacle> obstacles;
  for (const Participant& participant : participants) {
    const Vec3 at = grid.grid_from_world(participant.world_from_vehicle.position_m);
    if (!(at.x > -12.0 && at.y > -4.0 && at.x < grid.nx + 12.0 && at.y < grid.ny + 4.0 && std::abs(at.z) < grid.nz))
      continue;
    const debris::Box box = body_box(participant);
    obstacles.push_back({box.world_from_box, box.half_size_m});
  }
  return obstacles;
}

/// A box along the chord of the tube around a place in it.
smoke::Grid tube_box(const road::RoadNetwork& roads, const road::RoadPosition& at, const road::RoadStructure& tunnel) {
  constexpr double beside_m = 3.0, below_m = 0.5, step_m = 10.0;
  const double end_m = tunnel.s_m + tunnel.length_m;
  for (double reach_m = tube_reach_m;; reach_m *= 0.8) {
    const double from_m = std::max(tunnel.s_m, at.s_m - reach_m), to_m = std::min(end_m, at.s_m + reach_m);
    const auto middle = [&](double s_m) {
      const road::RoadExtent extent = road::road_extent(roads.roads[at.road], s_m);
      return road::evaluate(roads, {at.road, s_m, 0.5 * (at.t_m > 0.0 ? extent.left_t_m : extent.right_t_m)})
          .position_m;
    };
    const Vec3 chord = middle(to_m) - middle(from_m);
    const RigidTransform along{
        middle(from_m),
        orientation_from_angles(std::atan2(chord.y, chord.x), -std::atan2(chord.z, std::hypot(chord.x, chord.y)), 0.0)};
    Vec3 low(0.0), high(glm::length(chord), 0.0, 0.0);
    for (double s_m = from_m; s_m <= to_m; s_m += step_m) {
      const road::RoadExtent extent = road::road_extent(roads.roads[at.road], s_m);
      const double half_m = 0.5 * (at.t_m > 0.0 ? extent.left_t_m : -extent.right_t_m) + beside_m;
      const Vec3 seen = inverse(along) * middle(s_m);
      low = glm::min(low, seen - Vec3(0.0, half_m, below_m));
      high = glm::max(high, seen + Vec3(0.0, half_m, roadside::tunnel_shape::ceiling_m + below_m));
    }
    const auto cells = [](double metres) { return static_cast<int>(std::ceil(metres / cell_m)); };
    const Vec3 size = high - low;
    const int nx = cells(high.x), ny = cells(size.y), nz = cells(size.z);
    if (std::int64_t{nx} * ny * nz > most_tube_cells && reach_m > open_reach_m) continue;
    return smoke::make_grid({along * Vec3(0.0, low.y, low.z), along.orientation}, cell_m, nx, ny, nz,
                            smoke::open_x_low | smoke::open_x_high);
  }
}

/// Walls beside and over the tube, floor under it: the road's surface is looked up once for a column.
void add_tube_walls(const road::RoadNetwork& roads, const road::RoadPosition& at, const road::RoadStructure& tunnel,
                    smoke::Grid& grid) {
  road::RoadPosition hint = at;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const Vec3 middle = grid.world_from_cells({i + 0.5, j + 0.5, 0.5 * grid.nz});
      const auto surface = road::surface_at(roads, {middle.x, middle.y}, &hint, 60.0);
      if (surface) hint = surface->position;
      const bool inside = hint.s_m >= tunnel.s_m && hint.s_m <= tunnel.s_m + tunnel.length_m;
      const double clear_m = !inside ? 1e9 : clear_height_m(roads.roads[hint.road], hint.s_m, hint.t_m, at.t_m > 0.0);
      for (int k = 0; k < grid.nz; ++k) {
        const double height = surface ? grid.world_from_cells({i + 0.5, j + 0.5, k + 0.5}).z - surface->height_m : 0.0;
        if (!surface || height < 0.0 || height > clear_m) grid.wall[grid.index(i, j, k)] = 1;
      }
    }
}

}  // namespace

smoke::Grid grid_around(const road::RoadNetwork& roads, const RigidTransform& world_from_vehicle) {
  const Vec3& at = world_from_vehicle.position_m;
  const auto place = road::locate(roads, {at.x, at.y}, nullptr, 60.0);
  const road::RoadStructure* tunnel = place ? road::structure_at(roads.roads[place->position.road], place->position.s_m,
                                                                 road::RoadStructure::Kind::tunnel)
                                            : nullptr;
  if (!tunnel) {
    constexpr int nx = static_cast<int>(2.0 * open_reach_m / cell_m);
    constexpr int ny = 48, nz = 40;
    constexpr std::uint8_t open =
        smoke::open_x_low | smoke::open_x_high | smoke::open_y_low | smoke::open_y_high | smoke::open_z_high;
    RigidTransform corner = lower_corner(world_from_vehicle, ny);
    corner.position_m.z += 0.5;  // Without a roof the road is the grid's floor.
    return smoke::make_grid(corner, cell_m, nx, ny, nz, open);
  }
  smoke::Grid grid = tube_box(roads, place->position, *tunnel);
  add_tube_walls(roads, place->position, *tunnel, grid);
  return grid;
}

void ignite(const road::RoadNetwork& roads, const Participant& vehicle, std::uint64_t seed, FireState& state) {
  if (std::ranges::find(state.fires, vehicle.id, &Fire::vehicle) != state.fires.end()) return;
  if (!state.smoke) {
    smoke::Parameters parameters;
    parameters.roof_mirrors = true;
    parameters.speed_cells_per_s = 8.0;  // Smoke that is not warm any more spreads no faster than air mixes.
    state.smoke = smoke::make_smoke(grid_around(roads, vehicle.world_from_vehicle), {}, seed, 20'000, parameters);
  }
  add_fire(vehicle, state);
}

void extinguish(ParticipantId vehicle, FireState& state) {
  for (Fire& fire : state.fires)
    if (fire.vehicle == vehicle) fire.burning = false;
}

void advance_fires(const std::vector<Participant>& participants, const Environment& environment, Tick tick,
                   double time_s, double step_s, FireState& state) {
  if (!state.smoke) return;
  state.smoke->time_s = time_s - step_s;
  feed(participants, step_s, state);
  const Vec3 wind = environment.wind_speed_mps *
                    Vec3(std::cos(environment.wind_direction_rad), std::sin(environment.wind_direction_rad), 0.0);
  const smoke::Grid& grid = state.smoke->grid;
  // In a tube only the wind along its axis blows, and is weaker.
  const Vec3 axis = grid.world_from_grid.orientation * Vec3(1.0, 0.0, 0.0);
  const bool tube = (grid.open_faces & smoke::open_z_high) == 0;
  smoke::advance_smoke(*state.smoke, tube ? 0.4 * glm::dot(wind, axis) * axis : wind, obstacles_in(grid, participants),
                       step_s);

  std::vector<EffectKeyframe> keyframes = smoke::advance_keyframes(state.track, *state.smoke);
  std::size_t bytes = 0;
  auto old = state.keyframes.begin();
  for (EffectKeyframe& keyframe : keyframes) {
    while (old != state.keyframes.end() && old->id < keyframe.id) ++old;
    const bool same = old != state.keyframes.end() && old->id == keyframe.id && old->data == keyframe.data;
    keyframe.tick = same ? old->tick : tick;
    bytes += keyframe.data.size();
  }
  while (bytes > most_keyframe_bytes) {
    bytes -= keyframes.back().data.size();
    keyframes.pop_back();
  }
  if (state.smoke->tick % soot_interval_steps == 0)
    if (Bytes soot = smoke::encode_soot(*state.smoke); !soot.empty() && soot != state.soot.data)
      state.soot = {smoke::soot_effect_id, smoke::soot_kind, std::move(soot), tick};
  if (!state.soot.data.empty()) keyframes.insert(keyframes.begin(), state.soot);
  state.keyframes = std::move(keyframes);
}

}  // namespace septet::simulation
