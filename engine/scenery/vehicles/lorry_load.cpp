#include "engine/scenery/vehicles/lorry_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Adds a bar along the vehicle with an elliptic section and flat ends, pulled in by `end_m` at both.
void add_barrel(MeshBuilder& builder, Finish finish, float rear, float front, const glm::vec3& middle, float half_width,
                float half_height, float end_m, std::uint32_t sides) {
  const std::array<geometry::LathePoint, 6> profile{{{0.0f, rear},
                                                     {1.0f - 2.0f * end_m, rear},
                                                     {1.0f, rear + end_m},
                                                     {1.0f, front - end_m},
                                                     {1.0f - 2.0f * end_m, front},
                                                     {0.0f, front}}};
  // Maps the lathe's axis z to x and its x to y.
  const glm::mat4 along(glm::vec4(0, half_width, 0, 0), glm::vec4(0, 0, half_height, 0), glm::vec4(1, 0, 0, 0),
                        glm::vec4(0, middle.y, middle.z, 1));
  builder.material = index_of(finish);
  geometry::PolygonMesh barrel = geometry::lathe(profile, sides);
  geometry::crease_by_angle(barrel, 0.8f);
  builder.append(barrel, along, true);
}

void add_cargo_box(MeshBuilder& builder, const LoadBay& b, DetailLevel level) {
  add_box(builder, Finish::tarpaulin, {b.rear, -b.half, b.floor}, {b.front, b.half, b.height},
          level == DetailLevel::near ? 0.04f : 0.0f);
  if (level == DetailLevel::far) return;
  builder.material = index_of(Finish::trim);
  // Two doors in a frame: the lines between and around them, locking bars and hinges.
  const float low = b.floor + 0.12f, high = b.height - 0.1f, edge = b.half - 0.07f;
  const auto on_rear = [&](Finish finish, float left, float right, float from, float to, float lift = 0.008f) {
    const float x = b.rear - lift;
    builder.material = index_of(finish);
    builder.patch({x, left, from}, {x, right, from}, {x, right, to}, {x, left, to});
  };
  on_rear(Finish::trim, 0.014f, -0.014f, low, high);
  for (const float side : {1.0f, -1.0f}) on_rear(Finish::trim, side * edge + 0.012f, side * edge - 0.012f, low, high);
  for (const float z : {low, high}) on_rear(Finish::trim, edge, -edge, z - 0.012f, z + 0.012f);
  if (level == DetailLevel::near)
    for (const float side : {1.0f, -1.0f}) {
      for (const float y : {0.22f, 0.62f}) {
        on_rear(Finish::chrome, side * y + 0.017f, side * y - 0.017f, low + 0.03f, high - 0.03f, 0.016f);
        on_rear(Finish::trim, side * y + 0.06f, side * y - 0.06f, low + 0.55f, low + 0.68f, 0.02f);
      }
      for (int k = 0; k < 4; ++k) {
        const float z = std::lerp(low + 0.2f, high - 0.2f, static_cast<float>(k) / 3.0f);
        on_rear(Finish::trim, side * (edge - 0.07f) + 0.1f, side * (edge - 0.07f) - 0.1f, z - 0.03f, z + 0.03f, 0.012f);
      }
    }
  builder.material = index_of(Finish::livery_blue);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * (b.half + 0.006f), a = side > 0 ? b.front - 0.3f : b.rear + 0.4f,
                c = side > 0 ? b.rear + 0.4f : b.front - 0.3f;
    builder.patch({a, y, 1.75f}, {c, y, 1.75f}, {c, y, 2.15f}, {a, y, 2.15f});
  }
}

