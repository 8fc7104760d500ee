#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <doctest/doctest.h>

#include "engine/raytrace/matt_faces.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t compared_px = 48, samples = 16;

struct Compared {
  double mean_together = 0.0, mean_alone = 0.0;
  double share_same = 0.0;  ///< Share of the pixels whose radiance is the same within a thousandth.
};

/// Traces the scene eight paths at once, and each path by itself.
Compared compared(const scene::ResolvedScene& scene, const TraceSettings& settings) {
  const instant::Instant instant = before_cornell_box(compared_px);
  const TracedPicture together = traced(scene, instant, settings), alone = traced(each_alone(scene), instant, settings);
  Compared result;
  for (std::size_t n = 0; n < alone.pixels.size(); ++n) {
    const TracedPixel &a = together.pixels[n], &b = alone.pixels[n];
    result.mean_together += double{luminance(a.radiance)}, result.mean_alone += double{luminance(b.radiance)};
    const glm::vec3 off = glm::abs(a.radiance - b.radiance);
    result.share_same += std::max({off.x, off.y, off.z}) <= 1e-3f * luminance(b.radiance) + 1e-6f;
    CHECK(std::abs(a.depth_m - b.depth_m) < 1e-3f);
    CHECK(a.object == b.object);
    CHECK(glm::length(a.normal - b.normal) < 1e-3f);
    CHECK(glm::length(a.albedo - b.albedo) < 1e-4f);
  }
  result.share_same /= static_cast<double>(alone.pixels.size());
  return result;
}

/// A path may hit other surfaces where rounding takes it past an edge.
void check_same(const scene::ResolvedScene& scene, const TraceSettings& settings) {
  const Compared result = compared(scene, settings);
  CHECK(result.share_same > 0.97);
  CHECK(result.mean_together == relative(result.mean_alone, 0.002));
}

/// A second lamp on the left wall, of four triangles, half as bright.
scene::ResolvedScene box_with_two_lamps() {
  scene::ResolvedScene scene = cornell_box();
  scene::SurfaceMesh& mesh = scene.meshes.front();
  scene::SurfaceMaterial lamp = scene.materials[3];
  lamp.emission *= 0.5f;
  const auto first = static_cast<std::uint32_t>(mesh.indices.size());
  for (const float low : {-0.6f, -0.4f}) {
    const float high = low + 0.2f, y = 0.99f;
    add_triangle(mesh, {glm::vec3(0.3f, y, low), {0.6f, y, low}, {0.6f, y, high}});
    add_triangle(mesh, {glm::vec3(0.3f, y, low), {0.6f, y, high}, {0.3f, y, high}});
  }
  mesh.parts.push_back({first, 12, static_cast<std::uint32_t>(scene.materials.size())});
  scene.materials.push_back(lamp);
  return scene;
}

}  // namespace

TEST_CASE("eight paths at once find the light that each finds by itself") {
  check_same(cornell_box(), cornell_settings(samples));
  SUBCASE("under two lamps") { check_same(box_with_two_lamps(), cornell_settings(samples)); }
  SUBCASE("where they end early") {
    TraceSettings settings = cornell_settings(samples);
    settings.paths = {.longest = 12, .roulette_from = 2};
    check_same(cornell_box(), settings);
  }
  SUBCASE("of every length") {
    for (const std::uint32_t longest : {1u, 2u, 3u, 4u}) {
      CAPTURE(longest);
      TraceSettings settings = cornell_settings(samples);
      settings.paths.longest = longest;
      check_same(cornell_box(), settings);
    }
  }
  SUBCASE("where some of them meet what is not matt, and glass") {
    scene::ResolvedScene scene = cornell_box();
    scene.materials[1].roughness = 0.2f;
    scene.materials[2].opacity = 0.5f;
    check_same(scene, cornell_settings(samples));
  }
}

TEST_CASE("paths go eight at once under still lamps alone") {
  const auto has_faces = [](const scene::ResolvedScene& scene, const instant::Instant& instant) {
    auto geometry = Geometry::create();
    REQUIRE(geometry.has_value());
    const SceneIndex index(scene);
    for (std::size_t n = 0; n < scene.meshes.size(); ++n)
      geometry->add_mesh(scene.meshes[n].vertices, scene.meshes[n].indices, index.open[n]);
    const World world(scene, index, instant, nullptr, {}, {}, *geometry);
    return world.matt_faces() != nullptr;
  };
  const scene::ResolvedScene box = cornell_box();
  const instant::Instant dark = before_cornell_box(compared_px);
  CHECK(has_faces(box, dark));
  scene::ResolvedScene with_picture = each_alone(box);
  CHECK(has_faces(with_picture, dark));
  with_picture.materials[3].maps[scene::SurfaceMap::emission] = 0;
  CHECK_FALSE(has_faces(with_picture, dark));
  instant::Instant other = dark;
  other.light = even_sky(1.0f);
  CHECK_FALSE(has_faces(box, other));
  other = dark;
  other.extinction_per_m = 0.1f;
  CHECK_FALSE(has_faces(box, other));
  other = dark;
  other.headlights.emplace_back();
  CHECK_FALSE(has_faces(box, other));
}

TEST_CASE("eight numbers are what each by itself is") {
  const float shares[8] = {0.0f, 0.03f, 0.124f, 0.126f, 0.37f, 0.5f, 0.77f, 0.9999999f};
  Float8 eight_shares;
  for (int n = 0; n < 8; ++n) eight_shares[n] = shares[n];
  const OnCircle at(eight_shares);
  PathRandom one[8];
  for (std::uint32_t n = 0; n < 8; ++n) one[n] = PathRandom(7, n, 3, 5);
  PathRandom8 all([&](std::size_t n) -> const PathRandom& { return one[n]; });
  const Int8 drawn = truths_of(0xb5u);
  CHECK(bits_of(drawn) == 0xb5u);
  const Float8 uniform = all.uniform(drawn);
  const PathRandom8::Pair pair = all.pair(truths_of(0xffu));
  alignas(32) float rows_of[8][8];
  const float* rows[8];
  for (int n = 0; n < 8; ++n) {
    rows[n] = rows_of[n];
    for (int k = 0; k < 8; ++k) rows_of[n][k] = static_cast<float>(10 * n + k);
  }
  Float8 columns[8];
  transpose(rows, columns);
  for (int n = 0; n < 8; ++n) {
    CAPTURE(n);
    CHECK(at.cosine[n] == on_circle(shares[n]).x);
    CHECK(at.sine[n] == on_circle(shares[n]).y);
    if (holds(0xb5u, static_cast<std::size_t>(n))) CHECK(uniform[n] == one[n].uniform());
    const glm::vec2 expected = one[n].pair();
    CHECK(pair.x[n] == expected.x);
    CHECK(pair.y[n] == expected.y);
    CHECK(all[static_cast<std::size_t>(n)].uniform() == one[n].uniform());
    for (int k = 0; k < 8; ++k) CHECK(float{columns[k][n]} == rows_of[n][k]);
  }
}

}  // namespace septet::raytrace
