#include "engine/render/passes/smoke_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/light/lamplight.hpp"
#include "engine/light/puff.hpp"
#include "engine/render/passes/billboards.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

/// Optical depth that is taken as opaque: a 400th of the light is left.
constexpr float opaque_depth = 6.0f;

/// Side of the cells that puffs are merged in, by distance from the eye; powers of two, so that cells nest.
double cell_side_m(double distance_m) {
  return distance_m < 7.0 ? 1.0 : distance_m < 40.0 ? 2.0 : distance_m < 120.0 ? 4.0 : 8.0;
}

float depth_through_middle(const SmokePuff& puff) { return light::puff_depth(puff.extinction_area_m2, puff.radius_m); }

/// Coarse tiles of a view's picture that add up the optical depth seen so far.
class Coverage {
 public:
  static constexpr int columns = 48, rows = 32;
  /// Mean depth over the square around a drawn puff relative to that through its middle: 2πσ² over its area.
  static constexpr float mean_of_square = std::numbers::pi_v<float> / (2.0f * light::puff_reach * light::puff_reach);

  /// Adds a puff (NDC and extent in NDC); false where all its tiles are opaque already.
  bool add(float x, float y, float half_width, float half_height, float depth) {
    const int left = tile(x - half_width, columns), right = tile(x + half_width, columns);
    const int top = tile(y - half_height, rows), bottom = tile(y + half_height, rows);
    bool seen = false;
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column) seen = seen || depth_[row * columns + column] < opaque_depth;
    if (!seen) return false;
    // Only tiles wholly inside count, since a puff's edge is thin.
    for (int row = top + 1; row < bottom; ++row)
      for (int column = left + 1; column < right; ++column) depth_[row * columns + column] += mean_of_square * depth;
    return true;
  }

 private:
  static int tile(float ndc, int count) {
    return std::clamp(static_cast<int>((std::clamp(ndc, -1.0f, 1.0f) * 0.5f + 0.5f) * static_cast<float>(count)), 0,
                      count - 1);
  }
  std::array<float, columns * rows> depth_{};
};

glm::vec3 scattered(const SmokePuff& puff, float share_of_sky, const SkyLight& light, const LightWithin& within) {
  const glm::vec3 around = 0.5f * within.around * (light.sky_irradiance + light.ground_irradiance);
  const glm::vec3 irradiance = around * share_of_sky + light::roofed_irradiance * (1.0f - share_of_sky);
  return puff.albedo * irradiance / std::numbers::pi_v<float> +
         light::puff_scatters(puff.albedo, light.light_irradiance * (share_of_sky * within.sun)) +
         instant::flame_radiance * (puff.glow * puff.glow);
}

}  // namespace

void create_smoke_pass(SmokePass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                       const TargetFormats& formats) {
  pass.pipeline = create_billboard_pipeline(device, layout, formats, shaders::smoke_vert(), shaders::smoke_frag(),
                                            vulkan::Blend::over);
}

