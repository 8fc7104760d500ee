#include "engine/raytrace/geometry.hpp"

#include <memory>
#include <vector>

#include <doctest/doctest.h>

namespace septet::raytrace {

TEST_CASE("a hit names the place, its distance and its triangle, also where several places have one mesh") {
  std::vector<scene::SurfaceVertex> corners(3);
  corners[0].position_m = {-1.0f, -1.0f, 0.0f};
  corners[1].position_m = {1.0f, -1.0f, 0.0f};
  corners[2].position_m = {0.0f, 1.0f, 0.0f};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  auto geometry = Geometry::create();
  REQUIRE(geometry.has_value());
  geometry->add_mesh(corners, indices, false);
  const glm::mat3 twice(2.0f);
  const std::vector<Place> places{{0},
                                  {.mesh = 0, .origin_m = {10.0f, 0.0f, 1.0f}},
                                  {.mesh = 0, .origin_m = {20.0f, 0.0f, 2.0f}, .turn = twice},
                                  {.mesh = 0, .origin_m = {30.0f, 0.0f, 3.0f}, .seen = false},
                                  {.mesh = 0, .origin_m = {40.0f, 0.0f, 4.0f}, .seen = false, .casts_shadow = false}};
  geometry->place(places, nullptr);
  for (std::uint32_t n = 0; n < 5; ++n) {
    CAPTURE(n);
    const float z = static_cast<float>(n);
    const Ray down{.origin_m = {10.0f * z, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    Hit hit;
    const bool found = geometry->intersect(down, hit);
    CHECK(found == (n < 3));
    CHECK(geometry->unshadowed(down) == (n < 4 ? 0.0f : 1.0f));
    // Invisible geometry still acts on its surroundings.
    if (!found) CHECK(geometry->intersect(down, hit, From::surface));
    CHECK(hit.place == n);
    CHECK(hit.triangle == 0);
    CHECK(hit.distance_m == doctest::Approx(5.0f - z));
  }
  Hit hit;
  CHECK_FALSE(geometry->intersect({.origin_m = {5.0f, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}}, hit));
}

namespace {

/// Holes where u is below a quarter; half of a shadow ray's light passes.
struct Sieve : Openings {
  bool is_hole(std::uint32_t, std::uint32_t, float u, float) const override { return u < 0.25f; }
  float share_let_through(std::uint32_t place, std::uint32_t, float, float, const glm::vec3& direction) const override {
    return place == 0 ? 0.5f : direction.z;
  }
};

}  // namespace

TEST_CASE("rays in a packet meet and see what each meets and sees alone, through holes and glass, too") {
  std::vector<scene::SurfaceVertex> corners(3);
  corners[0].position_m = {-1.0f, -1.0f, 0.0f};
  corners[1].position_m = {2.0f, -1.0f, 0.0f};
  corners[2].position_m = {-1.0f, 2.0f, 0.0f};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  auto geometry = Geometry::create();
  REQUIRE(geometry.has_value());
  geometry->add_mesh(corners, indices, true);
  geometry->add_mesh(corners, indices, false);
  const Motion motion({{0.0f, 0.0f, 2.0f}, glm::mat3(1.0f)}, {{1.0f, 0.0f, 2.0f}, glm::mat3(1.0f)});
  const std::vector<Place> places{{0},
                                  {.mesh = 0, .origin_m = {0.0f, 0.0f, 1.0f}, .turn = glm::mat3(0.7f)},
                                  {.mesh = 1, .origin_m = {0.0f, 0.0f, 2.0f}, .motion = motion}};
  const Sieve sieve;
  geometry->place(places, &sieve);
  for (const std::uint32_t which : {0xffu, 0x5au, 0x01u}) {
    CAPTURE(which);
    for (const Together together : {Together::side_by_side, Together::anywhere}) {
      RayPacket rays;
      for (std::size_t n = 0; n < packet_size; ++n) {
        const float side = static_cast<float>(n);
        Ray ray;
        ray.origin_m = {0.1f, 0.05f, -2.0f};
        ray.direction = glm::normalize(glm::vec3(0.13f * side - 0.4f, 0.3f - 0.07f * side, 1.0f));
        ray.time = side / 8.0f;
        if (n == 6) ray.to_m = 2.5f;
        rays.set(n, ray);
      }
      HitPacket hits;
      const std::uint32_t met = geometry->intersect(which, rays, together, hits);
      const Float8 shares = geometry->unshadowed(which, rays);
      for (std::size_t n = 0; n < packet_size; ++n) {
        CAPTURE(n);
        const bool asked = (which >> n & 1u) != 0;
        Hit alone;
        const bool meets = geometry->intersect(rays[n], alone);
        CHECK(((met >> n & 1u) != 0) == (asked && meets));
        if (!asked) continue;
        CHECK(shares[n] == doctest::Approx(geometry->unshadowed(rays[n])));
        if (!meets) continue;
        CHECK(hits[n].place == alone.place);
        CHECK(hits[n].triangle == alone.triangle);
        CHECK(hits[n].distance_m == doctest::Approx(alone.distance_m));
        CHECK(hits[n].u == doctest::Approx(alone.u));
        CHECK(hits[n].v == doctest::Approx(alone.v));
      }
    }
  }
}

TEST_CASE(
    "geometry for few rays keeps a shared mesh's hierarchy while others hold the mesh, and meets what is there now") {
  const auto leaf_at = [](float height_m) {
    auto mesh = std::make_shared<scene::SurfaceMesh>();
    mesh->vertices.resize(3);
    mesh->vertices[0].position_m = {-1.0f, -1.0f, height_m};
    mesh->vertices[1].position_m = {1.0f, -1.0f, height_m};
    mesh->vertices[2].position_m = {0.0f, 1.0f, height_m};
    mesh->indices = {0, 1, 2};
    return mesh;
  };
  auto geometry = Geometry::create(Rays::few);
  REQUIRE(geometry.has_value());
  const auto distance_m = [&](const std::shared_ptr<const scene::SurfaceMesh>& mesh, float x_m) {
    geometry->keep(0);
    geometry->add_mesh(mesh, false);
    geometry->place(std::vector<Place>{{.mesh = 0, .origin_m = {x_m, 0.0f, 0.0f}}}, nullptr);
    Hit hit;
    return geometry->intersect({.origin_m = {x_m, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}}, hit) ? hit.distance_m
                                                                                                       : -1.0f;
  };
  auto low = leaf_at(0.0f);
  const auto high = leaf_at(3.0f);
  for (const float x_m : {0.0f, 10.0f}) {
    CAPTURE(x_m);
    CHECK(distance_m(low, x_m) == doctest::Approx(5.0f));
    CHECK(distance_m(high, x_m) == doctest::Approx(2.0f));
  }
  // One in a place of the memory that another has left is another one.
  const std::weak_ptr<const scene::SurfaceMesh> gone = low;
  low.reset();
  CHECK(distance_m(high, 0.0f) == doctest::Approx(2.0f));
  CHECK(gone.expired());
  for (int n = 1; n < 50; ++n)
    CHECK(distance_m(leaf_at(0.1f * static_cast<float>(n)), 0.0f) ==
          doctest::Approx(5.0f - 0.1f * static_cast<float>(n)));
}

}  // namespace septet::raytrace