void add_tank(MeshBuilder& builder, const LoadBay& b, DetailLevel level) {
  const std::uint32_t sides = level == DetailLevel::near ? 28 : level == DetailLevel::middle ? 14 : 8;
  const float low = b.floor + 0.08f, top = b.height - 0.18f;
  add_barrel(builder, Finish::white_panel, b.rear + 0.05f, b.front, {0, 0, (low + top) / 2}, b.half - 0.03f,
             (top - low) / 2, 0.12f, sides);
  if (level == DetailLevel::far) return;
  add_box(builder, Finish::trim, {b.rear + 0.6f, -0.32f, top - 0.03f}, {b.front - 0.6f, 0.32f, top + 0.06f});
  if (level != DetailLevel::near) return;
  for (int k = 0; k < 4; ++k) {  // Manholes.
    const float x = std::lerp(b.rear + 1.5f, b.front - 1.2f, static_cast<float>(k) / 3.0f);
    builder.material = index_of(Finish::chrome);
    builder.append(geometry::cylinder(0.26f, top + 0.02f, b.height, 12),
                   glm::translate(glm::mat4(1.0f), glm::vec3(x, 0, 0)), true);
  }
  builder.material = index_of(Finish::fire_red);
  const float x = b.rear + 0.04f;
  builder.patch({x, 0.4f, 1.7f}, {x, -0.4f, 1.7f}, {x, -0.4f, 2.0f}, {x, 0.4f, 2.0f});
}

void add_tipper(MeshBuilder& builder, const LoadBay& b, DetailLevel level) {
  // Walls below the shield over the cab.
  const float top = b.height - 0.5f, wall = 0.09f;
  const auto side_wall = [&](float side) {
    const float inner = side * (b.half - wall), outer = side * (b.half - 0.01f);
    add_box(builder, Finish::livery_yellow, {b.rear, std::min(inner, outer), b.floor},
            {b.front, std::max(inner, outer), top});
  };
  side_wall(1.0f), side_wall(-1.0f);
  add_box(builder, Finish::livery_yellow, {b.front - wall, -b.half + wall, b.floor},
          {b.front, b.half - wall, b.height});
  add_box(builder, Finish::livery_yellow, {b.rear, -b.half + wall, b.floor},
          {b.rear + wall, b.half - wall, top - 0.1f});
  add_box(builder, Finish::underbody, {b.rear + wall, -b.half + wall, b.floor},
          {b.front - wall, b.half - wall, top - 0.35f});
  if (level == DetailLevel::far) return;
  for (int k = 0; k <= 6; ++k) {
    const float x = std::lerp(b.rear + 0.1f, b.front - 0.2f, static_cast<float>(k) / 6.0f);
    for (const float side : {1.0f, -1.0f})
      add_box(builder, Finish::livery_yellow, {x, side > 0 ? b.half - 0.02f : -b.half - 0.018f, b.floor},
              {x + 0.1f, side > 0 ? b.half + 0.018f : -b.half + 0.02f, top});
  }
  // Shield over the cab.
  add_box(builder, Finish::livery_yellow, {b.front, -b.half + 0.3f, b.height - 0.08f},
          {b.front + 0.75f, b.half - 0.3f, b.height});
}

