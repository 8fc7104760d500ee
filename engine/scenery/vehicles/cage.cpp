#include "engine/scenery/vehicles/cage.hpp"

#include "engine/core/check.hpp"
#include "engine/geometry/subdivision.hpp"

namespace septet::scenery {

geometry::PolygonMesh shown_surface(const geometry::PolygonMesh& cage, std::uint32_t subdivision_level) {
  auto surface = geometry::subdivide(cage, subdivision_level);
  SEPTET_CHECK(surface.has_value(), "{}", surface.error().what);
  return std::move(*surface);
}

void fit_bounds(geometry::PolygonMesh& cage, std::uint32_t subdivision_level, const geometry::Bounds& bounds) {
  const geometry::Bounds shown = geometry::bounds(shown_surface(cage, subdivision_level));
  const glm::vec3 scale = (bounds.max_m - bounds.min_m) / (shown.max_m - shown.min_m);
  for (glm::vec3& p : cage.vertices_m) p = bounds.min_m + (p - shown.min_m) * scale;
}

}  // namespace septet::scenery
