#include "sim-client/sight/pair_sight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace septet::sight {
namespace {

/// Way along a line at which the glass of the mirror itself no longer counts.
constexpr double off_the_glass_m = 0.02;

/// Line as the mirror sends it on.
struct Reflected {
  Line to_glass;
  double glass_m = 0.0;
  Line onward;
};

std::optional<Reflected> reflected(const Vec3& eye_m, const RigidTransform& world_from_vehicle, const Mirror& mirror,
                                   double across_m, double upward_m) {
  const Vec3 at_m = world_from_vehicle * (mirror.middle_m + across_m * mirror.right + upward_m * mirror.up);
  const Vec3 normal = world_from_vehicle.orientation * mirror.normal_at(across_m, upward_m);
  Reflected line;
  line.glass_m = glm::length(at_m - eye_m);
  if (!(line.glass_m > 0.0)) return std::nullopt;
  line.to_glass = {eye_m, (at_m - eye_m) / line.glass_m};
  const double facing = glm::dot(line.to_glass.direction, normal);
  if (facing >= 0.0) return std::nullopt;
  line.onward = {at_m, glm::normalize(line.to_glass.direction - 2.0 * facing * normal)};
  return line;
}

}  // namespace

Sight straight_sight(const ObservedWorld& world, const Participant& target, const RasterSettings& settings) {
  return look(Raster(world.eye_m(), box_around(target), settings.longer_side),
              [&](const Line& line) { return world.along(line, target.id); });
}

std::vector<MirrorSight> mirror_sights(const ObservedWorld& world, const Participant& observer,
                                       const std::vector<Mirror>& mirrors, const Participant& target,
                                       const RasterSettings& settings) {
  std::vector<MirrorSight> sights;
  const BoxInTheWay box(box_around(target));
  for (const Mirror& mirror : mirrors) {
    const double step_m = 2.0 * mirror.half_width_m / settings.mirror_across;
    const auto rows = static_cast<std::uint32_t>(std::max(1.0, std::round(2.0 * mirror.half_height_m / step_m)));
    Sight sight;
    double passed = 0.0;
    for (std::uint32_t y = 0; y < rows; ++y)
      for (std::uint32_t x = 0; x < settings.mirror_across; ++x) {
        const auto line =
            reflected(world.eye_m(), observer.world_from_vehicle, mirror, (x + 0.5) * step_m - mirror.half_width_m,
                      (y + 0.5) * 2.0 * mirror.half_height_m / rows - mirror.half_height_m);
        if (!line || !box.entry_m(line->onward)) continue;
        const OnLine met = world.along(line->onward, target.id, off_the_glass_m);
        if (!met.meets_target) continue;
        if (sight.silhouette++ == 0 || met.target_m < sight.nearest_m) sight.nearest_m = met.target_m;
        const double cosine =
            -glm::dot(line->to_glass.direction, observer.world_from_vehicle.orientation * mirror.normal());
        sight.solid_angle_sr += step_m * 2.0 * mirror.half_height_m / rows * cosine / (line->glass_m * line->glass_m);
        if (!(met.transmittance > 0.0)) continue;
        const double to_glass = world.transmittance(line->to_glass, std::max(0.0, line->glass_m - off_the_glass_m));
        if (!(to_glass > 0.0)) continue;
        ++sight.unobstructed;
        passed += met.transmittance * to_glass;
      }
    if (sight.silhouette == 0) continue;
    if (sight.unobstructed) sight.transmittance = passed / sight.unobstructed;
    sights.push_back({mirror.name, sight});
  }
  return sights;
}

}  // namespace septet::sight
