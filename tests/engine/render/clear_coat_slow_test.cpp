/// Effect of a clear coat on a surface, in pictures of a level board under clouds. Software device, validation layer
/// on.

#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render::coats {
namespace {

constexpr std::uint32_t side_px = 32;

/// Radiance in the middle of a board, viewed at `down_rad` below the level.
struct Board {
  Renderer renderer =
      *Renderer::create({side_px, side_px, DevicePreference::software, true, Antialiasing::none, nullptr});
  FrameInput input;

  Board() {
    input.environment = instant::reference_day();
    input.environment.cloud_cover = 1.0;
    input.environment.visibility_m = 200e3;
    input.views.resize(1);
    input.views[0].viewport = {0, 0, side_px, side_px};
  }

  glm::vec3 seen(float grey, float clear_coat, double down_rad, float roughness = 0.8f) {
    scene::SurfaceMaterial material;
    material.base_color = glm::vec3(grey);
    material.roughness = roughness;
    material.clear_coat = clear_coat;
    scene::SurfaceMesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-60, -60), glm::vec2(60, -60), glm::vec2(60, 60), glm::vec2(-60, 60)})
      mesh.vertices.push_back({glm::vec3(corner, 0.0f), {0, 0, 1}, {}});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::ResolvedScene scene = instant::lone_mesh(material, mesh, {Vec3(0.0), {1, 0, 0, 0}});
    static std::uint64_t revision = 1;
    scene.revision = ++revision;
    REQUIRE(renderer.upload(scene).has_value());
    input.views[0].projection = instant::symmetric_view({0.0, 0.0, 3.0}, 0.0, -down_rad, 0.05, 0.05);
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    return renderer.read_radiance()->at(side_px / 2, side_px / 2);
  }

  glm::vec3 sky(double up_rad) const {
    const instant::SkyLight light = instant::sky_light(input.environment);
    return instant::sky_radiance(light,
                                 {static_cast<float>(std::cos(up_rad)), 0.0f, static_cast<float>(std::sin(up_rad))});
  }
};

double schlick(double cosine) { return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0); }

}  // namespace

TEST_CASE("a clear coat mirrors the sky as glass does and lets so much less light to its base and back") {
  Board board;
  for (const double down_rad : {0.15, 0.4, 1.0}) {
    CAPTURE(down_rad);
    const double fresnel = schlick(std::sin(down_rad)), sky = double(board.sky(down_rad).g);
    const double plain = double(board.seen(0.6f, 0.0f, down_rad).g), black = double(board.seen(0.0f, 1.0f, down_rad).g),
                 coated = double(board.seen(0.6f, 1.0f, down_rad).g);
    CHECK(black / (fresnel * sky) == relative(1.0, 0.06));
    // A twelfth of the light of a whole sky does not reach the base.
    CHECK((coated - black) / plain == relative((1.0 - fresnel) * 0.92, 0.02));
    // A half coating gives the mean of both.
    const double half = double(board.seen(0.6f, 0.5f, down_rad).g);
    CHECK(half == relative(0.5 * (plain + coated), 0.02));
  }
}

TEST_CASE("a rougher layer mirrors less of a low sky and as much straight down") {
  Board board;
  CHECK(board.seen(0.0f, 0.0f, 0.15, 0.5f).g < 0.6f * board.seen(0.0f, 0.0f, 0.15, 0.06f).g);
  CHECK(board.seen(0.0f, 0.0f, 1.4, 0.5f).g == relative(board.seen(0.0f, 0.0f, 1.4, 0.06f).g, 0.15));
}

}  // namespace septet::render::coats
