#include "engine/render/passes/ice_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/render/passes/draw_list.hpp"

namespace septet::render {
namespace {

/// Rim of a rectangle, which keeps samples between texels inside.
constexpr float rim_px = 2.0f;
/// Limit of the frustum for a body around the eye: 150° across.
constexpr float widest_slope = 3.7f;
constexpr float nearest_m = 0.05f;

/// Body as its frustum sees it.
struct Seen {
  std::uint32_t body = 0, view = 0;
  glm::vec3 origin{0.0f}, right{0.0f}, up{0.0f}, forward{0.0f};
  float nearest = 0.0f, left = 0.0f, right_slope = 0.0f, bottom = 0.0f, top = 0.0f, extent_m = 0.0f;
  float wide_px = 0.0f, high_px = 0.0f;
};

std::optional<Seen> seen_body(const ice::IceBody& body, const Vec3& eye_m, const ViewVolume& volume,
                              float px_per_slope) {
  Seen seen;
  seen.origin = glm::vec3(body.origin_m - eye_m);
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const ice::IceVertex& vertex : body.vertices) {
    low = glm::min(low, vertex.position_m);
    high = glm::max(high, vertex.position_m);
  }
  const glm::vec3 middle = seen.origin + 0.5f * (low + high);
  seen.extent_m = glm::length(high - low);
  const float distance = glm::length(middle);
  if (!(seen.extent_m > 1e-6f) || !std::isfinite(distance) || !std::isfinite(seen.extent_m)) return std::nullopt;
  if (!intersects(volume, middle, 0.5f * seen.extent_m)) return std::nullopt;
  if (0.5f * seen.extent_m * px_per_slope < 0.5f * distance) return std::nullopt;  // Less than a pixel.
  seen.forward = distance > 1e-3f ? middle / distance : glm::vec3(1, 0, 0);
  const glm::vec3 upright = std::abs(seen.forward.z) < 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  seen.right = glm::normalize(glm::cross(seen.forward, upright));
  seen.up = glm::cross(seen.right, seen.forward);
  seen.left = seen.bottom = widest_slope;
  seen.right_slope = seen.top = -widest_slope;
  seen.nearest = INFINITY;
  for (const ice::IceVertex& vertex : body.vertices) {
    const glm::vec3 at = seen.origin + vertex.position_m;
    const float ahead = std::max(glm::dot(at, seen.forward), nearest_m);
    const float x = glm::dot(at, seen.right) / ahead, y = glm::dot(at, seen.up) / ahead;
    seen.nearest = std::min(seen.nearest, ahead);
    seen.left = std::min(seen.left, x), seen.right_slope = std::max(seen.right_slope, x);
    seen.bottom = std::min(seen.bottom, y), seen.top = std::max(seen.top, y);
  }
  seen.left = std::max(seen.left, -widest_slope), seen.right_slope = std::min(seen.right_slope, widest_slope);
  seen.bottom = std::max(seen.bottom, -widest_slope), seen.top = std::min(seen.top, widest_slope);
  seen.wide_px = std::max(1.0f, (seen.right_slope - seen.left) * px_per_slope);
  seen.high_px = std::max(1.0f, (seen.top - seen.bottom) * px_per_slope);
  return seen;
}

float waves_per_m(const ice::Look& look) {
  return 2.0f * std::numbers::pi_v<float> / std::max(look.bump_size_m, 1e-3f);
}

/// Bump that water leaves: a film fills crystals wholly, waves by half.
float drawn_bump(const ice::Look& look) { return look.bump * (1.0f - 0.5f * std::clamp(look.wetness, 0.0f, 1.0f)); }

float drawn_frost(const ice::Look& look) { return look.roughness * (1.0f - std::clamp(look.wetness, 0.0f, 1.0f)); }

/// Exponent of the sun's highlight: wide over crystals, narrow over water.
float highlight_exponent(const ice::Look& look) {
  const float frost = std::clamp(drawn_frost(look), 0.0f, 1.0f), wetness = std::clamp(look.wetness, 0.0f, 1.0f);
  return 220.0f * std::exp2(2.0f * wetness - 3.0f * frost);
}

IceTile tile_of(const Seen& seen, const ice::IceBody& body, std::uint32_t x, std::uint32_t y, float scale,
                std::uint32_t width, std::uint32_t height) {
  const float wide = std::max(1.0f, std::floor(seen.wide_px * scale)),
              high = std::max(1.0f, std::floor(seen.high_px * scale));
  IceTile tile;
  tile.body = seen.body;
  tile.view = seen.view;
  tile.rectangle = {std::int32_t(x), std::int32_t(y), std::uint32_t(wide + 2.0f * rim_px),
                    std::uint32_t(high + 2.0f * rim_px)};
  const float per_x = wide / std::max(seen.right_slope - seen.left, 1e-6f),
              per_y = high / std::max(seen.top - seen.bottom, 1e-6f);
  const float x0 = float(x) + rim_px - seen.left * per_x, y0 = float(y) + rim_px + seen.top * per_y;
  const ice::Look& look = body.look;
  IceConstants& constants = tile.constants;
  constants.u = glm::vec4((seen.right * per_x + seen.forward * x0) / float(width), drawn_bump(look));
  constants.v = glm::vec4((seen.forward * y0 - seen.up * per_y) / float(height), waves_per_m(look));
  constants.forward = glm::vec4(seen.forward, 0.98f * seen.nearest);
  constants.origin = glm::vec4(seen.origin, look.share_of_sky);
  constants.blend = glm::vec4(1.0f - look.back_share, float(look.back_sign) * look.back_share, drawn_frost(look),
                              look.reflects ? 1.0f : 0.0f);
  constants.absorption = glm::vec4(look.absorption_per_m, seen.extent_m);
  constants.beyond.w = highlight_exponent(look);
  constants.rectangle =
      glm::vec4(tile.rectangle.x, tile.rectangle.y, float(tile.rectangle.x) + float(tile.rectangle.width),
                float(tile.rectangle.y) + float(tile.rectangle.height));
  return tile;
}

/// Finds the bodies beyond a tile's body. `further`: tiles of bodies that lie further away, the nearest last.
void find_beyond(IceTile& tile, std::span<const IceTile> further) {
  const glm::vec3 at(tile.constants.origin), forward(tile.constants.forward);
  const float extent_m = tile.constants.absorption.w, middle_m = tile.constants.forward.w;
  glm::vec4& beyond = tile.constants.beyond;
  beyond = {extent_m, extent_m, middle_m + 1.02f * extent_m, beyond.w};
  for (auto other = further.rbegin(); other != further.rend() && tile.beyond.size() < most_beyond; ++other) {
    if (other->view != tile.view) continue;
    const glm::vec3 there(other->constants.origin);
    const float other_m = other->constants.absorption.w, ahead = glm::dot(there, forward);
    // Light leaves a body within a cone, and mostly along its middle.
    const float aside = glm::length(there - forward * ahead), reach = ahead - glm::dot(at, forward);
    if (!(aside < extent_m + other_m + reach)) continue;
    tile.beyond.push_back(other->body);
    beyond.x = std::max(beyond.x, ahead + other_m - middle_m);
    beyond.y = std::max(beyond.y, other_m);
  }
}

}  // namespace

