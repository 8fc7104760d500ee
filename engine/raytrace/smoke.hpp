#pragma once
/// Smoke as matter that light crosses: absorption, scattering and the light of flames, by Beer and Lambert.
///
/// The puffs of an instant are spread over cells of even density, in which the way to the next scattering, what is let through and
/// what flames add on the way have closed forms, so that chance decides only where a path turns. What a puff takes from the light in
/// all, its extinction area, is kept exactly. It scatters evenly to all sides.
///
/// Frame: metres from the origin that the caller gave, along the world's axes. Const once made; any number of threads.

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/instant/frame_input.hpp"
#include "engine/raytrace/geometry.hpp"

namespace septet::raytrace {

/// What becomes of light on its way through.
struct SmokeWalk {
  bool scatters = false;  ///< Before the ray's end.
  float distance_m = 0.0f;
  glm::vec3 albedo{0.0f};  ///< Where it scatters.
  glm::vec3 emitted{
      0.0f};  ///< By flames on the whole way, dimmed by what lies before them: radiance at the ray's beginning.
};

class Smoke {
 public:
  static constexpr std::size_t most_cells = 3'000'000;

  Smoke() = default;
  /// Puffs without density, or in no place that is a number, are left out.
  Smoke(std::span<const instant::SmokePuff> puffs, const Vec3& origin_m);

  bool empty() const { return cells_.empty(); }
  float cell_m() const { return cell_m_; }
  /// Between the ray's two ends.
  float optical_depth(const Ray& ray) const;
  /// It scatters where so much optical depth is behind it: −ln of a uniform number.
  SmokeWalk walk(const Ray& ray, float depth_to_scatter) const;

 private:
  struct Cell {
    float extinction_per_m = 0.0f;
    glm::vec3 albedo{0.0f};  ///< Until all puffs are in: weighed by extinction; so are flames.
    float flames = 0.0f;     ///< Share of flame_radiance.
  };
  template <typename Visit>
  void march(const Ray& ray, const Visit& visit) const;
  void add(const instant::SmokePuff& puff, const glm::vec3& middle_m);

  glm::vec3 corner_m_{0.0f};
  float cell_m_ = 1.0f;
  std::array<int, 3> count_{};
  std::vector<Cell> cells_;
};

}  // namespace septet::raytrace
