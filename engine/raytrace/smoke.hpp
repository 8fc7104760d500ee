#pragma once
/// Smoke as matter that light crosses: absorption, scattering and the light of flames, by Beer and Lambert.
///
/// The puffs of an instant are spread over cells of even density, in which the distance to the next scattering, the
/// transmittance and the light of flames on the way have closed forms, so that chance decides only where a path turns.
/// A puff's total attenuation, its extinction area, is kept exactly. It scatters evenly to all sides.
///
/// Frame: metres from the origin that the caller gave, along the world's axes. Const once made; any number of threads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/instant/frame_input.hpp"
#include "engine/raytrace/geometry.hpp"

namespace septet::raytrace {

/// Result of a ray's way through smoke.
struct SmokeWalk {
  bool scatters = false;  ///< True if it scatters before the ray's end.
  float distance_m = 0.0f;
  glm::vec3 albedo{0.0f};  ///< Albedo where it scatters.
  /// Light of flames on the whole way, dimmed by the smoke before them: radiance at the ray's beginning.
  glm::vec3 emitted{0.0f};
};

class Smoke {
 public:
  static constexpr std::size_t most_cells = 3'000'000;

  Smoke() = default;
  /// Puffs without density, or with a position that is not finite, are left out.
  Smoke(std::span<const instant::SmokePuff> puffs, const Vec3& origin_m);

  bool empty() const { return blocks_.empty(); }
  float cell_m() const { return cell_m_; }
  /// Optical depth between the ray's two ends.
  float optical_depth(const Ray& ray) const;
  /// Scatters at this optical depth: −ln of a uniform number.
  SmokeWalk walk(const Ray& ray, float depth_to_scatter) const;

 private:
  struct Cell {
    float extinction_per_m = 0.0f;
    glm::vec3 albedo{0.0f};  ///< Sum weighed by extinction until all puffs are in; `flames` likewise.
    float flames = 0.0f;     ///< Share of flame_radiance.
  };
  template <typename Visit>
  void march(const Ray& ray, const Visit& visit) const;
  /// Cells stand in blocks, of which those alone are made that smoke reaches: of puffs far apart few.
  static constexpr int block_side = 8;
  static constexpr std::size_t block_cells = std::size_t{block_side} * block_side * block_side;
  static constexpr std::uint32_t no_block = 0xffffffffu;

  void add(const instant::SmokePuff& puff, const glm::vec3& middle_m);
  /// Index in `blocks_` of the block that holds a cell.
  std::size_t block_of(int x, int y, int z) const {
    const auto row = [](int cell) { return static_cast<std::size_t>(cell / block_side); };
    return (row(z) * static_cast<std::size_t>(block_count_[1]) + row(y)) * static_cast<std::size_t>(block_count_[0]) +
           row(x);
  }
  static std::size_t within_block(int x, int y, int z) {
    return static_cast<std::size_t>(((z % block_side) * block_side + y % block_side) * block_side + x % block_side);
  }

  glm::vec3 corner_m_{0.0f};
  float cell_m_ = 1.0f;
  std::array<int, 3> count_{}, block_count_{};
  std::vector<std::uint32_t> blocks_;  ///< Number of each block among those made, or `no_block`.
  std::vector<Cell> cells_;            ///< Cells of the blocks made, one block after the other.
};

}  // namespace septet::raytrace
