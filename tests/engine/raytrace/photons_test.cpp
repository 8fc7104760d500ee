// Photons from lamps, sun and headlights to surfaces, and the light that they make there, against closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/light/fresnel.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

std::vector<Photon> all_photons(const RayTracer& tracer) {
  std::vector<Photon> photons;
  for (const PhotonBucket& bucket : tracer.photon_buckets()) {
    const auto of_bucket = tracer.trace_photons(bucket);
    photons.insert(photons.end(), of_bucket.begin(), of_bucket.end());
  }
  return photons;
}

/// Adds a square in the plane of height z, visible from above or below.
void add_level(scene::ResolvedScene& scene, float half_m, float z_m, bool looks_up,
               const scene::SurfaceMaterial& material) {
  scene::SurfaceMesh mesh;
  const std::array<glm::vec3, 4> c{
      glm::vec3(-half_m, -half_m, z_m), {half_m, -half_m, z_m}, {half_m, half_m, z_m}, {-half_m, half_m, z_m}};
  if (looks_up) {
    add_triangle(mesh, {c[0], c[1], c[2]});
    add_triangle(mesh, {c[0], c[2], c[3]});
  } else {
    add_triangle(mesh, {c[2], c[1], c[0]});
    add_triangle(mesh, {c[3], c[2], c[0]});
  }
  mesh.parts.push_back({0, 6, static_cast<std::uint32_t>(scene.materials.size())});
  mesh.bounds_min_m = glm::vec3(-half_m), mesh.bounds_max_m = glm::vec3(half_m);
  scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size())});
  scene.materials.push_back(material);
  scene.meshes.push_back(std::move(mesh));
}

scene::SurfaceMaterial matt(float albedo, float emission = 0.0f) {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(albedo);
  material.roughness = 1.0f;
  material.emission = glm::vec3(emission);
  return material;
}

ClearBody ball_of(float index, float absorption_per_m, float radius_m, const Vec3& middle_m, int splits = 5) {
  ClearBody body{.origin_m = middle_m, .index = index, .absorption_per_m = glm::vec3(absorption_per_m)};
  const scene::SurfaceMesh shape = ball(splits);
  for (const std::uint32_t n : shape.indices) {
    scene::SurfaceVertex vertex = shape.vertices[n];
    vertex.position_m *= radius_m;
    body.vertices.push_back(vertex);
  }
  return body;
}

/// Inside of a ball of radius 1, of the scene's second material.
scene::SurfaceMesh shell(int splits) {
  scene::SurfaceMesh walls = ball(splits);
  for (std::size_t n = 0; n < walls.indices.size(); n += 3) std::swap(walls.indices[n], walls.indices[n + 1]);
  for (scene::SurfaceVertex& vertex : walls.vertices) vertex.normal = -vertex.normal;
  walls.parts[0].material = 1;
  return walls;
}

/// View straight down.
instant::Instant under_sun(const Vec3& eye_m, double angle_rad, std::uint32_t side_px, float irradiance) {
  auto light = *even_sky(0.0f);
  light.light_direction = light.sun_direction = {0.0f, 0.0f, 1.0f};
  light.light_irradiance = glm::vec3(irradiance);
  instant::Instant instant = instant_from(eye_m, angle_rad, side_px, std::make_shared<const instant::SkyLight>(light));
  instant.views.front().projection = instant::symmetric_view(eye_m, 0.0, -0.5 * std::numbers::pi, angle_rad, angle_rad);
  return instant;
}

/// Share of a parallel beam on a ball's disc that leaves it again: along each chord R + T² a / (1 − R a).
double let_through(float index, double absorption_per_m, double radius_m) {
  constexpr int rings = 4000;
  double sum = 0.0;
  for (int n = 0; n < rings; ++n) {
    const double square = (n + 0.5) / rings;  // Rings of equal area.
    const double reflected =
        light::fresnel(static_cast<float>(std::sqrt(1.0 - square)), static_cast<float>(1.0 / index));
    const double clear = std::exp(-absorption_per_m * radius_m * 2.0 * std::sqrt(1.0 - square / (index * index)));
    sum += reflected + (1.0 - reflected) * (1.0 - reflected) * clear / (1.0 - reflected * clear);
  }
  return sum / rings;
}

}  // namespace

