#pragma once
/// Photon map: light that photons have brought to surfaces, and the radiance it gives: Jensen, "Global Illumination
/// Using Photon Maps" (1996).
///
/// The radiance of a point is the power of the photons nearest to it on its own surface, over the disc that holds them:
/// at most `nearest` of them, none further than `reach_m`. Where `nearest` are found, the outermost marks the disc and
/// does not count, without which the estimate would be too bright by one part in `nearest`. Photons are held in a
/// balanced tree over their places (Bentley, 1975); equal distances are ordered by their number, so that the same
/// photons give the same light bit for bit.
///
/// Const once made; any number of threads.

#include <cstdint>
#include <vector>

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

/// Photon at rest on a surface.
struct Photon {
  glm::vec3 position_m{0.0f};  ///< Position in World's frame.
  glm::vec3 power{0.0f};       ///< Radiance times m² times sr.
  glm::vec3 normal{0.0f};      ///< Normal of the triangle, on the side from which it came.
  glm::vec3 to_light{0.0f};    ///< Unit vector back along its ray.
  bool operator==(const Photon&) const = default;
};

class PhotonMap {
 public:
  static constexpr std::uint32_t most_nearest = 256;

  PhotonMap() = default;
  /// Order of `photons` is part of the result; `nearest` from 2 to most_nearest.
  PhotonMap(std::vector<Photon> photons, std::uint32_t nearest, float reach_m);

  bool empty() const { return photons_.empty(); }
  std::size_t size() const { return photons_.size(); }
  float reach_m() const { return reach_m_; }
  /// Radiance towards a unit direction.
  glm::vec3 radiance(const SurfacePoint& point, const glm::vec3& to_viewer) const;

 private:
  struct Nearest;
  void balance(std::size_t first, std::size_t end);
  void find(const SurfacePoint& point, Nearest& nearest) const;

  std::vector<Photon> photons_;     ///< Middle one of each range divides the others.
  std::vector<std::uint8_t> axes_;  ///< Axis of each division.
  std::uint32_t nearest_ = 2;
  float reach_m_ = 0.0f;
  glm::vec3 low_m_{0.0f}, high_m_{0.0f};
};

/// Photon maps of one instant, read by its paths.
struct PhotonMaps {
  /// Light of lamps, headlights and sun through at least one clear body, to the first other surface.
  PhotonMap caustic;
  PhotonMap global;           ///< All light of lamps, at each scattering; empty: paths follow it themselves.
  bool has_caustics = false;  ///< True: paths leave light through clear bodies to `caustic`.
};

}  // namespace septet::raytrace
