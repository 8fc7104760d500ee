#include "engine/render/passes/smoke_shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/light/puff.hpp"

namespace septet::render {
namespace {

constexpr double farthest_shade_m = 300.0;
/// Optical depth of the deepest texel below which no shade is seen.
constexpr float least_depth = 0.02f;
/// Side of the finest texels; coarser ones are powers of two of it.
constexpr double finest_m = 0.25;

/// A puff in the sun, in the light's view: metres along right, up and the light from the eye.
struct Lit {
  Vec3 at_m{0.0};
  double deviation_m = 1.0;
  float area_m2 = 0.0f;
};

std::vector<Lit> puffs_in_light(std::span<const SmokePuff> puffs, const SceneSummary& scene, const Cascade& axes,
                                const Vec3& eye_m) {
  std::vector<Lit> lit;
  for (const SmokePuff& puff : puffs) {
    const Vec3 from_eye = puff.position_m - eye_m;
    if (glm::dot(from_eye, from_eye) > farthest_shade_m * farthest_shade_m) continue;
    const float area_m2 = puff.extinction_area_m2 * instant::share_of_sky(scene, puff.position_m);
    if (area_m2 > 0.0f)
      lit.push_back({{glm::dot(from_eye, Vec3(axes.right)), glm::dot(from_eye, Vec3(axes.up)),
                      glm::dot(from_eye, Vec3(axes.to_light))},
                     double(puff.radius_m),
                     area_m2});
  }
  return lit;
}

/// Weights of the texels along one axis that a puff covers; their sum is 1, so that its extinction area is kept.
struct Section {
  int first = 0;
  std::vector<float> weights;
};

void cover(Section& section, double at_texels, double deviation_texels) {
  // A puff narrower than a texel would be missed between two.
  const double deviation = std::max(deviation_texels, 0.6), reach = double(light::puff_reach) * deviation;
  section.first = std::max(0, static_cast<int>(std::floor(at_texels - reach)));
  const int last = std::min(light::smoke_shade_side - 1, static_cast<int>(std::floor(at_texels + reach)));
  section.weights.clear();
  float sum = 0.0f;
  for (int n = section.first; n <= last; ++n) {
    const auto away = static_cast<float>((n + 0.5 - at_texels) / deviation);
    sum += section.weights.emplace_back(light::puff_density(away * away));
  }
  for (float& weight : section.weights) weight /= sum;
}

}  // namespace

SmokeShade smoke_shade(std::span<const SmokePuff> puffs, const SceneSummary& scene, const ShadowCascades& shadows) {
  const Cascade& axes = shadows.cascades[0];
  const std::vector<Lit> lit = puffs_in_light(puffs, scene, axes, shadows.eye_m);
  SmokeShade shade{axes.right, axes.up, axes.to_light, shadows.eye_m, 1.0f, {}};
  if (lit.empty()) return shade;
  glm::dvec2 low(farthest_shade_m * 10.0), high = -low;
  for (const Lit& puff : lit) {
    const double reach_m = double(light::puff_reach) * std::max(puff.deviation_m, finest_m);
    low = glm::min(low, glm::dvec2(puff.at_m) - reach_m), high = glm::max(high, glm::dvec2(puff.at_m) + reach_m);
  }
  // Two texels of margin, and one for the raster.
  double texel_m = finest_m;
  while (std::max(high.x - low.x, high.y - low.y) > texel_m * (light::smoke_shade_side - 5)) texel_m *= 2.0;
  const glm::dvec2 eye_m(glm::dot(shadows.eye_m, Vec3(axes.right)), glm::dot(shadows.eye_m, Vec3(axes.up)));
  const glm::dvec2 corner_m = texel_m * (glm::floor((low + eye_m) / texel_m) - 2.0) - eye_m;
  shade.texel_m = static_cast<float>(texel_m);
  shade.corner_m = shadows.eye_m + corner_m.x * Vec3(axes.right) + corner_m.y * Vec3(axes.up);
  constexpr auto side = static_cast<std::size_t>(light::smoke_shade_side);
  shade.moments.assign(side * side, glm::vec4(0.0f));
  std::array<Section, 2> across;
  for (const Lit& puff : lit) {
    for (int axis = 0; axis < 2; ++axis)
      cover(across[static_cast<std::size_t>(axis)], (puff.at_m[axis] - corner_m[axis]) / texel_m,
            puff.deviation_m / texel_m);
    const auto height_m = static_cast<float>(puff.at_m.z), deviation_m = static_cast<float>(puff.deviation_m);
    const glm::vec4 whole = puff.area_m2 / (shade.texel_m * shade.texel_m) *
                            glm::vec4(1.0f, height_m, height_m * height_m + deviation_m * deviation_m, 0.0f);
    for (std::size_t y = 0; y < across[1].weights.size(); ++y) {
      const glm::vec4 row = across[1].weights[y] * whole;
      glm::vec4* texel = &shade.moments[(static_cast<std::size_t>(across[1].first) + y) * side +
                                        static_cast<std::size_t>(across[0].first)];
      for (const float weight : across[0].weights) *texel++ += weight * row;
    }
  }
  if (std::ranges::max(shade.moments, {}, &glm::vec4::x).x < least_depth) shade.moments.clear();
  return shade;
}

DepthsInSmoke depths_in(const SmokeShade& shade, const Vec3& place_m) {
  if (shade.moments.empty()) return {};
  const glm::vec3 from_corner(place_m - shade.corner_m);
  const glm::vec2 at =
      glm::vec2(glm::dot(from_corner, shade.right), glm::dot(from_corner, shade.up)) / shade.texel_m - 0.5f;
  const glm::vec2 low = glm::floor(at), share = at - low;
  constexpr int side = light::smoke_shade_side;
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  if (x < 0 || y < 0 || x >= side - 1 || y >= side - 1) return {};
  const glm::vec4* first = &shade.moments[static_cast<std::size_t>(y * side + x)];
  const glm::vec3 moments(
      glm::mix(glm::mix(first[0], first[1], share.x), glm::mix(first[side], first[side + 1], share.x), share.y));
  const float to_light = light::smoke_above(moments, glm::dot(from_corner, shade.to_light));
  return {to_light, moments.x - to_light};
}

void set_smoke_shade(ViewUniforms& uniforms, const SmokeShade& shade, const Vec3& eye_m) {
  if (shade.moments.empty()) return;
  const Vec3 from_corner = eye_m - shade.corner_m;
  const auto row = [&](const glm::vec3& axis, double unit_m, double shift) {
    return glm::vec4(axis / static_cast<float>(unit_m),
                     static_cast<float>(glm::dot(from_corner, Vec3(axis)) / unit_m + shift));
  };
  // A texel's value stands at its middle.
  uniforms.smoke_shade_x = row(shade.right, double(shade.texel_m), -0.5);
  uniforms.smoke_shade_y = row(shade.up, double(shade.texel_m), -0.5);
  uniforms.smoke_shade_height = row(shade.to_light, 1.0, 0.0);
}

FrameData store_smoke_shade(PassContext& context, const SmokeShade& shade) {
  if (shade.moments.empty()) return {};
  return store(context, std::span<const glm::vec4>(shade.moments));
}

}  // namespace septet::render