TEST_CASE("photons carry what their lamp gives into a closed box, and what its walls reflect of that each time") {
  const float lamp_m = 0.2f;
  scene::ResolvedScene scene;
  add_level(scene, lamp_m, 0.5f, false, matt(0.0f, 7.0f));
  scene.materials.push_back(matt(0.5f));
  scene.instances.push_back({.mesh = 1});
  scene.meshes.push_back(shell(3));
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  for (const std::uint32_t longest : {3u, 4u, 6u}) {
    tracer->begin(instant_from({0.0, 0.0, -0.5}, 1.0, 8, even_sky(0.0f)),
                  {.paths = {.longest = longest}, .photons = {.global = 40000}});
    double sum = 0.0;
    for (const Photon& photon : all_photons(*tracer)) sum += double(photon.power.x);
    const double power = std::numbers::pi * 7.0 * 4.0 * double(lamp_m) * double(lamp_m);
    // Photons have two edges fewer than the whole path. Light on the lamp's black back is lost: a share of 0.03 a time
    // at most.
    double known = 0.0;
    for (std::uint32_t edge = 0; edge < longest - 2; ++edge) known += power * std::pow(0.5, edge);
    CAPTURE(longest);
    CHECK(sum <= known * 1.01);
    CHECK(sum > known * (longest == 3 ? 0.999999 : 0.96));
  }
}

TEST_CASE("a plane under a bare lamp has by its photons the light of the rectangle's form factor") {
  scene::ResolvedScene scene;
  add_level(scene, 0.5f, 1.0f, false, matt(0.0f, 7.0f));
  add_level(scene, 20.0f, 0.0f, true, matt(0.6f));
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  const std::uint32_t nearest = 200;
  tracer->begin(instant_from({0.0, 0.0, 0.5}, 1.0, 8, even_sky(0.0f)),
                {.photons = {.global = 200000, .nearest = nearest}});
  const PhotonMap map(all_photons(*tracer), nearest, 0.3f);
  const auto of_corner = [](double a, double b) {
    const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
    return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * std::numbers::pi);
  };
  double squares = 0.0, sum_known = 0.0, sum_found = 0.0;
  int places = 0;
  for (float x = -1.0f; x <= 1.0f; x += 0.25f)
    for (float y = -1.0f; y <= 1.0f; y += 0.25f) {
      SurfacePoint point;
      point.position_m = {x, y, -0.5f};  // Relative to the eye.
      point.flat_normal = point.surface.normal = {0.0f, 0.0f, 1.0f};
      point.surface.diffuse = glm::vec3(0.6f);
      const double found = double(map.radiance(point, {0.0f, 0.0f, 1.0f}).x);
      const auto corner = [&](double a, double b) {
        return std::copysign(1.0, a * b) * of_corner(std::abs(a), std::abs(b));
      };
      const double x0 = -0.5 - double(x), x1 = 0.5 - double(x), y0 = -0.5 - double(y), y1 = 0.5 - double(y);
      const double known = 0.6 * 7.0 * (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0));
      const double off = found / known - 1.0;
      CAPTURE(x);
      CAPTURE(y);
      // Tolerance for this many photons: 1/√n, and the curvature of the light over the disc.
      CHECK(std::abs(off) < 4.0 / std::sqrt(nearest - 1.0) + 0.01);
      squares += off * off, sum_known += known, sum_found += found, ++places;
    }
  CHECK(std::sqrt(squares / places) < 1.2 / std::sqrt(nearest - 1.0));
  CHECK(std::abs(sum_found / sum_known - 1.0) < 3.0 / std::sqrt(places * (nearest - 1.0)));
}

TEST_CASE("a ball of glass sends on what it lets through, and where two stand in one beam no light is counted twice") {
  // Lamp so far away that its light is parallel, all within a shell.
  scene::ResolvedScene scene;
  const float away_m = 100.0f;
  add_level(scene, 0.5f, away_m, false, matt(0.0f, 30000.0f));
  scene.materials.push_back(matt(0.5f));
  scene.instances.push_back({.mesh = 1, .scale = glm::vec3(300.0f)});
  scene.meshes.push_back(shell(4));
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  const auto instant = instant_from({0.0, 5.0, 1.0}, 1.0, 8, even_sky(0.0f));
  const auto energy = [&](std::vector<ClearBody> bodies) {
    tracer->begin(instant, {.photons = {.caustic = 60000}}, std::move(bodies));
    double sum = 0.0;
    for (const Photon& photon : all_photons(*tracer)) sum += double(photon.power.x);
    return sum;
  };
  const double beam = std::numbers::pi * 0.25 * 30000.0 / (double(away_m) * double(away_m));
  const double one = energy({ball_of(1.5f, 0.4f, 0.5f, {0.0, 0.0, 0.0})});
  CHECK(one / (beam * let_through(1.5f, 0.4, 0.5)) == relative(1.0, 0.01));
  // Two clear balls, one in the other's shadow: all light on the first passes through both.
  const double both = energy({ball_of(1.5f, 0.0f, 0.5f, {0.0, 0.0, 0.0}), ball_of(1.5f, 0.0f, 0.5f, {0.0, 0.0, -1.5})});
  CHECK(both / beam == relative(1.0, 0.015));
}

