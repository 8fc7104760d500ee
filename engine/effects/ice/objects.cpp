#include "engine/effects/ice/objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/effects/ice/teapot_patches.hpp"

namespace septet::ice {
namespace {

constexpr float pi = 3.14159265f;

using Corner = std::array<std::int32_t, 3>;

/// Corners within a thousandth of a millimetre of each other are one.
Corner corner_of(const glm::vec3& at) {
  const auto rounded = [](float x) {
    return static_cast<std::int32_t>(std::lround(std::clamp(x, -1e3f, 1e3f) * 1e6f));
  };
  return {rounded(at.x), rounded(at.y), rounded(at.z)};
}

}  // namespace

void smooth(Surface& surface) {
  std::map<Corner, glm::vec3> sums;
  const auto across = [&](std::size_t i) {
    return glm::cross(surface[i + 1].position_m - surface[i].position_m,
                      surface[i + 2].position_m - surface[i].position_m);
  };
  for (std::size_t i = 0; i + 2 < surface.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c)
      sums.try_emplace(corner_of(surface[i + c].position_m), 0.0f).first->second += across(i);
  for (std::size_t i = 0; i + 2 < surface.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec3 sum = sums[corner_of(surface[i + c].position_m)];
      const float length = glm::length(sum);
      surface[i + c].normal = length > 0.0f ? sum / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
}

void fit(Surface& surface) {
  const Box box = bounds(surface);
  const glm::vec3 middle = 0.5f * (box.min_m + box.max_m);
  float reach = 0.0f;
  for (const IceVertex& vertex : surface) reach = std::max(reach, glm::length(vertex.position_m - middle));
  for (IceVertex& vertex : surface)
    vertex.rest_m = vertex.position_m = (vertex.position_m - middle) * (reach > 0.0f ? 0.5f / reach : 1.0f);
}

namespace {

Surface finished(Surface surface) {
  fit(surface);
  smooth(surface);
  return surface;
}

/// Two triangles a cell, counter-clockwise where ∂u × ∂v points outwards; those without area are left out.
void add_patch(Surface& surface, int columns, int rows, const std::function<glm::vec3(float u, float v)>& at) {
  const auto point = [&](int i, int j) {
    return IceVertex{
        at(static_cast<float>(i) / static_cast<float>(columns), static_cast<float>(j) / static_cast<float>(rows)),
        {},
        {}};
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const IceVertex a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      for (const auto& triangle : {std::array{a, b, c}, std::array{a, c, d}}) {
        const glm::vec3 area = glm::cross(triangle[1].position_m - triangle[0].position_m,
                                          triangle[2].position_m - triangle[0].position_m);
        if (glm::dot(area, area) > 0.0f) surface.insert(surface.end(), triangle.begin(), triangle.end());
      }
    }
}

/// A ball whose radius depends on the direction: `columns` around z, `rows` from pole to pole.
Surface ball(int columns, int rows, const std::function<float(const glm::vec3&)>& radius) {
  Surface surface;
  add_patch(surface, columns, rows, [&](float u, float v) {
    // The seam and the poles meet to the bit.
    const float around = u == 1.0f ? 0.0f : 2.0f * pi * u, down = pi * (1.0f - v);
    const float level = v == 0.0f || v == 1.0f ? 0.0f : std::sin(down);
    const glm::vec3 direction(level * std::cos(around), level * std::sin(around), std::cos(down));
    return radius(direction) * direction;
  });
  return finished(std::move(surface));
}

}  // namespace

Surface sphere() {
  return ball(32, 16, [](const glm::vec3&) { return 1.0f; });
}

Surface peanut() {
  return ball(128, 96, [](const glm::vec3& d) { return 0.55f + 0.45f * d.x * d.x; });
}

Surface cube() {
  constexpr int cells = 20;
  constexpr float round = 0.22f;
  const auto uneven = [](const glm::vec3& p) {
    return 0.020f * (std::sin(5.1f * p.x + 2.0f * p.y + 0.3f) + std::sin(4.3f * p.y - 2.6f * p.z + 1.1f) +
                     std::sin(4.7f * p.z + 2.2f * p.x + 2.7f));
  };
  Surface surface;
  for (int face = 0; face < 6; ++face)
    add_patch(surface, cells, cells, [&](float u, float v) {
      const auto axis = static_cast<glm::length_t>(face / 2), b = (axis + 1) % 3, c = (axis + 2) % 3;
      const float sign = face % 2 == 0 ? 1.0f : -1.0f;
      glm::vec3 p;
      p[axis] = sign, p[b] = 2.0f * u - 1.0f, p[c] = sign * (2.0f * v - 1.0f);
      const glm::vec3 core = glm::clamp(p, glm::vec3(round - 1.0f), glm::vec3(1.0f - round));
      const glm::vec3 outwards = glm::normalize(p - core);
      p = core + round * outwards;
      return p + uneven(p) * outwards;
    });
  return finished(std::move(surface));
}

Surface teapot() {
  Surface surface;
  for (const TeapotPatch& patch : teapot_patches())
    add_patch(surface, 15, 15, [&](float u, float v) { return patch.at(u, v); });
  return finished(std::move(surface));
}

Expected<Surface> object(std::string_view name) {
  if (name == "sphere") return sphere();
  if (name == "cube") return cube();
  if (name == "peanut") return peanut();
  if (name == "teapot") return teapot();
  return failure(fmt::format("there is no object \"{}\"", name), "ice",
                 "take sphere, cube, peanut, teapot or an OBJ file");
}

Box bounds(const Surface& surface) {
  if (surface.empty()) return {};
  Box box{surface.front().position_m, surface.front().position_m};
  for (const IceVertex& vertex : surface) {
    box.min_m = glm::min(box.min_m, vertex.position_m);
    box.max_m = glm::max(box.max_m, vertex.position_m);
  }
  return box;
}

Faults faults(const Surface& surface) {
  Faults result;
  std::map<std::array<Corner, 2>, int> edges;
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < surface.size(); i += 3) {
    const glm::dvec3 a(surface[i].position_m), b(surface[i + 1].position_m), c(surface[i + 2].position_m);
    if (glm::length(glm::cross(b - a, c - a)) < 1e-14) ++result.flat_triangles;
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner from = corner_of(surface[i + k].position_m), to = corner_of(surface[i + (k + 1) % 3].position_m);
      if (from == to) continue;
      edges[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, balance] : edges) result.open_edges += balance != 0;
  result.inverted = volume < 0.0;
  const Box box = bounds(surface);
  result.empty = surface.empty() || glm::length(box.max_m - box.min_m) < 1e-6f;
  return result;
}

std::string told(const Faults& faults) {
  std::string text;
  const auto say = [&](const std::string& what) { text += text.empty() ? what : "; " + what; };
  if (faults.empty) say("it has no extent and cannot be seen");
  if (faults.open_edges > 0)
    say(fmt::format("{} open edges: where it is open, light leaves it early", faults.open_edges));
  if (faults.flat_triangles > 0) say(fmt::format("{} triangles without area are not drawn", faults.flat_triangles));
  if (faults.inverted) say("it is inside out: turn its faces round");
  return text;
}

}  // namespace septet::ice
