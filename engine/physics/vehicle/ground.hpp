#pragma once
/// Ground under the wheels in the vehicle's terms: one plane and one friction coefficient under each wheel, and the
/// edges of steps (kerbs) where they are near.
///
/// The road's owner fills a `Ground` from `wheel_centres_m` (vehicle.hpp): at every sub-step where the road is rough
/// (ISO 8608 class A excites a car at 130 km/h up to 100 Hz), once a tick where it is smooth. Friction belongs to the
/// wheel and not to the car, so a patch of ice under one wheel and a road that is wet on one side need nothing further.

#include <array>
#include <cstdint>
#include <optional>

#include "engine/math/rigid_transform.hpp"

namespace septet::vehicle {

/// Wheels are counted front left, front right, rear left, rear right, here and in the snapshot.
inline constexpr int wheel_count = 4;

/// Top of a step of the ground.
struct StepEdge {
  Vec3 point_m{0.0};           ///< Where the wheel's path crosses it, world frame.
  Vec3 across{1.0, 0.0, 0.0};  ///< Level unit vector square to the edge, world frame.
};

struct WheelGround {
  Vec3 point_m{0.0};           ///< A point of the surface near the contact, world frame.
  Vec3 normal{0.0, 0.0, 1.0};  ///< Unit length, world frame.
  /// Steps that the wheel comes to and leaves. The wheel stands on whatever it presses deepest, plane or edge: so it
  /// meets a kerb before its centre is over it, and climbs it along its own roundness (rigid ring enveloping: Zegelaar
  /// 1998, The dynamic response of tyres to brake torque variations and road unevennesses, ch. 4).
  std::array<std::optional<StepEdge>, 2> edges;
  bool yields = false;              ///< Gives way before a rim does: debris.
  double friction = 0.9;            ///< Peak friction coefficient of this surface; dry asphalt is 0.9.
  double rolling_resistance = 1.0;  ///< Multiplies the tyre's rolling resistance: 1 asphalt, about 5 loose snow.
};
using Ground = std::array<WheelGround, wheel_count>;

/// The same level surface under all wheels.
Ground level_ground(double height_m = 0.0, double friction = 0.9);

enum class SurfaceKind : std::uint8_t { dry, wet, snow, ice };

/// Peak friction coefficient of a surface at a temperature of the surface. Dry 0.9 and wet 0.55 are the upper half of
/// the ranges 0.70–0.90 and 0.45–0.60 of accident reconstruction tables; packed snow rises from 0.22 at 0 °C to 0.35 in
/// deep frost (Noon 1994: 0.20–0.25; tables 0.25–0.35). Ice is most slippery at its melting point: between −5 and 0 °C
/// the tyre's pressure melts a film of water on it, colder it is a dry, micro-rough surface (tirestesting.com,
/// subjective ice condition): 0.06 at 0 °C, 0.10 at −5 °C, 0.15 at −20 °C (tables of ice: 0.05–0.15, bohnenkamp.by; the
/// values at the temperatures are derived from these two). Above 0 °C snow and ice keep their value at 0 °C.
double peak_friction(SurfaceKind kind, double temperature_k);

/// Peak friction coefficient of a surface with a measured or requested coefficient of its own: that of a dry one holds
/// when it is dry and changes with the weather as our dry asphalt does; that of wet ground, snow and ice holds at
/// `reference_surface_k` and changes with temperature as ours does.
inline constexpr double reference_surface_k = 268.15;
double given_friction(SurfaceKind kind, double coefficient, double wetness, double snow_cover, double temperature_k);

/// Friction of a road that is `wetness` wet and `snow_cover` covered (both 0 to 1; Environment of
/// the snapshot). A wet road below −1 °C freezes over.
double weather_friction(double wetness, double snow_cover, double temperature_k);

}  // namespace septet::vehicle
