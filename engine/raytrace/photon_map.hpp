#pragma once
/// Light that photons have brought to surfaces, and how bright it makes them: Jensen, "Global Illumination Using Photon Maps" (1996).
///
/// The radiance of a point is that of the photons nearest to it on its own surface, over the disc that holds them: at most `nearest` of
/// them, none further than `reach_m`. Of so many that are found the outermost marks the disc and does not count, without which the
/// estimate would be too bright by one part in `nearest`. Photons are held in a balanced tree over their places (Bentley, 1975); equal
/// distances are settled by their number, so that the same photons give the same light bit for bit.
///
/// Const once made; any number of threads.

#include <cstdint>
#include <vector>

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

/// As it lies on a surface.
struct Photon {
  glm::vec3 position_m{0.0f};  ///< As World has it.
  glm::vec3 power{0.0f};       ///< Radiance times m² times sr.
  glm::vec3 normal{0.0f};      ///< Of the triangle, on the side from which it came.
  glm::vec3 to_light{0.0f};    ///< Unit: from where it came.
  bool operator==(const Photon&) const = default;
};

class PhotonMap {
 public:
  static constexpr std::uint32_t most_nearest = 256;

  PhotonMap() = default;
  /// In any order, which is part of the result; `nearest` from 2 to most_nearest.
  PhotonMap(std::vector<Photon> photons, std::uint32_t nearest, float reach_m);

  bool empty() const { return photons_.empty(); }
  std::size_t size() const { return photons_.size(); }
  float reach_m() const { return reach_m_; }
  /// Towards a unit direction.
  glm::vec3 radiance(const SurfacePoint& point, const glm::vec3& to_viewer) const;

 private:
  struct Nearest;
  void balance(std::size_t first, std::size_t end);
  void find(const SurfacePoint& point, Nearest& nearest) const;

  std::vector<Photon> photons_;     ///< Of each stretch the middle one divides the others.
  std::vector<std::uint8_t> axes_;  ///< Along which.
  std::uint32_t nearest_ = 2;
  float reach_m_ = 0.0f;
  glm::vec3 low_m_{0.0f}, high_m_{0.0f};
};

/// What paths of one instant take from photons.
struct PhotonMaps {
  PhotonMap caustic;          ///< Through at least one clear body, then to the first other surface.
  PhotonMap global;           ///< All that lamps give, wherever it is scattered; empty: paths follow it themselves.
  bool has_caustics = false;  ///< Paths leave to `caustic` what comes from lamps through clear bodies.
};

}  // namespace septet::raytrace