void add_timber(MeshBuilder& builder, const LoadBay& b, DetailLevel level) {
  const bool far = level == DetailLevel::far;
  const float top = b.height - 0.1f, log = 0.28f, row_m = 1.75f * log;
  // As many rows of logs as lie between the posts, whose ends stand over them.
  const float lowest = b.floor + 0.12f + log;
  const int rows = 1 + static_cast<int>((top - log - lowest) / row_m);
  add_box(builder, Finish::trim, {b.front - 0.1f, -b.half + 0.1f, b.floor}, {b.front, b.half - 0.1f, b.height});
  if (level != DetailLevel::near)
    add_box(builder, Finish::timber, {b.rear, -b.half + 0.15f, b.floor + 0.1f},
            {b.front - 0.4f, b.half - 0.15f, far ? top : lowest + static_cast<float>(rows - 1) * row_m - 0.25f * log});
  if (!far) {
    const std::uint32_t sides = level == DetailLevel::near ? 9 : 5;
    for (int row = level == DetailLevel::near ? 0 : rows - 1; row < rows; ++row)
      for (int k = 0; k < 4 - row % 2; ++k) {
        const float y = (static_cast<float>(k) - (row % 2 ? 1.0f : 1.5f)) * 2.0f * log;
        const float z = lowest + static_cast<float>(row) * row_m;
        const float uneven = 0.1f * static_cast<float>((row * 5 + k * 3) % 4);
        add_barrel(builder, Finish::timber, b.rear + uneven, b.front - 0.5f + 0.5f * uneven, {0, y, z}, log, log, 0.02f,
                   sides);
      }
  }
  for (int k = 0; k < 4; k += far ? 3 : 1) {
    const float x = std::lerp(b.rear + 0.6f, b.front - 1.2f, static_cast<float>(k) / 3.0f);
    for (const float side : {1.0f, -1.0f})
      add_box(builder, Finish::trim, {x, side > 0 ? b.half - 0.12f : -b.half, b.floor},
              {x + 0.12f, side > 0 ? b.half : -b.half + 0.12f, b.height});
  }
}

/// Adds a fire engine's lockers behind roller shutters, its ladder on top.
void add_lockers(MeshBuilder& builder, const LoadBay& b, DetailLevel level) {
  const float ladder_m = 0.22f, top = b.height - ladder_m;
  add_box(builder, Finish::fire_red, {b.rear, -b.half, 0.62f}, {b.front, b.half, top},
          level == DetailLevel::near ? 0.05f : 0.0f);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * (b.half + 0.008f);
    const auto on_side = [&](Finish finish, float from, float to, float low, float high) {
      const float a = side > 0 ? to : from, c = side > 0 ? from : to;
      builder.material = index_of(finish);
      builder.patch({a, y, low}, {c, y, low}, {c, y, high}, {a, y, high});
    };
    on_side(Finish::white_panel, b.rear + 0.05f, b.front - 0.02f, 1.02f, 1.2f);
    if (level == DetailLevel::far) continue;
    on_side(Finish::rim, 0.62f, b.front - 0.12f, 1.28f, top - 0.15f);
    on_side(Finish::rim, -0.55f, 0.55f, 1.28f, top - 0.15f);
    on_side(Finish::rim, b.rear + 0.15f, -0.62f, 1.28f, top - 0.15f);
    on_side(Finish::tyre, -0.58f, 0.58f, 0.6f, 1.0f);
  }
  const float x = b.rear - 0.008f;
  builder.material = index_of(Finish::rim);
  builder.patch({x, 0.6f, 1.1f}, {x, -0.6f, 1.1f}, {x, -0.6f, top - 0.2f}, {x, 0.6f, top - 0.2f});
  if (level == DetailLevel::far) return;
  for (const float y : {0.25f, 0.65f})
    add_box(builder, Finish::rim, {b.rear, y, top + 0.12f}, {b.front + 0.9f, y + 0.06f, b.height});
  for (int k = 0; k < 8; ++k) {
    const float at = std::lerp(b.rear + 0.2f, b.front + 0.7f, static_cast<float>(k) / 7.0f);
    add_box(builder, Finish::rim, {at, 0.25f, top + 0.14f}, {at + 0.05f, 0.71f, top + 0.19f});
  }
}

}  // namespace

void add_load(MeshBuilder& builder, const LoadBay& bay, DetailLevel level) {
  switch (bay.load) {
    case Load::box:
      return add_cargo_box(builder, bay, level);
    case Load::tank:
      return add_tank(builder, bay, level);
    case Load::tipper:
      return add_tipper(builder, bay, level);
    case Load::timber:
      return add_timber(builder, bay, level);
    case Load::fire:
      return add_lockers(builder, bay, level);
    case Load::none:
      return;
  }
}

}  // namespace septet::scenery
