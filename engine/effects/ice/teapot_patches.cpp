#include "engine/effects/ice/teapot_patches.hpp"

#include <utility>

#include <glm/geometric.hpp>

namespace septet::ice {
namespace {

using Points = std::array<std::array<glm::vec3, 4>, 4>;

/// Radius and height of a profile's control points, so that going along it the outside lies to the left of the turn.
using Profile = std::array<std::array<float, 2>, 4>;
constexpr std::array<Profile, 6> profiles{{
    {{{1.4f, 2.4f}, {1.3375f, 2.53125f}, {1.4375f, 2.53125f}, {1.5f, 2.4f}}},  // Rim.
    {{{1.5f, 2.4f}, {1.75f, 1.875f}, {2.0f, 1.35f}, {2.0f, 0.9f}}},            // Body.
    {{{2.0f, 0.9f}, {2.0f, 0.45f}, {1.5f, 0.225f}, {1.5f, 0.15f}}},
    {{{1.5f, 0.15f}, {1.5f, 0.075f}, {1.425f, 0.0f}, {0.0f, 0.0f}}},  // Bottom.
    {{{0.0f, 3.15f}, {0.8f, 3.15f}, {0.0f, 2.85f}, {0.2f, 2.7f}}},    // Lid.
    {{{0.2f, 2.7f}, {0.4f, 2.55f}, {1.3f, 2.55f}, {1.3f, 2.4f}}},
}};

/// Cross-sections of handle and spout, half of them: x and z of the inner and of the outer point, and half the width.
struct Section {
  float inner_x, inner_z, outer_x, outer_z, half_width;
};
using Tube = std::array<Section, 4>;
constexpr std::array<Tube, 4> tubes{{
    {{{-1.6f, 2.025f, -1.5f, 2.25f, 0.3f},  // Handle, from above.
      {-2.3f, 2.025f, -2.5f, 2.25f, 0.3f},
      {-2.7f, 2.025f, -3.0f, 2.25f, 0.3f},
      {-2.7f, 1.8f, -3.0f, 1.8f, 0.3f}}},
    {{{-2.7f, 1.8f, -3.0f, 1.8f, 0.3f},
      {-2.7f, 1.575f, -3.0f, 1.35f, 0.3f},
      {-2.5f, 1.125f, -2.65f, 0.9375f, 0.3f},
      {-2.0f, 0.9f, -1.9f, 0.6f, 0.3f}}},
    {{{1.7f, 1.425f, 1.7f, 0.6f, 0.66f},  // Spout, from the body.
      {2.6f, 1.425f, 3.1f, 0.825f, 0.66f},
      {2.3f, 2.1f, 2.4f, 2.025f, 0.25f},
      {2.7f, 2.4f, 3.3f, 2.4f, 0.25f}}},
    {{{2.7f, 2.4f, 3.3f, 2.4f, 0.25f},
      {2.8f, 2.475f, 3.525f, 2.49375f, 0.25f},
      {2.9f, 2.475f, 3.45f, 2.5125f, 0.15f},
      {2.8f, 2.4f, 3.2f, 2.4f, 0.15f}}},
}};

std::array<float, 4> bernstein(float t) {
  const float s = 1.0f - t;
  return {s * s * s, 3.0f * s * s * t, 3.0f * s * t * t, t * t * t};
}

TeapotPatch outwards(Points points, const glm::vec3& outside) {
  const TeapotPatch patch{points};
  constexpr float step = 0.01f;
  const glm::vec3 along_u = patch.at(0.5f + step, 0.5f) - patch.at(0.5f - step, 0.5f);
  const glm::vec3 along_v = patch.at(0.5f, 0.5f + step) - patch.at(0.5f, 0.5f - step);
  if (glm::dot(glm::cross(along_u, along_v), outside) < 0.0f)
    for (auto& row : points) {
      std::swap(row[0], row[3]);
      std::swap(row[1], row[2]);
    }
  return {points};
}

}  // namespace

glm::vec3 TeapotPatch::at(float u, float v) const {
  const std::array<float, 4> across = bernstein(u), up = bernstein(v);
  glm::vec3 sum(0.0f);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) sum += across[i] * up[j] * points[j][i];
  return sum;
}

std::vector<TeapotPatch> teapot_patches() {
  constexpr float tangent = 0.56f;
  constexpr std::array<std::array<float, 2>, 4> quarter{{{1, 0}, {1, tangent}, {tangent, 1}, {0, 1}}};
  std::vector<TeapotPatch> patches;
  for (const Profile& profile : profiles)
    for (int turn = 0; turn < 4; ++turn) {
      Points points;
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
          float x = profile[i][0] * quarter[j][0], y = profile[i][0] * quarter[j][1];
          for (int k = 0; k < turn; ++k) x = std::exchange(y, x) * -1.0f;
          points[j][i] = {x, y, profile[i][1]};
        }
      patches.push_back({points});
    }
  for (const Tube& tube : tubes)
    for (const float side : {-1.0f, 1.0f}) {
      Points points;
      for (std::size_t j = 0; j < 4; ++j) {
        const Section& s = tube[j];
        points[j] = {glm::vec3(s.inner_x, 0, s.inner_z), glm::vec3(s.inner_x, side * s.half_width, s.inner_z),
                     glm::vec3(s.outer_x, side * s.half_width, s.outer_z), glm::vec3(s.outer_x, 0, s.outer_z)};
      }
      patches.push_back(outwards(points, {0, side, 0}));
    }
  return patches;
}

}  // namespace septet::ice
