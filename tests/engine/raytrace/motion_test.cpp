#include "engine/raytrace/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "engine/geometry/temporal_normals.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

TracedPicture traced_until(const scene::ResolvedScene& scene, const instant::Instant& instant,
                           const instant::Instant& later, const TraceSettings& settings) {
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  tracer->begin(instant, settings, {}, &later);
  const instant::PixelRectangle size = instant.views.front().viewport;
  return whole_picture(*tracer, size.width, size.height);
}

/// A bright sheet in the plane x = 0, from y = 0 to the left.
scene::ResolvedScene bright_sheet() {
  scene::ResolvedScene scene;
  scene::SurfaceMaterial bright;
  bright.emission = glm::vec3(1.0f);
  bright.base_color = glm::vec3(0.0f);
  scene.materials.push_back(bright);
  scene::SurfaceMesh sheet;
  const glm::vec3 a{0, 0, -20}, b{0, 0, 20}, c{0, 20, 20}, d{0, 20, -20};
  add_triangle(sheet, {a, b, c});
  add_triangle(sheet, {a, c, d});
  sheet.parts.push_back({0, 6, 0});
  sheet.bounds_min_m = a, sheet.bounds_max_m = c;
  scene.meshes.push_back(std::move(sheet));
  return scene;
}

constexpr std::uint32_t side_px = 40;
constexpr double angle_rad = 0.6, distance_m = 6.0;
const double px_of_m = side_px / (2.0 * std::tan(0.5 * angle_rad)) / distance_m;

/// Largest deviation of the columns' light, means over their rows, from a ramp between two columns of the picture.
double off_ramp(const TracedPicture& picture, double full_px, double dark_px) {
  double worst = 0.0;
  for (std::uint32_t x = 0; x < side_px; ++x) {
    double light = 0.0;
    for (std::uint32_t y = 0; y < side_px; ++y) light += picture.at(x, y).radiance.x / side_px;
    // Mean of the ramp over the pixel.
    double expected = 0.0;
    for (int n = 0; n < 64; ++n)
      expected += std::clamp((dark_px - (x + (n + 0.5) / 64.0)) / (dark_px - full_px), 0.0, 1.0) / 64.0;
    worst = std::max(worst, std::abs(light - expected));
  }
  return worst;
}

}  // namespace

TEST_CASE("an edge that moves while the shutter is open is a linear ramp as long as its way") {
  const scene::ResolvedScene scene = bright_sheet();
  instant::Instant instant = instant_from({-distance_m, 0.0, 0.0}, angle_rad, side_px, even_sky(0.0f)), later = instant;
  instant::PlacedMesh sheet;
  sheet.number = 5;
  sheet.tint = glm::vec4(1.0f);
  instant.parts = {sheet};
  sheet.origin_m.y = -1.5;  // Motion to the right.
  later.parts = {sheet};
  const TraceSettings settings{.samples = 64, .filter = Filter::box};
  CHECK(off_ramp(traced_until(scene, instant, later, settings), 0.5 * side_px, 0.5 * side_px + 1.5 * px_of_m) < 0.03);
  // The sheet of another participant, or of none, has no known motion: its edge is sharp.
  later.parts.front().number = 6;
  const double sharp = 0.5 * side_px;
  CHECK(off_ramp(traced_until(scene, instant, later, settings), sharp - 1e-3, sharp + 1e-3) < 0.03);
  // A camera that moves to the left blurs standing objects.
  instant::Instant from_left = instant;
  from_left.views.front().projection.eye_m.y += 1.0;
  CHECK(off_ramp(traced_until(scene, instant, from_left, settings), sharp, sharp + px_of_m) < 0.03);
  // With or without a shutter, still objects are as sharp, and have the same light.
  CHECK(off_ramp(traced_until(scene, instant, instant, settings), sharp - 1e-3, sharp + 1e-3) < 0.03);
}

