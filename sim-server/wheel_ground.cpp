#include "sim-server/wheel_ground.hpp"

#include "engine/road/road_locate.hpp"
#include "engine/road/surface_material.hpp"

namespace septet::server {
namespace {

constexpr double near_m = 60.0;  ///< How far from a road its surface goes on.

vehicle::SurfaceKind kind_of(const road::SurfaceMaterial& material) {
  if (material.surface == "ice") return vehicle::SurfaceKind::ice;
  if (material.surface == "snow") return vehicle::SurfaceKind::snow;
  return material.surface == "wet" ? vehicle::SurfaceKind::wet : vehicle::SurfaceKind::dry;
}

}  // namespace

double surface_friction(const road::SurfaceMaterial* material, const RoadWeather& weather) {
  const auto kind = material ? kind_of(*material) : vehicle::SurfaceKind::dry;
  double friction = 0.0;
  if (material && material->friction > 0.0)
    friction = vehicle::given_friction(kind, material->friction, weather.wetness, weather.snow_cover, weather.temperature_k);
  else if (kind == vehicle::SurfaceKind::dry)
    friction = vehicle::weather_friction(weather.wetness, weather.snow_cover, weather.temperature_k);
  else
    friction = vehicle::peak_friction(kind, weather.temperature_k);
  return friction * weather.friction_scale;
}

bool find_wheel_ground(const road::RoadNetwork& roads, const RoadWeather& weather, const Vec3& centre_m, bool has_place,
                       road::RoadPosition& place, vehicle::WheelGround& wheel) {
  const auto surface = road::surface_at(roads, {centre_m.x, centre_m.y}, has_place ? &place : nullptr, near_m);
  if (!surface) return false;
  place = surface->position;
  wheel.point_m = {centre_m.x, centre_m.y, surface->height_m};
  wheel.normal = surface->normal;
  wheel.friction = surface_friction(road::material_at(roads, place), weather);
  return true;
}

}  // namespace septet::server
