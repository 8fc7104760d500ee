#include "engine/render/passes/precipitation_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/render/passes/billboards.hpp"
#include "engine/render/passes/draw_list.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

constexpr double box_m = 12.0, shutter_s = 1.0 / 60.0, freezing_rain_k = 274.65;
constexpr double most_streaks = 1500.0;

/// True inside the driver's own car, where neither rain nor snow falls.
bool in_car(const Vec3& car_m) { return car_m.x > -1.4 && car_m.x < 4.2 && std::abs(car_m.y) < 1.05 && car_m.z < 1.6; }

}  // namespace

std::vector<StreakRecord> streak_records(const Instant& instant, const FrameView& view, const Vec3& eye_m) {
  const Environment& environment = instant.environment;
  if (environment.rain_mm_per_h <= 0.0 || instant.share_of_sky < 0.5f) return {};
  const bool snow = environment.temperature_k < freezing_rain_k;
  const auto count = static_cast<int>(std::min(most_streaks, 250.0 + 125.0 * environment.rain_mm_per_h));
  const Vec3 wind = environment.wind_speed_mps *
                    Vec3(std::cos(environment.wind_direction_rad), std::sin(environment.wind_direction_rad), 0.0);
  const glm::vec3 light =
      (instant.light->sky_irradiance + instant.light->ground_irradiance + 0.3f * instant.light->light_irradiance) /
      (2.0f * std::numbers::pi_v<float>);
  const RigidTransform car_from_world = inverse(view.world_from_car);
  const ViewVolume volume = view_volume(view);
  Random random(1);
  std::vector<StreakRecord> records;
  for (int i = 0; i < count; ++i) {
    const Vec3 start = box_m * Vec3(random.uniform(), random.uniform(), random.uniform());
    const double size_m = (snow ? random.uniform(4.0, 9.0) : random.uniform(1.0, 3.0)) * 1e-3;
    const double fall_mps = snow ? 1.0 + 60.0 * size_m : 9.65 - 10.3 * std::exp(-600.0 * size_m);
    const Vec3 velocity = wind - Vec3(0, 0, fall_mps);
    Vec3 at = start + velocity * instant.simulated_time_s - eye_m;
    at = at - box_m * glm::floor(at / box_m) - 0.5 * box_m;
    const double distance_m = glm::length(at);
    const Vec3 along = (velocity - view.velocity_mps) * shutter_s;
    if (distance_m < 0.7 || distance_m > 0.5 * box_m || in_car(car_from_world * (eye_m + at)) ||
        !intersects(volume, glm::vec3(at), static_cast<float>(glm::length(along))))
      continue;
    const double share = size_m / (size_m + glm::length(along));
    const double fade = std::min(1.0, (0.5 * box_m - distance_m) / 1.5);
    records.push_back({glm::vec4(at - 0.5 * along, size_m),
                       glm::vec4(along, std::min(1.0, (snow ? 10.0 : 40.0) * share) * fade),
                       glm::vec4(light * (snow ? 0.9f : 0.8f), 0.0f)});
  }
  return records;
}

void create_precipitation_pass(PrecipitationPass& pass, const vulkan::Device& device,
                               const vulkan::PipelineLayout& layout, const TargetFormats& formats) {
  pass.pipeline = create_billboard_pipeline(device, layout, formats, shaders::precipitation_vert(),
                                            shaders::precipitation_frag(), vulkan::Blend::over);
}

void destroy_precipitation_pass(PrecipitationPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

void draw_precipitation(const PrecipitationPass& pass, PassContext& context, const FrameData& records,
                        std::uint32_t count) {
  draw_billboards(pass.pipeline, context, records, count);
}

}  // namespace septet::render
