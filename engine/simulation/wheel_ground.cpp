#include "engine/simulation/wheel_ground.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/road/road_locate.hpp"
#include "engine/road/surface_material.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/simulation/ground_faces.hpp"

namespace septet::simulation {
namespace {

constexpr double near_m = 60.0;  ///< Distance from a road to which its surface extends.

vehicle::SurfaceKind kind_of(const road::SurfaceMaterial& material) {
  if (material.surface == "ice") return vehicle::SurfaceKind::ice;
  if (material.surface == "snow") return vehicle::SurfaceKind::snow;
  return material.surface == "wet" ? vehicle::SurfaceKind::wet : vehicle::SurfaceKind::dry;
}

double ground_height_m(const roadside::RaisedAreas* raised, const Vec2& at, double road_z_m) {
  return raised ? raised->ground_at(at, road_z_m) : road_z_m;
}

}  // namespace

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
      road::surface_at(roads, {centre_m.x, centre_m.y}, has_place ? &place : nullptr, near_m, centre_m.z);
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

void find_kerb(const road::RoadNetwork& roads, const roadside::RaisedAreas* raised, const Vec3& centre_m,
               const Vec2& ahead, double radius_m, const road::RoadPosition& place, vehicle::WheelGround& wheel,
               double way_m) {
  const double reach_m = radius_m + way_m;
  constexpr double noticed_m = 0.03;  // A lower step is a bump: the plane under the wheel jumps by it.
  const bool near = raised && raised->is_near(centre_m, std::min(radius_m, 1.0));
  if (!near && !may_step(roads.roads[place.road], place.s_m, reach_m)) return;
  const auto height_m = [&](const Vec2& at) -> std::optional<double> {
    const auto surface = road::surface_at(roads, at, &place, near_m, centre_m.z);
    if (!surface) return std::nullopt;
    return near ? ground_height_m(raised, at, surface->height_m) : surface->height_m;
  };
  // Height of the ground there over the plane under the wheel.
  const auto rise_m = [&](double ahead_m) {
    const Vec2 at = Vec2(centre_m) + ahead_m * ahead;
    const auto height = height_m(at);
    if (!height) return 0.0;
    const Vec2 away = at - Vec2(wheel.point_m);
    return *height - (wheel.point_m.z - glm::dot(Vec2(wheel.normal), away) / wheel.normal.z);
  };
  for (const double towards_m : {reach_m, -radius_m}) {
    // A kerb stone is narrower than a wheel, a lane is not.
    const int looks = near ? static_cast<int>(std::ceil(4.0 * std::abs(towards_m) / radius_m - 1e-9)) : 1;
    double low_m = 0.0, high_m = 0.0;
    int look = 1;
    for (; look <= looks; ++look) {
      high_m = towards_m * look / looks;
      if (rise_m(high_m) >= noticed_m) break;
      low_m = high_m;
    }
    if (look > looks) continue;
    for (int halving = 0; halving < 9; ++halving) {  // To a millimetre.
      const double middle_m = 0.5 * (low_m + high_m);
      (rise_m(middle_m) < noticed_m ? low_m : high_m) = middle_m;
    }
    if (rise_m(high_m) - rise_m(low_m) < noticed_m) continue;  // A ramp.
    const Vec2 at = Vec2(centre_m) + high_m * ahead;
    wheel.edge_m = Vec3(at, *height_m(at));
    return;
  }
}

}  // namespace septet::simulation