TEST_CASE("a pixel's motion is the way of what it shows in the picture by the camera's move and its own") {
  const scene::ResolvedScene scene = bright_sheet();
  instant::Instant instant = instant_from({-distance_m, 0.0, 0.0}, angle_rad, side_px, even_sky(0.0f));
  instant::PlacedMesh sheet;
  sheet.tint = glm::vec4(1.0f);
  instant.parts = {sheet};
  const TraceSettings settings{.samples = 4, .filter = Filter::box, .blurs = false};
  const auto motion = [&](const instant::Instant& later, std::uint32_t x, float scale = 1.0f) {
    TraceSettings scaled = settings;
    scaled.motion_scale = scale;
    return traced_until(scene, instant, later, scaled).at(x, 20).motion_px;
  };
  constexpr std::uint32_t on_sheet = 10, in_sky = 30;
  const double px_of_slope = px_of_m * distance_m;
  // Camera moves to the left and up: static objects go to the right and down, the sky stays.
  instant::Instant later = instant;
  later.views.front().projection.eye_m += Vec3(0.0, 1.0, 0.5);
  CHECK(motion(later, on_sheet).x == relative(px_of_m, 1e-4));
  CHECK(motion(later, on_sheet).y == relative(0.5 * px_of_m, 1e-4));
  CHECK(glm::length(motion(later, in_sky)) < 1e-3f);
  CHECK(motion(later, on_sheet, 2.5f).x == relative(2.5 * px_of_m, 1e-4));
  // Camera turns to the left: the sky goes to the right, by tangents.
  later = instant;
  later.views.front().projection = instant::symmetric_view({-distance_m, 0.0, 0.0}, 0.05, 0.0, angle_rad, angle_rad);
  const auto turned_by = [&](double px) { return px_of_slope * std::tan(std::atan(px / px_of_slope) + 0.05) - px; };
  CHECK(motion(later, in_sky).x > turned_by(10.0) - 1e-3);
  CHECK(motion(later, in_sky).x < turned_by(11.0) + 1e-3);
  // Sheet goes to the right, which a camera that goes with it does not see.
  later = instant;
  later.parts.front().origin_m.y = -1.5;
  CHECK(motion(later, on_sheet).x == relative(1.5 * px_of_m, 1e-4));
  CHECK(std::abs(motion(later, on_sheet).y) < 1e-3f);
  later.views.front().projection.eye_m.y = -1.5;
  CHECK(glm::length(motion(later, on_sheet)) < 1e-3f);
  // Sheet at two thirds of its distance: everything is half as far again from the middle.
  later = instant;
  later.parts.front().origin_m.x = -2.0;
  CHECK(motion(later, on_sheet).x > -5.0 - 1e-3);
  CHECK(motion(later, on_sheet).x < -4.5 + 1e-3);
  // Sheet behind the camera at the later time.
  later.parts.front().origin_m.x = -9.0;
  CHECK(motion(later, on_sheet) == glm::vec2(0.0f));
  // Motion without blur.
  later = instant;
  later.views.front().projection.eye_m.y += 1.0;
  const double sharp = 0.5 * side_px;
  CHECK(off_ramp(traced_until(scene, instant, later, {.samples = 64, .filter = Filter::box, .blurs = false}),
                 sharp - 1e-3, sharp + 1e-3) < 0.03);
}

TEST_CASE("debris moves in the picture as its corners do") {
  scene::ResolvedScene scene;
  scene.materials.emplace_back();
  instant::Instant instant = instant_from({-distance_m, 0.0, 0.0}, angle_rad, side_px, even_sky(1.0f));
  instant::LooseMesh& piece = instant.loose.emplace_back();
  const glm::vec3 back(-1.0f, 0.0f, 0.0f);
  piece.mesh.vertices = {{{0, 9, -9}, back, {}}, {{0, -9, -9}, back, {}}, {{0, 0, 18}, back, {}}};
  instant::Instant later = instant;
  for (scene::SurfaceVertex& vertex : later.loose.front().mesh.vertices) vertex.position_m.z -= 0.75f;
  later.loose.front().mesh.origin_m.y += 0.25;
  const TracedPicture picture =
      traced_until(scene, instant, later, {.samples = 1, .filter = Filter::box, .blurs = false});
  CHECK(picture.at(20, 20).motion_px.x == relative(-0.25 * px_of_m, 1e-4));
  CHECK(picture.at(20, 20).motion_px.y == relative(0.75 * px_of_m, 1e-4));
}

