#include "engine/effects/ice/glass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"

namespace septet::ice {
namespace {

const Vec3& point(const PaneShape& pane, std::size_t column, std::size_t row) {
  return pane.points_m[row * pane.columns + column];
}

/// Forward and up.
Vec3 normal_at(const PaneShape& pane, double across, double up) {
  constexpr double off = 0.02;
  const double a = std::clamp(across, off, 1.0 - off), b = std::clamp(up, off, 1.0 - off);
  const Vec3 normal = glm::cross(place_on(pane, a + off, b) - place_on(pane, a - off, b),
                                 place_on(pane, a, b + off) - place_on(pane, a, b - off));
  const double length = glm::length(normal);
  return length > 1e-12 ? normal / length : Vec3(1.0, 0.0, 0.0);
}

/// x at which a line along +x meets the triangles furthest forward; empty where it misses them all.
double furthest_x(std::span<const Vec3> triangles_m, double y_m, double z_m) {
  double furthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 2 < triangles_m.size(); i += 3) {
    const Vec3 &a = triangles_m[i], &b = triangles_m[i + 1], &c = triangles_m[i + 2];
    const double area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
    if (!(std::abs(area) > 1e-12)) continue;
    const double u = ((y_m - a.y) * (c.z - a.z) - (z_m - a.z) * (c.y - a.y)) / area,
                 v = ((b.y - a.y) * (z_m - a.z) - (b.z - a.z) * (y_m - a.y)) / area;
    constexpr double slack = -1e-3;
    if (u >= slack && v >= slack && u + v <= 1.0 - slack)
      furthest = std::max(furthest, a.x + u * (b.x - a.x) + v * (c.x - a.x));
  }
  return furthest;
}

using Place = glm::dvec2;  // On the pane, m.

/// Width of a drawn strip over that of its crack, so that a crack of less than a pixel is not lost between two.
constexpr double strip_widths = 3.0;

struct Drawing {
  const PaneShape& pane;
  Place size;
  std::vector<IceVertex>& surface;

  void put(const Place& place, const Vec3& normal, const glm::vec3& rest) const {
    const Place at = glm::clamp(place, Place(0.0), size) / size;
    surface.push_back({glm::vec3(place_on(pane, at.x, at.y)), glm::vec3(normal), rest});
  }
  /// `tilt`: inclination of a crack's face out of the upright, so that each reflects from another direction.
  void strip(const Place& a, const Place& b, double width_a, double width_b, double along_m, double tilt) const {
    const Place way = b - a;
    const double length = glm::length(way);
    if (!(length > 1e-6)) return;
    const Place middle = glm::clamp(0.5 * (a + b), Place(0.0), size), side = Place(-way.y, way.x) / length;
    if (middle != 0.5 * (a + b)) return;  // The crack has left the pane.
    const Vec3 out = normal_at(pane, middle.x / size.x, middle.y / size.y);
    const Vec3 along = place_on(pane, (middle.x + 0.01 * side.x) / size.x, (middle.y + 0.01 * side.y) / size.y) -
                       place_on(pane, (middle.x - 0.01 * side.x) / size.x, (middle.y - 0.01 * side.y) / size.y);
    if (!(glm::length(along) > 1e-9)) return;
    const Vec3 normal = glm::normalize(glm::normalize(along) + tilt * out);
    const Place off_a = strip_widths * width_a * side, off_b = strip_widths * width_b * side;
    const std::array<Place, 4> places{a - off_a, b - off_b, b + off_b, a + off_a};
    const std::array<glm::vec3, 4> rest{
        {{along_m, -1, 0}, {along_m + length, -1, 0}, {along_m + length, 1, 0}, {along_m, 1, 0}}};
    for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) put(places[i], normal, rest[i]);
  }
  /// Crushed glass around the middle.
  void crush(const Place& middle, double radius_m, Random& random) const {
    constexpr int corners = 18;
    std::array<double, corners> radii{};
    for (double& radius : radii) radius = radius_m * random.uniform(0.55, 1.0);
    const Vec3 out = normal_at(pane, middle.x / size.x, middle.y / size.y);
    for (int i = 0; i < corners; ++i) {
      const auto at = [&](int k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        return radii[static_cast<std::size_t>(k % corners)] * Place(std::cos(angle), std::sin(angle));
      };
      const Place a = at(i), b = at(i + 1);
      put(middle, out, {0, 0, 1});
      put(middle + a, out, {a.x, a.y, 2});
      put(middle + b, out, {b.x, b.y, 2});
    }
  }
};

}  // namespace

