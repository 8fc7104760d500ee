#include "engine/physics/vehicle/ground.hpp"

#include <algorithm>

#include "engine/physics/vehicle/table.hpp"

namespace septet::vehicle {
namespace {
constexpr double freezing_k = 273.15;
constexpr double dry_friction = 0.9;
constexpr double wet_friction = 0.55;
// Over degrees Celsius.
constexpr Table snow_friction{{-20.0, -5.0, 0.0}, {0.35, 0.28, 0.22}, 3};
constexpr Table ice_friction{{-20.0, -5.0, 0.0}, {0.15, 0.10, 0.06}, 3};
}  // namespace

Ground level_ground(double height_m, double friction) {
  Ground ground;
  for (WheelGround& wheel : ground) {
    wheel.point_m = Vec3(0.0, 0.0, height_m);
    wheel.friction = friction;
  }
  return ground;
}

double peak_friction(SurfaceKind kind, double temperature_k) {
  const double celsius = temperature_k - freezing_k;
  switch (kind) {
    case SurfaceKind::dry:
      return dry_friction;
    case SurfaceKind::wet:
      return wet_friction;
    case SurfaceKind::snow:
      return snow_friction.held(celsius);
    case SurfaceKind::ice:
      return ice_friction.held(celsius);
  }
  return dry_friction;
}

double given_friction(SurfaceKind kind, double coefficient, double wetness, double snow_cover, double temperature_k) {
  if (kind == SurfaceKind::dry)
    return coefficient * weather_friction(wetness, snow_cover, temperature_k) / dry_friction;
  return coefficient * peak_friction(kind, temperature_k) / peak_friction(kind, reference_surface_k);
}

double weather_friction(double wetness, double snow_cover, double temperature_k) {
  wetness = std::clamp(wetness, 0.0, 1.0);
  snow_cover = std::clamp(snow_cover, 0.0, 1.0);
  const SurfaceKind film = temperature_k < freezing_k - 1.0 ? SurfaceKind::ice : SurfaceKind::wet;
  const double bare = dry_friction + wetness * (peak_friction(film, temperature_k) - dry_friction);
  return bare + snow_cover * (peak_friction(SurfaceKind::snow, temperature_k) - bare);
}

}  // namespace septet::vehicle