TEST_CASE("under a ball of glass the sun makes a bright spot in a shadow, with the light that goes down through it") {
  scene::ResolvedScene scene;
  add_level(scene, 50.0f, -1.2f, true, matt(0.5f));
  constexpr std::uint32_t side_px = 48;
  constexpr double side_m = 6.0;
  const auto instant = under_sun({0.0, 0.0, 40.0}, 2.0 * std::atan(0.5 * side_m / 41.2), side_px, 3.0f);
  TraceSettings settings{.samples = 16, .paths = {.longest = 6}, .filter = Filter::box};
  const TracedPicture open = traced(scene, instant, settings);
  // The ball covers a part of its own spot, which is visible through it.
  const std::vector<ClearBody> glass{ball_of(1.5f, 0.0f, 1.0f, {0.0, 0.0, 0.0})};
  const TracedPicture without = traced(scene, instant, settings, glass);
  settings.photons.caustic = 30000;
  settings.photons.caustic_reach_m = 0.1f;
  const TracedPicture with = traced(scene, instant, settings, glass);
  const double open_floor = 0.5 / std::numbers::pi * 3.0;
  CHECK(mean_of(open).radiance.x == relative(open_floor, 0.01));
  float brightest = 0.0f;
  for (const TracedPixel& pixel : with.pixels) brightest = std::max(brightest, pixel.radiance.x);
  CHECK(brightest > 5.0 * open_floor);
  CHECK(with.bad_samples == 0);
  // Sum over the photons, each through two surfaces: nearly all light of the shadow is there again.
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  tracer->begin(instant, settings, glass);
  double landed = 0.0;
  for (const Photon& photon : all_photons(*tracer)) landed += double(photon.power.x);
  const double through = landed / (std::numbers::pi * 3.0);
  CHECK(through > 0.85);
  CHECK(through < let_through(1.5f, 0.0, 1.0));
  CHECK(mean_of(with).radiance.x >
        mean_of(without).radiance.x + 0.5 * through * open_floor * std::numbers::pi / (side_m * side_m));
}

TEST_CASE("photons are the same in whatever buckets and order they are traced") {
  const scene::ResolvedScene scene = cornell_box();
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  const auto instant = before_cornell_box(16);
  tracer->begin(instant, {.seed = 3, .photons = {.caustic = 9000, .global = 9000}},
                {ball_of(1.31f, 0.0f, 0.3f, {0.0, 0.0, 0.2}, 2)});
  for (const PhotonKind kind : {PhotonKind::caustic, PhotonKind::global}) {
    const auto all = tracer->trace_photons({kind, 0, 9000});
    CHECK(all.size() > 1000);
    std::vector<Photon> sum;
    for (std::uint32_t first = 0; first < 9000; first += 77) {
      const auto some = tracer->trace_photons({kind, first, first + 77});
      sum.insert(sum.end(), some.begin(), some.end());
    }
    CHECK(sum == all);
  }
  send_photons(*tracer, 1);
  const Bucket alone = tracer->trace({0, 0, 16, 16});
  tracer->begin(instant, {.seed = 3, .photons = {.caustic = 9000, .global = 9000}},
                {ball_of(1.31f, 0.0f, 0.3f, {0.0, 0.0, 0.2}, 2)});
  send_photons(*tracer, 8);
  const Bucket together = tracer->trace({0, 0, 16, 16});
  for (std::size_t n = 0; n < alone.pixels.size(); ++n) CHECK(alone.pixels[n].radiance == together.pixels[n].radiance);
}

}  // namespace septet::raytrace