Star star_of_blow(double across, double closing_mps, std::uint64_t seed) {
  Random random(seed, 10);
  Star star;
  star.across = std::clamp(across + random.uniform(-0.1, 0.1), 0.1, 0.9);
  star.up = random.uniform(0.25, 0.75);
  star.reach_m = std::clamp(crack_s * closing_mps, 0.0, longest_crack_m);
  star.seed = static_cast<std::uint32_t>(random.below(1U << 31));
  return star;
}

PaneShape pane_between(const Vec3& foot_right_m, const Vec3& foot_left_m, const Vec3& head_right_m,
                       const Vec3& head_left_m, double bulge_m) {
  PaneShape pane{17, 3, {}};
  for (std::size_t j = 0; j < pane.rows; ++j)
    for (std::size_t i = 0; i < pane.columns; ++i) {
      const double across = static_cast<double>(i) / static_cast<double>(pane.columns - 1),
                   up = static_cast<double>(j) / static_cast<double>(pane.rows - 1), off = 2.0 * across - 1.0;
      const Vec3 foot = glm::mix(foot_right_m, foot_left_m, across), head = glm::mix(head_right_m, head_left_m, across);
      pane.points_m.push_back(glm::mix(foot, head, up) + Vec3(bulge_m * (1.0 - off * off), 0.0, 0.0));
    }
  return pane;
}

PaneShape pane_on(std::span<const Vec3> triangles_m) {
  constexpr std::size_t columns = 17, rows = 9;
  constexpr double lift_m = 0.004;  // Height over the glass below.
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& corner : triangles_m) low = std::min(low, corner.z), high = std::max(high, corner.z);
  if (!(high - low > 0.1) || !(high - low < 3.0)) return {};
  PaneShape pane{columns, rows, {}};
  for (std::size_t j = 0; j < rows; ++j) {
    // A little within the edges, which the triangles' corners need not reach.
    const double z = low + (high - low) * (0.04 + 0.92 * static_cast<double>(j) / (rows - 1));
    double right = std::numeric_limits<double>::infinity(), left = -right;
    for (std::size_t i = 0; i + 2 < triangles_m.size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = triangles_m[i + k], &b = triangles_m[i + (k + 1) % 3];
        if ((a.z <= z) == (b.z <= z)) continue;
        const double y = std::lerp(a.y, b.y, (z - a.z) / (b.z - a.z));
        right = std::min(right, y), left = std::max(left, y);
      }
    if (!(left - right > 0.2)) return {};
    for (std::size_t i = 0; i < columns; ++i) {
      const double y = std::lerp(right, left, 0.03 + 0.94 * static_cast<double>(i) / (columns - 1));
      const double x = furthest_x(triangles_m, y, z);
      if (!std::isfinite(x)) return {};
      pane.points_m.emplace_back(x, y, z);
    }
  }
  const PaneShape flush = pane;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      pane.points_m[j * columns + i] +=
          lift_m * normal_at(flush, static_cast<double>(i) / (columns - 1), static_cast<double>(j) / (rows - 1));
  return pane;
}

Vec3 place_on(const PaneShape& pane, double across, double up) {
  if (pane.empty()) return Vec3(0.0);
  const auto within = [](double share) { return share > 0.0 ? std::min(share, 1.0) : 0.0; };  // NaN becomes 0, too.
  const double x = within(across) * static_cast<double>(pane.columns - 1),
               y = within(up) * static_cast<double>(pane.rows - 1);
  const auto i = std::min(static_cast<std::size_t>(x), pane.columns - 2),
             j = std::min(static_cast<std::size_t>(y), pane.rows - 2);
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  return glm::mix(glm::mix(point(pane, i, j), point(pane, i + 1, j), u),
                  glm::mix(point(pane, i, j + 1), point(pane, i + 1, j + 1), u), v);
}

double width_m(const PaneShape& pane) {
  return 0.5 * (glm::length(place_on(pane, 1.0, 0.0) - place_on(pane, 0.0, 0.0)) +
                glm::length(place_on(pane, 1.0, 1.0) - place_on(pane, 0.0, 1.0)));
}
double height_m(const PaneShape& pane) { return glm::length(place_on(pane, 0.5, 1.0) - place_on(pane, 0.5, 0.0)); }