TEST_CASE("a ray meets what turns where it is at the ray's time") {
  const scene::ResolvedScene scene = bright_sheet();
  auto geometry = Geometry::create();
  REQUIRE(geometry.has_value());
  geometry->add_mesh(scene.meshes[0].vertices, scene.meshes[0].indices, false);
  // Quarter of a circle about z, stretched all the while.
  const glm::mat3 stretch(1.0f, 0, 0, 0, 2.0f, 0, 0, 0, 0.5f);
  const Stand from{glm::vec3(0.0f), stretch},
      to{glm::vec3(0, 0, 3), glm::mat3(glm::rotate(glm::mat4(1.0f), 1.2f, glm::vec3(0, 0, 1))) * stretch};
  const Motion motion(from, to);
  const Place place{0, from.origin_m, from.turn, true, motion};
  geometry->place({&place, 1}, nullptr);
  for (const float time : {0.0f, 0.3f, 0.5f, 0.9f, 1.0f}) {
    CAPTURE(time);
    Ray ray;
    ray.origin_m = {-9.0f, 2.0f, 0.5f}, ray.direction = {1.0f, 0.0f, 0.0f}, ray.time = time;
    Hit hit;
    REQUIRE(geometry->intersect(ray, hit));
    CHECK(hit.distance_m == relative(9.0 - 2.0 * std::tan(1.2 * time), 1e-4));
    const Stand now = motion.at(time);
    const glm::vec3 axis = now.turn * glm::vec3(0, 1, 0);
    CHECK(axis.x == doctest::Approx(-2.0 * std::sin(1.2 * time)).epsilon(1e-4).scale(1.0));
    CHECK(axis.y == relative(2.0 * std::cos(1.2 * time), 1e-4));
    CHECK(now.origin_m.z == doctest::Approx(3.0 * time));
  }
}

TEST_CASE("debris that turns over while the shutter is open has the normals of its faces at each instant") {
  scene::ResolvedScene scene;
  scene.materials.emplace_back();
  instant::Instant instant = instant_from({-4.0, 0.0, 0.0}, 0.02, 8, even_sky(0.25f)), later = instant;
  const auto loose = [](const std::array<glm::vec3, 3>& corners) {
    instant::LooseMesh mesh;
    for (const glm::vec3& corner : corners) mesh.mesh.vertices.push_back({corner, glm::vec3(0, 0, 1), {}});
    return mesh;
  };
  const std::array<glm::vec3, 3> from{{{0, 3, -2}, {0, -3, -2}, {0, 0, 4}}},
      to{{{1, 3, -2}, {-2, -3, -1}, {2.5, 0, 4}}};
  instant.loose = {loose(from)};
  later.loose = {loose(to)};
  // Motion of its frame, which its vertices compensate.
  later.loose.front().mesh.origin_m = {0.0, 0.0, 1.0};
  for (scene::SurfaceVertex& vertex : later.loose.front().mesh.vertices) vertex.position_m.z -= 1.0f;
  const TracedPicture picture = traced_until(scene, instant, later, {.samples = 512});
  glm::dvec3 found(0.0), expected(0.0);
  for (const TracedPixel& pixel : picture.pixels) found += glm::dvec3(pixel.normal) / 64.0;
  for (int n = 0; n < 1000; ++n) {
    const glm::vec3 normal = face_normal({from, to}, (static_cast<float>(n) + 0.5f) / 1000.0f);
    expected += glm::dvec3(normal.x < 0.0f ? normal : -normal) / 1000.0;
  }
  CHECK(glm::length(found - expected) < 5e-3);
}

}  // namespace septet::raytrace
