#include "engine/render/passes/draw_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/random.hpp"

namespace septet::render {
namespace {

constexpr MeshBounds unit_bounds{glm::vec3(-1.0f), glm::vec3(1.0f)};

FrameView view_along(double heading_rad) {
  FrameView view;
  view.projection = symmetric_view({0, 0, 1.2}, heading_rad, 0.0, 1.1, 0.6);
  view.world_from_car = {{5000.0, -300.0, 12.0}, orientation_from_angles(0.4, 0.05, 0.0)};
  view.viewport = {0, 0, 640, 420};
  return view;
}

bool in_picture(const FrameView& view, const Vec3& world_m) {
  const Vec3 car_m = inverse(view.world_from_car) * world_m;
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(car_m - view.projection.eye_m, 1.0);
  return clip.w > view.projection.near_m && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

}  // namespace

TEST_CASE("nothing that shows in the picture is culled and most of what does not is") {
  Random random(11);
  const FrameView view = view_along(0.3);
  const ViewVolume volume = view_volume(view);
  const Vec3 eye_m = view.world_from_car * view.projection.eye_m;
  int shown = 0, kept = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 at_m = eye_m + Vec3(random.uniform(-200, 200), random.uniform(-200, 200), random.uniform(-30, 30));
    const double radius_m = random.uniform(0.1, 3.0);
    const bool keep = intersects(volume, glm::vec3(at_m - eye_m), static_cast<float>(radius_m));
    kept += keep;
    for (int k = 0; k < 12; ++k) {
      const Vec3 direction(random.normal(), random.normal(), random.normal());
      if (!in_picture(view, at_m + radius_m * glm::normalize(direction))) continue;
      ++shown;
      CHECK(keep);
      break;
    }
  }
  CHECK(shown > 100);
  CHECK(kept < 1.35 * shown);
}

TEST_CASE("a mesh is drawn from its nearest distance on and no longer at its farthest") {
  std::vector<PlacedMesh> placed;
  for (const double x : {8.7, 11.3, 26.3, 33.7}) {
    placed.push_back(place(0, unit_bounds, {{x, 0, 0}, {1, 0, 0, 0}}, glm::vec3(1.0f)));
    placed.back().visible_from_m = 10.0f;
    placed.back().visible_to_m = 30.0f;
  }
  DrawList list;
  append_visible(list, placed, {0, 0, 0}, [](const PlacedMesh&, const glm::vec3&) { return true; });
  REQUIRE(list.records.size() == 2);
  CHECK(list.records[0].row0.w == doctest::Approx(11.3));
  CHECK(list.records[1].row0.w == doctest::Approx(26.3));
}

TEST_CASE("where two levels of detail meet both are drawn and each threshold shows just one of them") {
  std::vector<PlacedMesh> placed;
  for (const std::uint32_t mesh : {0u, 1u})
    for (double x = 80.0; x < 120.0; x += 0.25)
      placed.push_back(place(mesh, unit_bounds, {{x, 0, 0}, {1, 0, 0, 0}}, glm::vec3(1.0f)));
  const std::size_t each = placed.size() / 2;
  for (std::size_t i = 0; i < each; ++i) placed[i].visible_to_m = placed[each + i].visible_from_m = 100.0f;
  DrawList list;
  append_visible(list, placed, {0, 0, 0}, [](const PlacedMesh&, const glm::vec3&) { return true; });
  REQUIRE(list.batches.size() == 4);
  std::map<float, std::vector<glm::vec2>> shown;  // By place.
  for (const Batch& batch : list.batches)
    for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
      shown[list.records[i].row0.w].push_back(list.records[i].shown);
      CHECK(batch.fading == (list.records[i].shown != glm::vec2(0.0f, 1.0f)));
    }
  CHECK(shown.size() == each);
  float before = 1.0f;
  int both = 0;
  for (const auto& [x, levels] : shown) {
    const float nearer = x < 100.0f || levels.size() == 2 ? levels.front().y : 0.0f;
    if (levels.size() == 2) {
      ++both;
      CHECK(levels[1] == glm::vec2(levels[0].y, 1.0f));
    }
    CHECK(nearer <= before);
    CHECK(before - nearer < 0.04f);  // A tick at 100 km/h is shorter than that.
    before = nearer;
  }
  CHECK(both > 80);
  CHECK(both < 100);
}

TEST_CASE("instances of one mesh make one batch and batches come nearest first") {
  std::vector<PlacedMesh> placed;
  for (const double x : {50.0, 70.0})
    placed.push_back(place(3, unit_bounds, {{x, 0, 0}, {1, 0, 0, 0}}, glm::vec3(1.0f)));
  for (const double x : {20.0, 90.0, 30.0})
    placed.push_back(place(7, unit_bounds, {{x, 0, 0}, {1, 0, 0, 0}}, glm::vec3(1.0f)));
  DrawList list;
  append_visible(list, placed, {0, 0, 0}, [](const PlacedMesh&, const glm::vec3&) { return true; });
  sort_by_distance(list);
  REQUIRE(list.batches.size() == 2);
  CHECK(list.batches[0].mesh == 7);
  CHECK(list.batches[0].count == 3);
  CHECK(list.batches[1].mesh == 3);
  CHECK(list.batches[1].count == 2);
}

TEST_CASE("a record takes a point of the object to where it lies from the eye though both are 100 km out") {
  const RigidTransform world_from_object{{100e3 + 12.0, -100e3, 40.0}, orientation_from_angles(0.7, 0.1, -0.2)};
  const glm::vec3 scale(1.5f, 0.5f, 2.0f);
  const PlacedMesh placed = place(0, unit_bounds, world_from_object, scale);
  DrawList list;
  const Vec3 eye_m(100e3, -100e3, 41.0);
  append_visible(list, std::span(&placed, 1), eye_m, [](const PlacedMesh&, const glm::vec3&) { return true; });
  REQUIRE(list.records.size() == 1);
  const Vec3 point(0.3, -0.8, 0.9);
  const Vec3 expected = world_from_object * (point * Vec3(scale)) - eye_m;
  const InstanceRecord& record = list.records[0];
  const glm::vec4 p(glm::vec3(point), 1.0f);
  const Vec3 placed_m(glm::dot(record.row0, p), glm::dot(record.row1, p), glm::dot(record.row2, p));
  CHECK(glm::length(placed_m - expected) < 1e-5);
}

TEST_CASE("a coarse picture shows far forms where they lie further off than they are wide") {
  PlacedMesh placed;
  placed.radius_m = 10.0f;
  CHECK(detail_range_m(placed, {30.0f, 0.0f, 0.0f}, {}) == 30.0f);
  CHECK(detail_range_m(placed, {30.0f, 0.0f, 0.0f}, {0.0f, 16.0f}) == 320.0f);
  CHECK(detail_range_m(placed, {9.0f, 0.0f, 0.0f}, {0.0f, 16.0f}) == 9.0f);
  CHECK(detail_range_m(placed, {9.0f, 0.0f, 0.0f}, {150.0f, 16.0f}) == 150.0f);
}

}  // namespace septet::render
