#include "sim-client/frame/bent_normals.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/relative.hpp"

namespace septet::frame {
namespace {

using Triangle = std::array<std::uint16_t, 3>;

/// A sheet of columns by 2 vertices, bent by an angle a column about y; `radius` 0: flat.
struct BentSheet {
  static constexpr std::uint16_t columns = 9;
  std::vector<glm::vec3> places;
  std::vector<Triangle> triangles;

  explicit BentSheet(float bend_rad) {
    for (std::uint16_t i = 0; i < columns; ++i)
      for (const float y : {0.0f, 1.0f}) {
        const float x = static_cast<float>(i), angle = bend_rad * x;
        places.push_back(bend_rad == 0.0f ? glm::vec3(x, y, 0.0f)
                                          : glm::vec3(std::sin(angle), 0.0f, std::cos(angle) - 1.0f) / bend_rad +
                                                glm::vec3(0.0f, y, 0.0f));
      }
    for (std::uint16_t i = 0; i + 1 < columns; ++i) {
      const auto a = static_cast<std::uint16_t>(2 * i);
      const auto at = [a](int n) { return static_cast<std::uint16_t>(a + n); };
      triangles.push_back({at(0), at(2), at(1)});
      triangles.push_back({at(1), at(2), at(3)});
    }
  }
};

std::vector<glm::vec3> corners_between(const BentSheet& from, const BentSheet& to, float share) {
  std::vector<MovingFace> faces(from.triangles.size());
  for (std::size_t n = 0; n < faces.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) {
      faces[n].from[c] = from.places[from.triangles[n][c]];
      faces[n].to[c] = to.places[from.triangles[n][c]];
    }
  FaceNormals areas;
  TemporalNormals(NormalMethod::t_variant, faces).area_vectors_at(share, areas);
  return BentNormals(from.triangles, from.places.size()).of_corners(from.triangles, areas);
}

}  // namespace

TEST_CASE("the vectors of the t-variant product are as long as twice the area of their faces, at any instant") {
  const MovingFace face{{glm::vec3(0, 0, 0), glm::vec3(2, 0, 0), glm::vec3(0, 3, 0)},
                        {glm::vec3(0, 0, 1), glm::vec3(4, 0, 1), glm::vec3(0, 5, 2)}};
  const TemporalNormals normals(NormalMethod::t_variant, {&face, 1});
  for (const float t : {0.0f, 0.4f, 1.0f}) {
    FaceNormals areas;
    normals.area_vectors_at(t, areas);
    std::array<glm::vec3, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = glm::mix(face.from[c], face.to[c], t);
    const glm::vec3 twice = glm::cross(p[1] - p[0], p[2] - p[0]);
    CHECK(glm::length(glm::vec3(areas.x[0], areas.y[0], areas.z[0]) - twice) < 1e-4f);
  }
}

TEST_CASE("corners of a sheet that bends have the normals of the bent surface, at every instant") {
  const BentSheet bent(glm::radians(10.0f));
  for (const auto& [from, share] :
       {std::pair(BentSheet(0.0f), 1.0f), std::pair(BentSheet(glm::radians(20.0f)), 1.0f)}) {
    const auto corners = corners_between(from, bent, share);
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const std::uint16_t vertex = bent.triangles[n / 3][n % 3];
      const int column = vertex / 2;
      CHECK(glm::length(corners[n]) == relative(1.0, 1e-5));
      if (column == 0 || column == BentSheet::columns - 1) continue;  // Faces on one side alone.
      const float angle = glm::radians(10.0f) * static_cast<float>(column);
      // A vertex has one triangle on one side and two on the other: a third of half a bend.
      CHECK(glm::dot(corners[n], glm::vec3(std::sin(angle), 0.0f, std::cos(angle))) > std::cos(glm::radians(2.0f)));
    }
  }
  // Neighbouring faces share their normals along the edge between them: no facet is seen.
  const auto half = corners_between(BentSheet(0.0f), bent, 0.5f);
  for (std::size_t n = 0; n < half.size(); ++n)
    for (std::size_t m = 0; m < half.size(); ++m)
      if (bent.triangles[n / 3][n % 3] == bent.triangles[m / 3][m % 3]) CHECK(glm::length(half[n] - half[m]) < 1e-5f);
}

TEST_CASE("an edge of 60 degrees and more stays an edge, and a face without area has a finite normal") {
  const BentSheet sharp(glm::radians(61.0f));
  const auto corners = corners_between(sharp, sharp, 0.3f);
  for (std::size_t n = 0; n < sharp.triangles.size(); ++n) {
    const auto& [a, b, c] = sharp.triangles[n];
    const glm::vec3 own =
        glm::normalize(glm::cross(sharp.places[b] - sharp.places[a], sharp.places[c] - sharp.places[a]));
    for (std::size_t corner = 0; corner < 3; ++corner) CHECK(glm::dot(corners[3 * n + corner], own) > 0.9999f);
  }
  BentSheet fallen(0.0f);
  for (glm::vec3& place : fallen.places) place = {};
  for (const glm::vec3& normal : corners_between(fallen, fallen, 0.0f)) CHECK(normal == glm::vec3(0.0f, 0.0f, 1.0f));
}

}  // namespace septet::frame
