#pragma once
/// Nine deformations of a mesh of 15,300 faces: the cases for repeating the paper's Table 1.

#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/geometry/temporal_normals.hpp"

namespace septet {

struct Morph {
  std::string_view name;
  std::vector<MovingFace> faces;
};

namespace morphs {

using Shape = std::function<glm::vec3(const glm::vec3& direction)>;

/// A sphere's mesh, 90 segments by 86 rings, with vertices moved by `from` and `to`.
inline std::vector<MovingFace> sphere_faces(const Shape& from, const Shape& to) {
  constexpr int segments = 90, rings = 86;
  constexpr float pi = 3.14159265f;
  std::vector<glm::vec3> directions;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const float polar = pi * static_cast<float>(r) / rings, azimuth = 2 * pi * static_cast<float>(s) / segments;
      directions.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                              std::cos(polar));
    }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < segments; ++s) {
      const std::uint32_t a = r * segments + s, b = r * segments + (s + 1) % segments;
      if (r > 0) triangles.push_back({a, a + segments, b});
      if (r < rings - 1) triangles.push_back({b, a + segments, b + segments});
    }
  std::vector<MovingFace> faces(triangles.size());
  for (std::size_t n = 0; n < faces.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) {
      faces[n].from[c] = from(directions[triangles[n][c]]);
      faces[n].to[c] = to(directions[triangles[n][c]]);
    }
  return faces;
}

inline glm::vec3 sphere(const glm::vec3& d) { return d; }
inline glm::vec3 blob(const glm::vec3& d) {
  return d * (1.0f + 0.25f * std::sin(3.0f * d.x + 1.0f) * std::cos(2.0f * d.y) + 0.2f * std::sin(4.0f * d.z));
}
inline glm::vec3 other_blob(const glm::vec3& d) {
  return d * (1.0f + 0.25f * std::cos(3.0f * d.y - 0.5f) + 0.2f * std::sin(4.0f * d.x + 2.0f) * d.z);
}
/// A cube with edges rounded, so that no face is without area.
inline glm::vec3 cube(const glm::vec3& d) {
  const float p = std::pow(
      std::pow(std::abs(d.x), 8.0f) + std::pow(std::abs(d.y), 8.0f) + std::pow(std::abs(d.z), 8.0f), 1.0f / 8.0f);
  return d / p;
}
inline glm::vec3 turned(const glm::vec3& v, float angle_rad, const glm::vec3& axis) {
  return glm::vec3(glm::rotate(glm::mat4(1.0f), angle_rad, glm::normalize(axis)) * glm::vec4(v, 0.0f));
}

}  // namespace morphs

inline std::vector<Morph> all_morphs() {
  using namespace morphs;
  const auto dented = [](const glm::vec3& d) {
    const float depth = 0.7f * std::exp(-8.0f * ((d.y - 0.2f) * (d.y - 0.2f) + d.z * d.z));
    return cube(d) - (d.x > 0.0f ? glm::vec3(depth, 0.0f, 0.0f) : glm::vec3(0.0f));
  };
  return {
      {"blob to another blob", sphere_faces(blob, other_blob)},
      {"blob to blob turned by 0.6 rad", sphere_faces(blob,
                                                      [](const glm::vec3& d) {
                                                        return turned(blob(d), 0.6f, {1, 2, 3});
                                                      })},
      {"blob to other blob turned by 0.8 rad", sphere_faces(blob,
                                                            [](const glm::vec3& d) {
                                                              return turned(other_blob(d), 0.8f, {-1, 1, 1});
                                                            })},
      {"cube turned by 60 degrees", sphere_faces(cube,
                                                 [](const glm::vec3& d) {
                                                   return turned(cube(d), 1.0472f, {0, 0.3f, 1});
                                                 })},
      {"dent of a crash", sphere_faces(cube, dented)},
      {"sphere to blob", sphere_faces(sphere, blob)},
      {"sphere to ellipsoid", sphere_faces(sphere, [](const glm::vec3& d) { return d * glm::vec3(1.6f, 0.8f, 0.7f); })},
      {"cube twisted by a radian", sphere_faces(cube,
                                                [](const glm::vec3& d) {
                                                  return turned(cube(d), 0.5f * cube(d).z, {0, 0, 1});
                                                })},
      {"cube bent", sphere_faces(cube,
                                 [](const glm::vec3& d) {
                                   const glm::vec3 c = cube(d);
                                   return glm::vec3(c.x, c.y, c.z + 0.5f * c.x * c.x);
                                 })},
  };
}

/// Sum of the angles (radians) between exact and interpolated normals over faces and over `samples` instants.
inline double angle_error(const std::vector<MovingFace>& faces, NormalMethod method, int samples = 21) {
  const TemporalNormals normals(method, faces);
  FaceNormals at;
  double sum = 0.0;
  for (int s = 0; s < samples; ++s) {
    const float t = static_cast<float>(s) / static_cast<float>(samples - 1);
    normals.at(t, at);
    for (std::size_t n = 0; n < faces.size(); ++n) {
      const glm::dvec3 exact(face_normal(faces[n], t)), shown(at.x[n], at.y[n], at.z[n]);
      sum += std::atan2(glm::length(glm::cross(exact, shown)), glm::dot(exact, shown));
    }
  }
  return sum;
}

}  // namespace septet