IceConstants constants_beyond(const IceTile& tile, const ice::IceBody& own, const ice::IceBody& other) {
  IceConstants constants = tile.constants;
  constants.origin += glm::vec4(other.origin_m - own.origin_m, 0.0f);
  constants.u.w = drawn_bump(other.look);
  constants.v.w = waves_per_m(other.look);
  return constants;
}

IceTiles ice_tiles(std::span<const ice::IceBody> bodies, std::span<const FrameView> views, std::uint32_t width,
                   std::uint32_t height) {
  std::vector<Seen> seen;
  for (std::uint32_t v = 0; v < views.size() && !bodies.empty(); ++v) {
    const Vec3 eye_m = world_eye(views[v]);
    const ViewVolume volume = view_volume(views[v]);
    const auto px_per_slope = static_cast<float>(views[v].viewport.height /
                                                 (views[v].projection.top_slope - views[v].projection.bottom_slope));
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      if (auto body = seen_body(bodies[i], eye_m, volume, px_per_slope)) {
        body->body = i;
        body->view = v;
        seen.push_back(*body);
      }
  }
  // High ones first, on shelves from the top.
  std::ranges::stable_sort(seen, std::greater<>(), &Seen::high_px);
  IceTiles tiles;
  for (float scale = 1.0f; scale > 1e-3f; scale *= 0.7f) {
    tiles = {};
    float x = 0.0f, y = 0.0f, shelf = 0.0f;
    bool fits = true;
    for (const Seen& body : seen) {
      const float wide = std::max(1.0f, std::floor(body.wide_px * scale)) + 2.0f * rim_px,
                  high = std::max(1.0f, std::floor(body.high_px * scale)) + 2.0f * rim_px;
      if (x + wide > float(width)) {
        y += shelf;
        x = shelf = 0.0f;
      }
      shelf = std::max(shelf, high);
      if (wide > float(width) || y + high > float(height)) {
        fits = false;
        break;
      }
      tiles.list.push_back(tile_of(body, bodies[body.body], std::uint32_t(x), std::uint32_t(y), scale, width, height));
      x += wide;
      tiles.used_width = std::max(tiles.used_width, std::uint32_t(x));
      tiles.used_height = std::max(tiles.used_height, std::uint32_t(y + shelf));
    }
    if (fits) break;
    tiles = {};
  }
  std::ranges::stable_sort(tiles.list, std::greater<>(), [&](const IceTile& tile) {
    const glm::vec3 at(tile.constants.origin);
    return glm::dot(at, at);
  });
  for (std::size_t i = 0; i < tiles.list.size(); ++i) {
    const ice::Look& look = bodies[tiles.list[i].body].look;
    if (look.mode != ice::Mode::quality || !look.two_sided || !look.seen_beyond) continue;
    find_beyond(tiles.list[i], std::span(tiles.list).first(i));
    tiles.beyond = true;
  }
  return tiles;
}

