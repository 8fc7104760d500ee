#pragma once
/// Light sampling of lamps: one of many is drawn by an estimate of its unshadowed light at a place.
///
/// Weights are a lamp's power over the square of its distance, times the two cosines, the surface's and its own, both
/// widened by the lamp's angular radius. (Drawing lights by their estimated share: Shirley, Wang and Zimmerman, "Monte
/// Carlo Techniques for Direct Lighting Calculations", 1996.) No lamp with a possible contribution has the weight 0.
/// Frame: that of World.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/world/street_lamp.hpp"

namespace septet::raytrace {

struct LampTriangle {
  glm::vec3 corner_m{0.0f}, second{0.0f}, third{0.0f};  ///< `second`, `third`: from the first corner to the others.
  glm::vec3 normal{0.0f};
};

/// Triangles of equal emission that lie together, such as one tube under a tunnel's roof.
struct Lamp {
  std::uint32_t place = 0, first_triangle = 0, triangle_count = 0;
  std::vector<LampTriangle> triangles;
  std::vector<float> cumulative_area;  ///< m².
  float area_m2 = 0.0f;                ///< Sum of all triangles.
  glm::vec3 middle_m{0.0f};
  float radius_m = 0.0f;
  /// Mean of its triangles' normals by area: of length 1 where it is flat, 0 where it shines to all sides.
  glm::vec3 axis{0.0f};
  float power = 0.0f;        ///< Area times luminance.
  glm::vec3 emission{0.0f};  ///< Radiance that lights other surfaces.
  glm::vec3 way_m{0.0f};     ///< Displacement until time 1.
  bool textured = false;     ///< Its image colours the emission.
  bool spreads = false;      ///< True: it shines as a street lamp does (engine/world/street_lamp.hpp), not evenly.

  /// Share of its emission that leaves it at this cosine to its axis, above 0.
  float share_at(float cosine) const { return spreads ? street_lamp::spread(cosine) / cosine : 1.0f; }

  /// Triangle that a uniform number in [0, 1) draws, by area.
  std::size_t drawn_triangle(float uniform) const {
    const float at = uniform * area_m2;
    if (triangles.size() > most_counted)
      return std::min<std::size_t>(
          static_cast<std::size_t>(std::upper_bound(cumulative_area.begin(), cumulative_area.end(), at) -
                                   cumulative_area.begin()),
          triangles.size() - 1);
    std::size_t before = 0;
    for (std::size_t n = 0; n + 1 < triangles.size(); ++n) before += at >= cumulative_area[n];
    return before;
  }

 private:
  /// Largest number for which all are compared, without a branch to predict.
  static constexpr std::size_t most_counted = 8;
};

/// The lamps' weights at one place.
class LampWeights {
 public:
  static constexpr std::size_t most = 256;

  float sum() const { return sum_; }
  /// Chance with which `drawn` returns it; needs a sum above 0. For one lamp it is known without a quotient.
  float chance(std::size_t lamp) const { return block_count_ == 0 ? 1.0f : weights_[lamp] / sum_; }
  /// Lamp that a uniform number in [0, 1) draws; needs a sum above 0.
  std::size_t drawn(float uniform) const;

 private:
  friend class LampRow;
  static constexpr std::size_t block = 8;
  std::array<float, most> weights_;
  std::array<float, most / block> blocks_;  ///< Sums of eight weights each.
  std::size_t block_count_ = 0;             ///< Blocks in use; 0: there is one lamp at most.
  float sum_ = 0.0f;
};

/// Lamps stored as rows of equal quantities, so that eight are weighed at a time.
class LampRow {
 public:
  LampRow() = default;
  /// Takes at most LampWeights::most.
  explicit LampRow(std::span<const Lamp> lamps);
  /// Weighs all lamps at a place. `normal`: of the surface, unit; 0 in the air. `time`: while the shutter is open.
  void weigh(const glm::vec3& from_m, const glm::vec3& normal, float time, LampWeights& weights) const;

  /// Weighs up to a common factor: one lamp alone has the weight 1.
  void weigh_for_choice(const glm::vec3& from_m, const glm::vec3& normal, float time, LampWeights& weights) const {
    if (count_ != 1) return weigh(from_m, normal, time, weights);
    weights.weights_[0] = weights.sum_ = 1.0f;
    weights.block_count_ = 0;
  }

 private:
  enum Number { x, y, z, way_x, way_y, way_z, axis_x, axis_y, axis_z, to_all_sides, radius, power, numbers };
  using Rows = std::array<const float*, numbers>;
  static float weight(const Rows& row, std::size_t n, const glm::vec3& from_m, const glm::vec3& normal, float in_air,
                      float time);

  std::size_t count_ = 0;
  std::array<std::vector<float>, numbers> rows_;  ///< Padded to whole blocks by lamps without power.
};

}  // namespace septet::raytrace