std::vector<IceVertex> frost_surface(const PaneShape& pane, const Frost& frost) {
  constexpr std::size_t columns = 72, rows = 32;
  std::vector<IceVertex> surface;
  if (!(frost.thickness_kgpm2 > 0.0) || pane.empty()) return surface;
  const double width = width_m(pane), height = height_m(pane), grown_m = 0.37 * (frost.seed % 1024);
  std::vector<IceVertex> corners;
  for (std::size_t j = 0; j <= rows; ++j)
    for (std::size_t i = 0; i <= columns; ++i) {
      const double across = static_cast<double>(i) / columns, up = static_cast<double>(j) / rows;
      corners.push_back({glm::vec3(place_on(pane, across, up)), glm::vec3(normal_at(pane, across, up)),
                         glm::vec3(across * width + grown_m, up * height, frost_kgpm2(frost, across, up))});
    }
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t a = j * (columns + 1) + i, b = a + columns + 1;
      const std::array<std::size_t, 6> order{a, a + 1, b + 1, a, b + 1, b};
      if (std::ranges::any_of(order, [&](std::size_t k) { return corners[k].rest_m.z > 0.0f; }))
        for (const std::size_t k : order) surface.push_back(corners[k]);
    }
  return surface;
}

std::vector<IceVertex> star_surface(const PaneShape& pane, const Star& star) {
  constexpr int least_rays = 11, more_rays = 8, steps = 10;
  constexpr double half_width_m = 0.0012;
  std::vector<IceVertex> surface;
  const Place size(width_m(pane), height_m(pane));
  if (pane.empty() || !(size.x > 0.01) || !(size.y > 0.01) || !(star.reach_m > 0.0)) return surface;
  if (!std::isfinite(star.across) || !std::isfinite(star.up)) return surface;
  const Place middle(star.across * size.x, star.up * size.y);
  const Drawing drawing{pane, size, surface};
  Random random(star.seed, 9);
  const int rays = least_rays + static_cast<int>(random.below(more_rays));
  std::vector<std::array<Place, steps + 1>> paths;
  for (int k = 0; k < rays; ++k) {
    double angle = 2.0 * std::numbers::pi * (k + 0.6 * (random.uniform() - 0.5)) / rays, along_m = random.uniform();
    const double length_m = star.reach_m * random.uniform(0.4, 1.0);
    auto& path = paths.emplace_back();
    path[0] = middle;
    for (std::size_t i = 1; i <= steps; ++i) {
      angle += 0.20 * (random.uniform() - 0.5);
      path[i] = path[i - 1] + length_m / steps * Place(std::cos(angle), std::sin(angle));
    }
    for (std::size_t i = 0; i < steps; ++i) {
      const auto width = [&](std::size_t at) { return half_width_m * (1.25 - static_cast<double>(at) / steps); };
      drawing.strip(path[i], path[i + 1], width(i), width(i + 1), along_m, random.uniform(-0.5, 0.5));
      along_m += length_m / steps;
    }
  }
  // Rings, denser near the middle, from one ray to the next; each bends outwards and some are missing.
  for (const double share : {0.055, 0.10, 0.17, 0.27, 0.42})
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const bool there = random.uniform() < (share < 0.2 ? 0.9 : 0.6);
      const double off = share * star.reach_m * random.uniform(0.9, 1.1), tilt = random.uniform(-0.5, 0.5);
      const auto on = [&](const std::array<Place, steps + 1>& path) -> Place {
        for (std::size_t i = 0; i < steps; ++i) {
          const double a = glm::length(path[i] - middle), b = glm::length(path[i + 1] - middle);
          if (b >= off && b > a) return glm::mix(path[i], path[i + 1], std::clamp((off - a) / (b - a), 0.0, 1.0));
        }
        return middle;
      };
      const Place from = on(paths[k]), to = on(paths[(k + 1) % paths.size()]);
      if (!there || from == middle || to == middle) continue;
      const Place half = middle + (0.5 * (from + to) - middle) * 1.04;
      drawing.strip(from, half, 0.7 * half_width_m, 0.7 * half_width_m, 3.0 * share, tilt);
      drawing.strip(half, to, 0.7 * half_width_m, 0.7 * half_width_m, 3.0 * share + glm::length(half - from), tilt);
    }
  drawing.crush(middle, std::min(0.045, 0.09 * star.reach_m + 0.004), random);
  return surface;
}

}  // namespace septet::ice