IceNeighbourhoods ice_neighbourhoods(std::span<const ice::IceBody> bodies, const Vec3& eye_m) {
  // Radius of a group, over which the reflection hardly changes: some metres, and more from afar.
  constexpr double reach_m = 3.0, reach_per_m = 0.1;
  IceNeighbourhoods result;
  std::vector<std::pair<double, std::uint32_t>> by_size;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const ice::IceVertex& vertex : bodies[i].vertices)
      low = glm::min(low, vertex.position_m), high = glm::max(high, vertex.position_m);
    const double size = glm::length(high - low) / std::max(1.0, glm::length(bodies[i].origin_m - eye_m));
    by_size.emplace_back(std::isfinite(size) ? -size : 0.0, i);
  }
  std::ranges::sort(by_size);
  std::vector<Vec3> seeds_m;
  const auto nearest = [&](const Vec3& place_m) {
    std::uint32_t best = 0;
    for (std::uint32_t k = 1; k < seeds_m.size(); ++k)
      if (glm::length(place_m - seeds_m[k]) < glm::length(place_m - seeds_m[best])) best = k;
    return best;
  };
  for (const auto& [size, body] : by_size) {
    const Vec3& place_m = bodies[body].origin_m;
    if (seeds_m.size() == most_neighbourhoods) break;
    const double reach = std::max(reach_m, reach_per_m * glm::length(place_m - eye_m));
    if (seeds_m.empty() || !(glm::length(place_m - seeds_m[nearest(place_m)]) < reach)) seeds_m.push_back(place_m);
  }
  std::vector<Vec3> sums(seeds_m.size(), Vec3(0.0));
  std::vector<double> weights(seeds_m.size(), 0.0);
  for (const ice::IceBody& body : bodies) {
    const std::uint32_t of = nearest(body.origin_m);
    result.of_body.push_back(of);
    // Raised for thin sheets: an eye at the height of a sheet would look into the road under it.
    const Vec3 away = body.origin_m - eye_m + Vec3(0.0, 0.0, body.look.thin ? 0.3 : 0.0);
    const double square = std::max(1.0, glm::dot(away, away)), weight = 1.0 / (square * square);
    sums[of] += weight * away;
    weights[of] += weight;
  }
  for (std::size_t k = 0; k < seeds_m.size(); ++k)
    result.middles_m.push_back(weights[k] > 0.0 ? eye_m + sums[k] / weights[k] : seeds_m[k]);
  return result;
}

std::vector<Vec3> seen_neighbourhoods(const IceNeighbourhoods& neighbourhoods, IceTiles& tiles) {
  std::vector<Vec3> seen;
  std::vector<std::optional<std::uint32_t>> place(neighbourhoods.middles_m.size());
  for (IceTile& tile : tiles.list) {
    auto& around = place[neighbourhoods.of_body[tile.body]];
    if (!around) {
      around = static_cast<std::uint32_t>(seen.size());
      seen.push_back(neighbourhoods.middles_m[neighbourhoods.of_body[tile.body]]);
    }
    tile.around = *around;
  }
  return seen;
}

std::vector<FrameView> surrounding_views(const Vec3& middle_m, std::uint32_t side_px) {
  constexpr double quarter = 0.5 * std::numbers::pi, near_m = 0.02;
  constexpr std::array<std::array<double, 2>, 6> ways{
      {{0.0, 0.0}, {2.0 * quarter, 0.0}, {quarter, quarter}, {quarter, -quarter}, {quarter, 0.0}, {-quarter, 0.0}}};
  std::vector<FrameView> views(ways.size());
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    views[i].projection = symmetric_view(Vec3(0.0), ways[i][0], ways[i][1], quarter, quarter, near_m);
    views[i].world_from_car.position_m = middle_m;
    views[i].viewport = {std::int32_t(i % 3 * side_px), std::int32_t(i / 3 * side_px), side_px, side_px};
  }
  return views;
}

}  // namespace septet::render
