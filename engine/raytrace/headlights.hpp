#pragma once
/// Light sampling of headlights: one of many is drawn by its unshadowed illuminance at a place.
///
/// Headlights are points with a beam (engine/light/beam.hpp), stored as rows of equal quantities, so that eight are
/// weighed at a time. Frame: that of World.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/instant/participants.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::raytrace {

struct DrawnHeadlight {
  std::size_t which = 0;
  float strength = 0.0f;  ///< Unshadowed illuminance of a facing surface, in the beam's units per m².
};

class HeadlightRow {
 public:
  HeadlightRow() = default;
  /// `ways_m`: displacement of each until time 1. `origin_m`: of the world's frame.
  HeadlightRow(std::span<const instant::Headlight> headlights, std::span<const glm::vec3> ways_m, const Vec3& origin_m);

  glm::vec3 position_m(std::size_t which, float time) const {
    return {at(x, which) + at(way_x, which) * time, at(y, which) + at(way_y, which) * time,
            at(z, which) + at(way_z, which) * time};
  }
  /// Sum of all strengths at a place. `time`: while the shutter is open.
  float sum(const glm::vec3& from_m, float time) const;
  /// Headlight that a uniform number in [0, 1) draws, with the chance strength / sum; `sum` is that of this place,
  /// above 0.
  DrawnHeadlight drawn(const glm::vec3& from_m, float time, float uniform, float sum) const;

 private:
  enum Number { x, y, z, way_x, way_y, way_z, level_x, level_y, level_z, intensity, main_beam, numbers };
  static constexpr std::size_t block = 8;
  using Strengths = std::array<float, block>;
  float at(Number number, std::size_t which) const { return rows_[number][which]; }
  /// Strengths of the block that begins with `first`.
  Strengths strengths(std::size_t first, const glm::vec3& from_m, float time) const;

  std::size_t count_ = 0;
  std::array<std::vector<float>, numbers> rows_;  ///< Padded to whole blocks by dark ones.
};

}  // namespace septet::raytrace
