#include "engine/render/passes/smoke_beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/light/beam.hpp"
#include "engine/light/puff.hpp"

namespace septet::render {
namespace {

constexpr std::size_t most_beams = 8;
constexpr double farthest_m = 80.0;

/// Depth of smoke before a lamp, by direction: slopes aside and up, each as many cells either way of straight ahead.
class Dimming {
 public:
  float depth(float aside, float up) const { return depth_[index(cell(aside, aside_cells), cell(up, up_cells))]; }

  /// Spreads a puff over the square of the same area and depth through the middle, no smaller than a cell.
  void add(float aside, float up, float deviation, float depth_times_deviation2) {
    const float half = std::max(std::sqrt(0.5f * light::pi) * deviation, 0.5f * cell_slope);
    const float depth = 2.0f * light::pi * depth_times_deviation2 / (4.0f * half * half);
    for (int y = cell(up - half, up_cells); y <= cell(up + half, up_cells); ++y)
      for (int x = cell(aside - half, aside_cells); x <= cell(aside + half, aside_cells); ++x)
        depth_[index(x, y)] += depth * covered(x - aside_cells, aside, half) * covered(y - up_cells, up, half);
  }

 private:
  static constexpr int aside_cells = 20, up_cells = 8;
  static constexpr float cell_slope = 0.04f;
  static int cell(float slope, int cells) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(slope, -9.0f, 9.0f) / cell_slope)) + cells, 0,
                      2 * cells - 1);
  }
  /// Share of a cell, counted from straight ahead, that lies between middle − half and middle + half.
  static float covered(int cell, float middle, float half) {
    const float low = static_cast<float>(cell) * cell_slope;
    return std::clamp((std::min(low + cell_slope, middle + half) - std::max(low, middle - half)) / cell_slope, 0.0f,
                      1.0f);
  }
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * 2 * aside_cells + x); }
  std::array<float, 4 * aside_cells * up_cells> depth_{};
};

struct BeforeLamp {
  std::uint32_t puff = 0;
  glm::vec3 way_m{0.0f};  ///< From the lamp: ahead, to the left, up.
};

/// Puffs before a lamp, nearest first.
std::vector<BeforeLamp> puffs_before(std::span<const SmokePuff> puffs, const Headlight& lamp) {
  const glm::vec3 ahead = lamp.direction, left = glm::normalize(glm::cross(glm::vec3(0, 0, 1), ahead)),
                  up = glm::cross(ahead, left);
  std::vector<BeforeLamp> before;
  for (std::uint32_t i = 0; i < puffs.size(); ++i) {
    const glm::vec3 way(puffs[i].position_m - lamp.position_m);
    const float ahead_m = glm::dot(way, ahead);
    if (ahead_m > 0.1f && ahead_m < static_cast<float>(farthest_m))
      before.push_back({i, {ahead_m, glm::dot(way, left), glm::dot(way, up)}});
  }
  std::ranges::stable_sort(before, {}, [](const BeforeLamp& b) { return b.way_m.x; });
  return before;
}

void add_beam(std::span<const SmokePuff> puffs, const Headlight& lamp, std::vector<glm::vec3>& light) {
  Dimming dimming;
  for (const BeforeLamp& before : puffs_before(puffs, lamp)) {
    const SmokePuff& puff = puffs[before.puff];
    const float ahead_m = before.way_m.x, aside = before.way_m.y / ahead_m, up = before.way_m.z / ahead_m;
    const glm::vec3 way(puff.position_m - lamp.position_m);
    const float square_m2 = glm::dot(way, way);
    const float share =
        light::beam_share(lamp.direction, way / std::sqrt(square_m2), lamp.main_beam, light::lamp_spread_m2(square_m2));
    light[before.puff] += light::headlight_color * (lamp.intensity * share * std::exp(-dimming.depth(aside, up)));
    const float deviation = puff.radius_m / ahead_m;
    dimming.add(aside, up, deviation,
                light::puff_depth(puff.extinction_area_m2, puff.radius_m) * deviation * deviation);
  }
}

}  // namespace

std::vector<glm::vec3> light_of_beams(std::span<const SmokePuff> puffs, std::span<const Headlight> headlights,
                                      const Vec3& eye_m) {
  std::vector<glm::vec3> light(puffs.size(), glm::vec3(0.0f));
  if (puffs.empty()) return light;
  std::vector<std::pair<double, const Headlight*>> nearest;
  for (const Headlight& lamp : headlights)
    if (const double away_m = glm::length(lamp.position_m - eye_m);
        away_m < 2.0 * farthest_m && std::abs(lamp.direction.z) < 0.9f)
      nearest.emplace_back(away_m, &lamp);
  std::ranges::stable_sort(nearest, {}, &std::pair<double, const Headlight*>::first);
  for (std::size_t i = 0; i < std::min(nearest.size(), most_beams); ++i) add_beam(puffs, *nearest[i].second, light);
  return light;
}

}  // namespace septet::render
