#include "sim-client/frame/bent_normals.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace septet::frame {
namespace {

constexpr float cosine_of_30_deg = 0.8660254f, cosine_of_60_deg = 0.5f;

/// Weight of a face whose normal lies at this cosine to the corner's own face.
float weight_at(float cosine) {
  const float share = std::clamp((cosine - cosine_of_60_deg) / (cosine_of_30_deg - cosine_of_60_deg), 0.0f, 1.0f);
  return share * share * (3.0f - 2.0f * share);
}

}  // namespace

BentNormals::BentNormals(std::span<const std::array<std::uint16_t, 3>> triangles, std::size_t vertices)
    : first_face_(vertices + 1, 0), faces_(3 * triangles.size()) {
  for (const auto& triangle : triangles)
    for (const std::uint16_t vertex : triangle) ++first_face_[vertex + 1u];
  for (std::size_t v = 0; v < vertices; ++v) first_face_[v + 1] += first_face_[v];
  std::vector<std::uint32_t> next(first_face_.begin(), first_face_.end() - 1);
  for (std::uint32_t n = 0; n < triangles.size(); ++n)
    for (const std::uint16_t vertex : triangles[n]) faces_[next[vertex]++] = n;
}

std::vector<glm::vec3> BentNormals::of_corners(std::span<const std::array<std::uint16_t, 3>> triangles,
                                               const FaceNormals& faces) const {
  const std::size_t count = triangles.size();
  std::vector<glm::vec3> areas(count), units(count);
  for (std::size_t n = 0; n < count; ++n) {
    areas[n] = {faces.x[n], faces.y[n], faces.z[n]};
    const float length = glm::length(areas[n]);
    units[n] = length > 0.0f ? areas[n] / length : glm::vec3(0.0f);
  }
  std::vector<glm::vec3> corners(3 * count);
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint16_t vertex = triangles[n][c];
      const bool has_area = units[n] != glm::vec3(0.0f);
      glm::vec3 sum(0.0f);
      for (std::uint32_t at = first_face_[vertex]; at < first_face_[vertex + 1u]; ++at) {
        const std::uint32_t face = faces_[at];
        sum += (has_area ? weight_at(glm::dot(units[n], units[face])) : 1.0f) * areas[face];
      }
      const float length = glm::length(sum);
      corners[3 * n + c] = length > 0.0f ? sum / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
  return corners;
}

}  // namespace septet::frame
