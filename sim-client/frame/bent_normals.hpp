#pragma once
/// Normals of the corners of a part that bends: of each corner the sum of the normals of the faces around its vertex,
/// weighted by area, as the t-variant product gives them (Parus, Hast and Kolingerová 2006, section 4). A face counts fully
/// where it is bent off by 30° at most from the corner's own face, and not at all from 60° on, so that edges stay edges
/// and none appears or vanishes at once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/geometry/temporal_normals.hpp"

namespace septet::frame {

class BentNormals {
 public:
  /// Triangles by their vertices, each below `vertices`.
  BentNormals(std::span<const std::array<std::uint16_t, 3>> triangles, std::size_t vertices);

  /// Unit normals of all corners, three a triangle. `triangles`: those that it was made of; `faces`: their
  /// TemporalNormals::area_vectors_at. The corner of a face without area has the normal of the faces around it, else
  /// (0, 0, 1).
  std::vector<glm::vec3> of_corners(std::span<const std::array<std::uint16_t, 3>> triangles,
                                    const FaceNormals& faces) const;

 private:
  std::vector<std::uint32_t> first_face_;  ///< By vertex, where its faces begin; one more than vertices.
  std::vector<std::uint32_t> faces_;       ///< Faces around each vertex.
};

}  // namespace septet::frame
