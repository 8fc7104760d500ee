#include "engine/instant/mirror_glass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace septet::instant {
namespace {

constexpr int rings = 8, sides = 64;
/// Distance along a ray of the point that is looked up in the picture.
constexpr double sight_m = 9.0;
/// Near-plane margin beyond the glass, which cuts off the frame before its rim; it would appear in the glass as a line.
constexpr double lip_m = 0.02;

struct GlassPoint {
  Vec3 position_m, ray;
  Vec2 slopes{0.0};  ///< Slopes of the reflected point in the picture's view.
  Vec2 pixel{0.0};   ///< Place of the glass's point in the view.
};

struct Box {
  Vec2 low{1e30}, high{-1e30};
  void take(const Vec2& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  bool meets(const Vec2& size) const { return low.x < size.x && low.y < size.y && high.x > 0.0 && high.y > 0.0; }
  bool within(const Vec2& size) const { return low.x >= 0.0 && low.y >= 0.0 && high.x <= size.x && high.y <= size.y; }
};

/// Point nearest to all rays run backwards.
Vec3 meeting_point(const std::vector<GlassPoint>& points) {
  glm::dmat3 sum(0.0);
  Vec3 right(0.0);
  for (const GlassPoint& point : points) {
    const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(point.ray, point.ray);
    sum += across;
    right += across * point.position_m;
  }
  return glm::inverse(sum) * right;
}

}  // namespace

glm::dvec2 glass_outline(const glm::dvec2& half_m, double angle_rad, double share) {
  constexpr double power = 2.0 / 5.0;  // Superellipse of degree 5.
  const auto along = [&](double x) { return std::copysign(std::pow(std::abs(x), power), x); };
  return share * half_m * glm::dvec2(along(std::cos(angle_rad)), along(std::sin(angle_rad)));
}

std::optional<MirrorGlass> mirror_glass(const ScreenCorners& glass, double radius_m, const OffAxisView& through,
                                        const PixelRectangle& size) {
  const Vec3& eye_m = through.eye_m;
  const auto facing = off_axis_view(glass, eye_m);
  if (!facing || !(radius_m >= 0.0)) return std::nullopt;
  const Vec3 middle_m = 0.5 * (glass.lower_right_m + glass.upper_left_m);
  const Vec2 half_m(0.5 * glm::distance(glass.lower_left_m, glass.lower_right_m),
                    0.5 * glm::distance(glass.lower_left_m, glass.upper_left_m));
  const bool convex = radius_m > 0.0;
  if (convex && !(radius_m > 1.01 * glm::length(half_m))) return std::nullopt;
  const Vec2 size_px(size.width, size.height);

  std::vector<GlassPoint> points;
  Box seen;
  for (int ring = 0; ring <= rings; ++ring)
    for (int side = 0; side < (ring == 0 ? 1 : sides); ++side) {
      const Vec2 place = glass_outline(half_m, 2.0 * std::numbers::pi * side / sides, double(ring) / rings);
      const double deep_m = convex ? radius_m - std::sqrt(radius_m * radius_m - glm::dot(place, place)) : 0.0;
      GlassPoint point;
      point.position_m = middle_m + place.x * facing->right + place.y * facing->up - deep_m * facing->back;
      const Vec3 normal = convex ? (point.position_m - (middle_m - radius_m * facing->back)) / radius_m : facing->back;
      const Vec3 incident = glm::normalize(point.position_m - eye_m);
      point.ray = glm::reflect(incident, normal);
      const glm::dvec4 clip = through.clip_from_eye_relative * glm::dvec4(point.position_m - eye_m, 1.0);
      // The rim of a convex glass may turn away from an eye beside it, and a view has a near plane.
      if (glm::dot(incident, normal) > -0.02 || glm::dot(point.ray, facing->back) < 0.05 || clip.w < through.near_m)
        return std::nullopt;
      point.pixel = (0.5 + 0.5 * Vec2(clip.x, clip.y) / clip.w) * size_px;
      seen.take(point.pixel);
      points.push_back(point);
    }
  if (!seen.meets(size_px)) return std::nullopt;

  // Seen from behind the glass, its left side is the right one.
  const Vec3 image_m = meeting_point(points), right = -facing->right, up = facing->up, ahead = facing->back;
  double near_m = 1e30;
  for (GlassPoint& point : points) {
    const Vec3 way = point.position_m + sight_m * point.ray - image_m;
    const double far_m = glm::dot(way, ahead);
    point.slopes = {glm::dot(way, right) / far_m, glm::dot(way, up) / far_m};
    near_m = std::min(near_m, glm::dot(point.position_m - image_m, ahead));
  }

  // Triangles within the view: a glass may continue on the next screen.
  std::vector<std::array<std::size_t, 3>> triangles;
  Box pixels, slopes;
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    Box box;
    for (const std::size_t i : {a, b, c}) box.take(points[i].pixel);
    if (!box.meets(size_px)) return;
    triangles.push_back({a, b, c});
    for (const std::size_t i : {a, b, c}) {
      pixels.take(points[i].pixel);
      slopes.take(points[i].slopes);
    }
  };
  const auto on_ring = [](int ring, int side) {
    return ring == 0 ? std::size_t{0} : 1 + std::size_t(ring - 1) * sides + std::size_t(side % sides);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      triangle(on_ring(ring, side), on_ring(ring + 1, side), on_ring(ring + 1, side + 1));
      if (ring > 0) triangle(on_ring(ring, side), on_ring(ring + 1, side + 1), on_ring(ring, side + 1));
    }
  if (triangles.empty() || !(near_m > 1e-4)) return std::nullopt;

  MirrorGlass result;
  result.wholly_seen = seen.within(size_px);
  constexpr double least_px = 8.0, most_px = 2048.0;
  const Vec2 extent_px = glm::clamp(glm::ceil(pixels.high - pixels.low), Vec2(least_px), Vec2(most_px));
  result.picture.viewport = {0, 0, static_cast<std::uint32_t>(extent_px.x), static_cast<std::uint32_t>(extent_px.y)};
  // One pixel more at each edge keeps out the light of neighbouring pictures.
  const Vec2 rim = (slopes.high - slopes.low) / (extent_px - 2.0);
  slopes.low -= rim;
  slopes.high += rim;
  const auto corner = [&](double x, double y) { return image_m + ahead + x * right + y * up; };
  const auto projection = off_axis_view(
      {corner(slopes.low.x, slopes.low.y), corner(slopes.high.x, slopes.low.y), corner(slopes.low.x, slopes.high.y)},
      image_m, near_m + lip_m);
  if (!projection) return std::nullopt;
  result.picture.projection = *projection;
  for (const auto& corners : triangles)
    for (const std::size_t i : corners) {
      const Vec2 share = (points[i].slopes - slopes.low) / (slopes.high - slopes.low);
      result.corners.push_back({points[i].position_m, glm::vec2(share.x, 1.0 - share.y)});
    }
  return result;
}

}  // namespace septet::instant
