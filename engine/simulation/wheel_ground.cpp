#include "engine/simulation/wheel_ground.hpp"

#include <algorithm>
#include <optional>

#include "engine/road/road_locate.hpp"
#include "engine/road/surface_material.hpp"
#include "engine/roadside/ground_beside.hpp"

namespace septet::simulation {
namespace {

vehicle::SurfaceKind kind_of(const road::SurfaceMaterial& material) {
  if (material.surface == "ice") return vehicle::SurfaceKind::ice;
  if (material.surface == "snow") return vehicle::SurfaceKind::snow;
  return material.surface == "wet" ? vehicle::SurfaceKind::wet : vehicle::SurfaceKind::dry;
}

double ground_height_m(const roadside::RaisedAreas* raised, const Vec2& at, double road_z_m) {
  return raised ? raised->ground_at(at, road_z_m) : road_z_m;
}

}  // namespace

RoadWeather road_weather(const State& state) {
  const Environment& sky = state.scenario.environment;
  return {sky.road_wetness,        sky.snow_cover,
          sky.temperature_k,       state.scenario.friction_scale,
          state.effects.ice.black, state.effects.ice.still.thawed_kh};
}

double surface_friction(const road::SurfaceMaterial* material, const RoadWeather& weather) {
  const auto kind = material ? kind_of(*material) : vehicle::SurfaceKind::dry;
  double friction = 0.0;
  if (material && material->friction > 0.0)
    friction =
        vehicle::given_friction(kind, material->friction, weather.wetness, weather.snow_cover, weather.temperature_k);
  else if (kind == vehicle::SurfaceKind::dry)
    friction = vehicle::weather_friction(weather.wetness, weather.snow_cover, weather.temperature_k);
  else
    friction = vehicle::peak_friction(kind, weather.temperature_k);
  return friction * weather.friction_scale;
}

std::optional<double> find_wheel_ground(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised,
                                        const RoadWeather& weather, const Vec3& centre_m, bool has_place,
                                        road::RoadPosition& place, vehicle::WheelGround& wheel) {
  const auto surface =
      road::surface_at(roads, {centre_m.x, centre_m.y}, has_place ? &place : nullptr, surface_reach_m, centre_m.z);
  if (!surface) return std::nullopt;
  place = surface->position;
  wheel.point_m = {centre_m.x, centre_m.y, ground_height_m(raised, centre_m, surface->height_m)};
  wheel.normal = surface->normal;
  wheel.friction = surface_friction(road::material_at(roads, place), weather);
  const auto covers = [&](const BlackIce& ice) { return is_iced(roads, ice, weather.thawed_kh, place); };
  if (std::ranges::any_of(weather.black_ice, covers))
    wheel.friction = weather.friction_scale * vehicle::peak_friction(vehicle::SurfaceKind::ice, weather.temperature_k);
  return surface->outside_m;
}

void find_land(const road::RoadNetwork& roads, const roadside::Terrain& terrain, const RoadWeather& weather,
               const Vec3& centre_m, const road::RoadPosition* place, vehicle::WheelGround& wheel) {
  const roadside::GroundBeside land = roadside::ground_beside(roads, terrain, Vec2(centre_m), place, centre_m.z);
  const roadside::GroundCover& grass = roadside::meadow();
  wheel.point_m = Vec3(Vec2(centre_m), land.height_m);
  wheel.normal = land.normal;
  wheel.friction =
      weather.friction_scale * vehicle::given_friction(vehicle::SurfaceKind::dry, grass.friction, weather.wetness,
                                                       weather.snow_cover, weather.temperature_k);
  wheel.rolling_resistance = grass.rolling_resistance;
}

}  // namespace septet::simulation
