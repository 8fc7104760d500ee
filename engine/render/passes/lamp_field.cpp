#include "engine/render/passes/lamp_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "engine/world/street_lamp.hpp"

namespace septet::render {
namespace {

constexpr double reach = 4.5;  ///< Reach of a lamp, in its heights.

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Adds one lamp's light to the texels below it.
void add_lamp(LampField& field, const StandingLamp& lamp) {
  constexpr int side = LampField::side;
  const glm::vec2 at((Vec2(lamp.position_m) - field.corner_m) / LampField::texel_m);
  const float height = lamp.height_m, reach_m = static_cast<float>(reach) * height;
  const float reach_px = reach_m / static_cast<float>(LampField::texel_m), candela = luminance(lamp.intensity);
  const int x0 = std::max(0, static_cast<int>(std::floor(at.x - reach_px))),
            x1 = std::min(side - 1, static_cast<int>(std::ceil(at.x + reach_px))),
            y0 = std::max(0, static_cast<int>(std::floor(at.y - reach_px))),
            y1 = std::min(side - 1, static_cast<int>(std::ceil(at.y + reach_px)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const glm::vec2 way = (at - glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)) *
                            static_cast<float>(LampField::texel_m);
      const float level = glm::dot(way, way), window = 1.0f - level / (reach_m * reach_m);
      // `way` points to the lamp. Texels up to one behind a wall are lit, too, since a texel at the wall is filtered
      // with them.
      constexpr auto behind_m = static_cast<float>(LampField::texel_m);
      if (window <= 0.0f || glm::dot(lamp.walls[0].way, way) < -lamp.walls[0].distance_m - behind_m ||
          glm::dot(lamp.walls[1].way, way) < -lamp.walls[1].distance_m - behind_m)
        continue;
      const float square = level + height * height, distance = std::sqrt(square);
      const float cosine = height / distance, spread = lamp.roofed ? cosine : street_lamp::spread(cosine);
      // A street lamp's light is as planned over most of its reach, and falls to zero at its end.
      const float arriving =
          candela * spread / square * (lamp.roofed ? window : 1.0f - (1.0f - window) * (1.0f - window));
      glm::vec4& texel = field.texels[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
      texel += glm::vec4(glm::vec3(way, height) * (arriving / distance), 0.0f);
      texel.w += lamp.roofed ? -arriving : arriving;
    }
}

}  // namespace

Vec2 lamp_field_corner(const Vec3& eye_m) {
  constexpr double half_m = 0.5 * LampField::side * LampField::texel_m;
  return glm::round(Vec2(eye_m) / LampField::step_m) * LampField::step_m - half_m;
}

LampField lamp_field(std::span<const StandingLamp> lamps, const Vec2& corner_m) {
  LampField field;
  field.corner_m = corner_m;
  glm::vec3 sum(0.0f);
  float heights_m = 0.0f, roofed = 0.0f;
  for (const StandingLamp& lamp : lamps) {
    const Vec2 from = Vec2(lamp.position_m) - corner_m;
    const double margin_m = reach * lamp.height_m, extent_m = LampField::side * LampField::texel_m;
    if (!(from.x > -margin_m && from.y > -margin_m && from.x < extent_m + margin_m && from.y < extent_m + margin_m))
      continue;
    if (field.texels.empty()) field.texels.resize(std::size_t{LampField::side} * LampField::side, glm::vec4(0.0f));
    (lamp.roofed ? field.roofed : field.open) = true;
    sum += lamp.intensity;
    if (lamp.roofed) heights_m += lamp.height_m, roofed += 1.0f;
    add_lamp(field, lamp);
  }
  if (roofed > 0.0f) field.roofed_height_m = heights_m / roofed;
  if (luminance(sum) > 0.0f) field.hue = sum / luminance(sum);
  return field;
}

std::vector<std::uint64_t> packed(const LampField& field) {
  std::vector<std::uint64_t> texels;
  texels.reserve(field.texels.size());
  for (const glm::vec4& texel : field.texels) texels.push_back(glm::packHalf4x16(texel));
  return texels;
}

}  // namespace septet::render
