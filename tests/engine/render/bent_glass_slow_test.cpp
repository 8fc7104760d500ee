/// A mesh in several poses, as a bent one is kept, of a see-through material: it is blended as one that stands is, from
/// either side, in both renderers. Software device, validation layer on.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/math/pose_keys.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/keyed_part.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::render::bent_glass {
namespace {

constexpr double period_s = 2.0;

/// The plate in two poses of one row: before the eye in the first half of the time, then far below the ground.
scene::ResolvedScene posed(scene::ResolvedScene scene) {
  scene::Prototype bent;
  PoseKey there, gone;
  gone.scale = glm::vec3(0.0f);
  bent.parts.push_back(scene.instances.at(0));
  bent.parts.push_back(bent.parts[0]);
  for (const bool first : {true, false}) {
    std::vector<PoseKey> keys{first ? there : gone, first ? there : gone, first ? gone : there, first ? gone : there};
    keys[1].at_s = keys[2].at_s = 0.5f * float(period_s);
    keys[3].at_s = float(period_s);
    scene::Instance& part = bent.parts[first ? 0 : 1];
    if (!first) part.world_from_object.position_m.z -= 500.0;
    part.keyed =
        std::make_shared<const scene::KeyedPart>(scene::KeyedPart{{}, {part.world_from_object, part.scale}, keys});
  }
  scene.prototypes.push_back(bent);
  scene.instances.clear();
  return scene;
}

instant::FrameInput input_at(double time_s, std::uint32_t side_px, bool is_bent) {
  instant::FrameInput input;
  input.environment = instant::plate_day();
  input.views = {instant::plate_view(side_px)};
  input.simulated_time_s = time_s;
  if (is_bent) input.participants.emplace_back();
  return input;
}

glm::dvec3 rasterised(const scene::ResolvedScene& scene, const instant::FrameInput& input) {
  constexpr std::uint32_t side = 64;
  Renderer renderer = *Renderer::create({side, side, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return renderer.read_radiance()->at(32, 30);
}

glm::dvec3 traced(const scene::ResolvedScene& scene, const instant::FrameInput& input) {
  const raytrace::TracedPicture picture =
      raytrace::traced(scene, instant::describe(input, instant::summarise(scene)), {.samples = 256, .seed = 3});
  glm::dvec3 sum(0.0);
  for (const std::size_t at : {27, 28, 35, 36}) sum += glm::dvec3(picture.pixels[at].radiance) / 4.0;
  return sum;
}

}  // namespace

TEST_CASE("a see-through mesh in poses is blended as one that stands, from both sides, in both renderers") {
  for (const bool from_behind : {false, true})
    for (const bool by_picture : {false, true}) {
      CAPTURE(from_behind);
      CAPTURE(by_picture);
      instant::PlateLook look{.two_sided = true, .from_behind = from_behind, .opacity = by_picture ? 0.998f : 0.5f};
      const auto scene_of = [&](bool there) {
        scene::ResolvedScene scene = instant::plate_scene(look, there);
        if (!by_picture) return scene;
        scene.materials[0].base_color_image = 0;
        scene.images.push_back({.revision = 1, .width = 1, .height = 1, .rgba = {255, 255, 255, 128}});
        return scene;
      };
      const scene::ResolvedScene standing = scene_of(true), nothing = scene_of(false), bent = posed(scene_of(true));
      look.opacity = 1.0f;
      const scene::ResolvedScene opaque = instant::plate_scene(look, true);
      for (const bool is_traced : {false, true}) {
        CAPTURE(is_traced);
        const std::uint32_t side = is_traced ? 8 : 64;
        const auto seen = [&](const scene::ResolvedScene& scene, double time_s, bool is_bent) {
          const instant::FrameInput input = input_at(time_s, side, is_bent);
          return is_traced ? traced(scene, input) : rasterised(scene, input);
        };
        const double noise = is_traced ? 0.04 : 0.002;
        const glm::dvec3 behind = seen(nothing, 0.5, false), through = seen(standing, 0.5, false),
                         whole = seen(opaque, 0.5, false), there = seen(bent, 0.5, true), gone = seen(bent, 1.5, true);
        CHECK(glm::length(there - through) < noise * glm::length(through));
        CHECK(glm::length(gone - behind) < noise * glm::length(behind));
        // Neither whole nor gone: about half way.
        const double share = glm::dot(there - behind, whole - behind) / glm::dot(whole - behind, whole - behind);
        CHECK(share == relative(0.5, 0.2));
      }
    }
}

TEST_CASE("of a two-sided see-through mesh the far side is drawn before the near one, in whatever order they stand") {
  const auto seen = [](bool near_first) {
    scene::ResolvedScene scene = instant::plate_scene({.two_sided = true, .opacity = 0.5f}, true);
    scene::SurfaceMesh& box = scene.meshes[0];
    box.bounds_max_m.x = 1.0f;
    for (std::size_t i = 0; i < 4; ++i) {
      scene::SurfaceVertex far = box.vertices[i];
      far.position_m.x = 1.0f;
      far.normal = -far.normal;
      far.color = 0xFF000000u;
      box.vertices.push_back(far);
    }
    const std::vector<std::uint32_t> near_side = box.indices, far_side{4, 6, 5, 4, 7, 6};
    box.indices = near_first ? near_side : far_side;
    const auto& last = near_first ? far_side : near_side;
    box.indices.insert(box.indices.end(), last.begin(), last.end());
    box.parts[0].index_count = 12;
    return rasterised(scene, input_at(0.5, 64, false));
  };
  const glm::dvec3 near_first = seen(true), far_first = seen(false);
  CHECK(glm::length(near_first - far_first) < 0.002 * glm::length(far_first));
}

}  // namespace septet::render::bent_glass