void destroy_smoke_pass(SmokePass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

std::vector<SmokePuff> merged_puffs(std::span<const SmokePuff> puffs, const Vec3& eye_m) {
  struct Keyed {
    std::array<std::int64_t, 5> cell;  // Side, flame or smoke, x, y, z.
    std::uint32_t puff;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(puffs.size());
  for (std::uint32_t i = 0; i < puffs.size(); ++i) {
    const double side = cell_side_m(glm::length(puffs[i].position_m - eye_m));
    const glm::dvec3 cell = glm::floor(puffs[i].position_m / side);
    keyed.push_back(
        {{std::int64_t(side), puffs[i].glow > 0.0f, std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z)},
         i});
  }
  std::ranges::sort(
      keyed, [](const Keyed& a, const Keyed& b) { return a.cell != b.cell ? a.cell < b.cell : a.puff < b.puff; });
  std::vector<SmokePuff> merged;
  for (std::size_t begin = 0, end; begin < keyed.size(); begin = end) {
    end = begin;
    SmokePuff sum;
    Vec3 place(0.0);
    glm::vec3 albedo(0.0f);
    float area = 0.0f, square = 0.0f, glow = 0.0f;
    for (; end < keyed.size() && keyed[end].cell == keyed[begin].cell; ++end) {
      const SmokePuff& puff = puffs[keyed[end].puff];
      const float weight = std::max(puff.extinction_area_m2, 1e-6f);
      place += double(weight) * puff.position_m;
      albedo += weight * puff.albedo;
      square += weight * puff.radius_m * puff.radius_m;
      glow += weight * puff.glow;
      area += weight;
    }
    sum.position_m = place / double(area);
    sum.albedo = albedo / area;
    sum.glow = glow / area;
    sum.extinction_area_m2 = area;
    // Variance along each axis of parts spread over a cell: side²/12.
    const float side = static_cast<float>(keyed[begin].cell[0]), apart = end - begin > 1 ? side * side / 12.0f : 0.0f;
    sum.radius_m = std::sqrt(square / area + apart);
    sum.seed = puffs[keyed[begin].puff].seed;
    merged.push_back(sum);
  }
  return merged;
}

DrawnSmoke drawn_smoke(std::span<const SmokePuff> puffs, std::span<const Headlight> headlights, const Vec3& eye_m) {
  DrawnSmoke drawn{merged_puffs(puffs, eye_m), {}, {}};
  drawn.beams = light_of_beams(drawn.puffs, headlights, eye_m);
  return drawn;
}

void shade_smoke(DrawnSmoke& smoke, const SmokeShade& shade) {
  smoke.within.clear();
  for (const SmokePuff& puff : smoke.puffs) {
    const DepthsInSmoke depths = depths_in(shade, puff.position_m);
    smoke.within.push_back({light::sun_within_smoke(depths.to_light, depth_through_middle(puff), puff.albedo.g),
                            light::around_within_smoke(depths.to_light + depths.away, puff.albedo.g)});
  }
}

float transmittance(std::span<const SmokePuff> puffs, const Vec3& eye_m, const Vec3& point_m) {
  const Vec3 way = point_m - eye_m;
  const double length = glm::length(way);
  if (length < 1e-6) return 1.0f;
  const Vec3 along = way / length;
  double depth = 0.0;
  for (const SmokePuff& puff : puffs) {
    const Vec3 to_puff = puff.position_m - eye_m;
    const double at = glm::dot(to_puff, along);
    if (at < 0.0 || at > length) continue;
    const double deviations2 = (glm::dot(to_puff, to_puff) - at * at) / (double(puff.radius_m) * puff.radius_m);
    if (deviations2 < 9.0) depth += depth_through_middle(puff) * light::puff_density(static_cast<float>(deviations2));
  }
  return static_cast<float>(std::exp(-depth));
}

std::vector<PuffRecord> puff_records(const DrawnSmoke& smoke, const DeviceScene& scene, const SkyLight& light,
                                     const FrameView& view, const Vec3& eye_m) {
  struct Placed {
    glm::vec3 at;
    float distance_m;
    std::size_t puff;
  };
  const ViewVolume volume = view_volume(view);
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < smoke.puffs.size(); ++i) {
    const glm::vec3 at(smoke.puffs[i].position_m - eye_m);
    if (intersects(volume, at, light::puff_reach * smoke.puffs[i].radius_m)) placed.push_back({at, glm::length(at), i});
  }
  std::ranges::stable_sort(placed, {}, &Placed::distance_m);
  // Front to back, so that puffs behind dense smoke are found; then reversed.
  const Quat car_from_world = glm::conjugate(view.world_from_car.orientation);
  const OffAxisView& projection = view.projection;
  Coverage coverage;
  std::vector<PuffRecord> records;
  for (const Placed& p : placed) {
    const SmokePuff& puff = smoke.puffs[p.puff];
    const float radius = light::puff_reach * puff.radius_m, depth = depth_through_middle(puff);
    const Vec3 in_car = car_from_world * Vec3(p.at);
    const double ahead = -glm::dot(in_car, projection.back);
    if (ahead > 2.0 * radius) {
      const double x = glm::dot(in_car, projection.right) / ahead, y = glm::dot(in_car, projection.up) / ahead;
      const double wide = projection.right_slope - projection.left_slope,
                   high = projection.top_slope - projection.bottom_slope;
      if (!coverage.add(static_cast<float>(2.0 * (x - projection.left_slope) / wide - 1.0),
                        static_cast<float>(2.0 * (y - projection.bottom_slope) / high - 1.0),
                        static_cast<float>(2.0 * radius / (ahead * wide)),
                        static_cast<float>(2.0 * radius / (ahead * high)), depth))
        continue;
    }
    const glm::vec3 radiance = scattered(puff, share_of_sky(scene.summary, puff.position_m), light,
                                         smoke.within.empty() ? LightWithin{} : smoke.within[p.puff]) +
                               light::puff_scatters(puff.albedo, smoke.beams[p.puff]);
    records.push_back({glm::vec4(p.at, puff.radius_m), glm::vec4(radiance, depth),
                       glm::vec4(static_cast<float>(puff.seed % 1024u) / 1024.0f)});
  }
  std::ranges::reverse(records);
  return records;
}

void draw_smoke(const SmokePass& pass, PassContext& context, const FrameData& records, std::uint32_t count) {
  draw_billboards(pass.pipeline, context, records, count);
}

}  // namespace septet::render
