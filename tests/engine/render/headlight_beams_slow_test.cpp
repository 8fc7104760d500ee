/// Light of the dipped and the main beam in pictures, in candela and in candela per square metre. Software device,
/// validation layer on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/instant/headlight_beam.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render::beams {
namespace {

constexpr std::uint32_t side_px = 32;
constexpr double degree_rad = std::numbers::pi / 180.0;

/// One square of one material, lit by a pair of headlights at night.
struct Lit {
  Renderer renderer =
      *Renderer::create({side_px, side_px, DevicePreference::software, true, Antialiasing::none, nullptr});

  explicit Lit(const scene::SurfaceMaterial& material, const glm::vec3& middle, const glm::vec3& across,
               const glm::vec3& up) {
    scene::SurfaceMesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(across, up));
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
      mesh.vertices.push_back({across * corner.x + up * corner.y, normal, {}});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    REQUIRE(renderer.upload(instant::lone_mesh(material, mesh, {Vec3(middle), {1, 0, 0, 0}})).has_value());
  }

  /// Luminance in a direction from the eye, cd/m², of the beams alone.
  double luminance(const Vec3& eye_m, const Vec3& lamps_m, double down_rad, double left_rad, float main_beam = 0.0f) {
    FrameInput input;
    input.environment = instant::reference_day();
    input.environment.sun_elevation_rad = -0.4;
    input.environment.sun_illuminance_lux = 0.0;
    input.environment.visibility_m = 200e3;
    input.views.resize(1);
    input.views[0].projection = instant::symmetric_view(eye_m, left_rad, -down_rad, 0.002, 0.002);
    input.views[0].viewport = {0, 0, side_px, side_px};
    Instant instant = instant::describe(input, {});
    glm::vec3 light(0.0f);
    for (const bool lit : {true, false}) {
      instant.headlights.clear();
      if (lit) instant.headlights = {{lamps_m, {1, 0, 0}, instant::beam::pair_intensity, main_beam}};
      REQUIRE(renderer.draw(instant).has_value());
      light += renderer.read_radiance()->at(side_px / 2, side_px / 2) * (lit ? 1.0f : -1.0f);
    }
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    return double(instant::luminance_unit_cdpm2) * double(glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
  }
};

scene::SurfaceMaterial matt(float grey, float retroreflection = 0.0f) {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(grey);
  material.roughness = 1.0f;
  material.retroreflection = retroreflection;
  return material;
}

/// A white wall at 25 m, for reading each of two lamps' intensity in a direction, cd.
struct Screen25m {
  const Vec3 eye_m{0.0, 0.0, 1.2};
  Lit wall{matt(0.5f), {25.0f, 0.0f, 1.2f}, {0, -9, 0}, {0, 0, 9}};
  double candela(double down_degrees, double left_degrees, float main_beam = 0.0f) {
    const double down = down_degrees * degree_rad, left = left_degrees * degree_rad;
    const double ahead = std::cos(down) * std::cos(left), square = 625.0 / (ahead * ahead);
    return 0.5 * wall.luminance(eye_m, eye_m, down, left, main_beam) * std::numbers::pi / 0.5 * square /
           (0.7 * ahead + 0.3);
  }
};

}  // namespace

TEST_CASE(
    "on a white wall at 25 m each dipped beam gives at the points of UN Regulation 149 what it asks and no more than "
    "it "
    "allows") {
  Screen25m screen;
  struct Point {
    const char* name;
    double down, left, least, most;
  };
  for (const Point& point :
       {Point{"B50L", -0.57, 3.43, 0, 350}, Point{"BR", -1.0, -2.5, 0, 1750}, Point{"zone III", -0.2, 0.0, 0, 625},
        Point{"75R", 0.57, -1.15, 10100, 1e9}, Point{"75L", 0.57, 3.43, 0, 10600},
        Point{"50R", 0.86, -1.72, 10100, 1e9}, Point{"50L", 0.86, 3.43, 0, 13200}, Point{"50V", 0.86, 0.0, 5100, 1e9},
        Point{"25L", 1.72, 9.0, 1700, 1e9}, Point{"25R", 1.72, -9.0, 1700, 1e9}, Point{"zone IV", 1.2, 5.15, 2500, 1e9},
        Point{"zone I", 2.5, 0.0, 0, 17600}}) {
    const double drawn = screen.candela(point.down, point.left);
    CAPTURE(point.name);
    CAPTURE(drawn);
    CHECK(drawn >= point.least);
    CHECK(drawn <= point.most);
  }
  CHECK(screen.candela(0.57, -1.15) > 28.0 * screen.candela(-0.57, 3.43));
}

TEST_CASE(
    "on a white wall at 25 m each main beam gives at the points of UN Regulation 149 what it asks of class B and a "
    "vehicle's two no more than 430,000 cd") {
  Screen25m screen;
  const auto main_beam = [&](double down_degrees, double left_degrees) {
    return screen.candela(down_degrees, left_degrees, 1.0f);
  };
  double brightest = 0.0;
  for (const double down : {-1.0, -0.5, 0.0, 0.5, 0.8, 1.0, 1.5, 2.0})
    brightest = std::max(brightest, main_beam(down, 0.0));
  const double ahead = main_beam(0.0, 0.0);
  CAPTURE(brightest);
  CAPTURE(ahead);
  CHECK(brightest >= 40500.0);      // IM, 5.1.3.1.
  CHECK(2.0 * brightest <= 430e3);  // UN Regulation 48, 6.2.9, of all main beams together.
  CHECK(ahead >= 0.8 * brightest);
  struct Point {
    double aside, least;
  };
  for (const Point& point :
       {Point{3.0, 17500.0}, Point{6.0, 5000.0}, Point{9.0, 3400.0}, Point{12.0, 1500.0}})  // 5.1.3.2.
    for (const double side : {-1.0, 1.0}) {
      const double drawn = main_beam(0.0, side * point.aside);
      CAPTURE(point.aside);
      CAPTURE(drawn);
      CHECK(drawn >= point.least);
      CHECK(drawn < ahead);
    }
  // The main beam lights objects over the road, and not the sky.
  CHECK(main_beam(-1.0, 0.0) > 0.5 * ahead);
  CHECK(main_beam(-6.0, 0.0) < 0.03 * ahead);
}

TEST_CASE("thirty metres ahead own dipped beams show dry markings at 2 to 6 cd/m2, 4 to 20 times the asphalt") {
  const Vec3 eye_m(0.0, 0.0, 1.2), lamps_m(2.0, 0.0, 0.65);
  const auto seen = [&](const scene::SurfaceMaterial& material) {
    return Lit(material, {30.0f, 0.0f, 0.0f}, {9, 0, 0}, {0, 4, 0})
        .luminance(eye_m, lamps_m, std::atan(1.2 / 30.0), 0.0);
  };
  // Glass beads of class R4 in white paint.
  const double marking = seen(matt(0.72f, 0.25f)), asphalt = seen(matt(0.12f));
  CAPTURE(marking);
  CAPTURE(asphalt);
  CHECK(marking > 2.0);
  CHECK(marking < 6.0);
  CHECK(marking > 4.0 * asphalt);
  CHECK(marking < 20.0 * asphalt);
}

}  // namespace septet::render::beams
