/// Images of emission, roughness, metallic, occlusion and normals, by the rasteriser and by the ray tracer: both show
/// the same. Software device, validation layer on.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "engine/image/png.hpp"
#include "engine/image/srgb.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::render::maps {
namespace {

using scene::SurfaceMap;
/// Upper left, upper right, lower left, lower right, as the picture of a map has them.
using Quarters = std::array<glm::vec3, 4>;

/// Image of four even quarters.
scene::TextureImage quarters_image(const std::array<std::array<std::uint8_t, 3>, 4>& codes, bool srgb) {
  constexpr std::uint32_t side = 64;
  scene::TextureImage image{.revision = 1, .width = side, .height = side, .srgb = srgb, .rgba = {}};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto& code = codes[2 * (2 * y / side) + 2 * x / side];
      image.rgba.insert(image.rgba.end(), {code[0], code[1], code[2], 255});
    }
  return image;
}

/// An upright plate that fills the view, with one map whose picture the viewer sees upright, or mirrored.
scene::ResolvedScene plate(const scene::SurfaceMaterial& look, bool mirrored = false) {
  scene::ResolvedScene scene = instant::plate_scene({}, true);
  const std::uint64_t revision = scene.materials[0].revision;
  scene.materials[0] = look;
  scene.materials[0].revision = revision;
  for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) {
    vertex.uv = {0.5f - vertex.position_m.y / 6.0f, 0.5f - vertex.position_m.z / 6.0f};
    if (mirrored) vertex.uv.x = 1.0f - vertex.uv.x;
  }
  return scene;
}

void set_map(scene::ResolvedScene& scene, SurfaceMap map, const scene::TextureImage& image) {
  scene.materials[0].maps[map] = static_cast<std::int32_t>(scene.images.size());
  scene.images.push_back(image);
}

/// Sun from behind the eye, to the right and above.
instant::FrameInput input_of(std::uint32_t side_px) {
  instant::FrameInput input;
  input.environment = instant::plate_day();
  input.environment.sun_azimuth_rad = 1.25 * 3.14159265358979;
  input.views = {instant::plate_view(side_px)};
  return input;
}

void write(const std::string& name, std::uint32_t side, const std::vector<glm::vec3>& radiance) {
  image::Image picture(side, side);
  for (std::size_t i = 0; i < radiance.size(); ++i)
    for (int c = 0; c < 3; ++c)
      picture.rgba[4 * i + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(255.0f * glm::clamp(image::srgb_of_light(0.3f * radiance[i][c]), 0.0f, 1.0f));
  image::write_png(build_folder() + "/images/" + name + ".png", picture);
}

/// Means over the middle of each quarter of the picture.
Quarters means(std::uint32_t side, const std::vector<glm::vec3>& radiance) {
  Quarters sums{};
  for (std::uint32_t q = 0; q < 4; ++q)
    for (std::uint32_t y = side / 8; y < 3 * side / 8; ++y)
      for (std::uint32_t x = side / 8; x < 3 * side / 8; ++x)
        sums[q] +=
            radiance[(y + q / 2 * side / 2) * side + x + q % 2 * side / 2] * (16.0f / static_cast<float>(side * side));
  return sums;
}

Quarters rasterised(const scene::ResolvedScene& scene, const std::string& name) {
  constexpr std::uint32_t side = 64;
  Renderer renderer = *Renderer::create({side, side, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  REQUIRE(renderer.draw(input_of(side)).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  const std::vector<glm::vec3> radiance = renderer.read_radiance()->radiance;
  write(name + " rasterised", side, radiance);
  return means(side, radiance);
}

Quarters traced(const scene::ResolvedScene& scene, const std::string& name) {
  constexpr std::uint32_t side = 32;
  const raytrace::TracedPicture picture = raytrace::traced(
      scene, instant::describe(input_of(side), instant::summarise(scene)), {.samples = 256, .seed = 3});
  std::vector<glm::vec3> radiance;
  radiance.reserve(picture.pixels.size());
  for (const raytrace::TracedPixel& pixel : picture.pixels) radiance.push_back(pixel.radiance);
  write(name + " traced", side, radiance);
  return means(side, radiance);
}

struct Both {
  Quarters rasterised, traced;
};
Both both(const scene::ResolvedScene& scene, const std::string& name) {
  return {rasterised(scene, name), traced(scene, name)};
}

scene::SurfaceMaterial grey(float albedo) {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(albedo);
  material.roughness = 1.0f;
  return material;
}

void check_alike(const Both& seen, double tolerance) {
  for (std::size_t q = 0; q < 4; ++q) {
    CAPTURE(q);
    for (int c = 0; c < 3; ++c) CHECK(double(seen.rasterised[q][c]) == relative(double(seen.traced[q][c]), tolerance));
  }
}

}  // namespace

TEST_CASE("an image of the emission colours it in both renderers, and nothing else does") {
  scene::SurfaceMaterial look = grey(0.2f);
  const Both dark = both(plate(look), "maps without emission");
  look.emission = {2.0f, 1.0f, 0.5f};
  const Both plain = both(plate(look), "maps emission plain");
  scene::ResolvedScene scene = plate(look);
  // An image of the base colour does not colour an emission that has its own.
  scene.materials[0].base_color_image = 0;
  scene.images.push_back(quarters_image({{{255, 255, 255}, {255, 255, 255}, {255, 255, 255}, {255, 255, 255}}}, true));
  set_map(scene, SurfaceMap::emission,
          quarters_image({{{0, 0, 0}, {255, 0, 0}, {0, 255, 255}, {188, 188, 188}}}, true));
  const Both mapped = both(scene, "maps emission");
  check_alike(mapped, 0.06);
  const Quarters share{glm::vec3(0.0f), {1, 0, 0}, {0, 1, 1}, glm::vec3(0.5f)};
  for (std::size_t q = 0; q < 4; ++q) {
    CAPTURE(q);
    const glm::vec3 emitted = plain.rasterised[q] - dark.rasterised[q];
    CHECK(glm::length(mapped.rasterised[q] - dark.rasterised[q] - emitted * share[q]) < 0.02f * glm::length(emitted));
    CHECK(glm::length(mapped.traced[q] - dark.traced[q] - emitted * share[q]) < 0.03f * glm::length(emitted));
  }
}

TEST_CASE("an image of the base colour does not colour an emission in either renderer") {
  scene::SurfaceMaterial look = grey(0.2f);
  const auto colored = [](const scene::SurfaceMaterial& material) {
    scene::ResolvedScene scene = plate(material);
    scene.materials[0].base_color_image = 0;
    scene.images.push_back(quarters_image({{{0, 0, 0}, {255, 0, 0}, {0, 255, 255}, {188, 188, 188}}}, true));
    return scene;
  };
  const Both dark = both(colored(look), "maps colour");
  look.emission = {2.0f, 1.0f, 0.5f};
  const Both shining = both(colored(look), "maps colour and emission");
  check_alike(shining, 0.06);
  const glm::vec3 emitted = shining.rasterised[0] - dark.rasterised[0];
  CHECK(emitted.r > 0.0f);
  for (std::size_t q = 0; q < 4; ++q) {
    CAPTURE(q);
    CHECK(glm::length(shining.rasterised[q] - dark.rasterised[q] - emitted) < 0.02f * glm::length(emitted));
    CHECK(glm::length(shining.traced[q] - dark.traced[q] - emitted) < 0.03f * glm::length(emitted));
  }
}

TEST_CASE("roughness and metallic of an image are those of a material with its numbers, in both renderers") {
  scene::SurfaceMaterial look = grey(0.5f);
  look.base_color = {0.7f, 0.4f, 0.1f};
  look.metallic = 1.0f;
  scene::ResolvedScene scene = plate(look);
  set_map(scene, SurfaceMap::properties,
          quarters_image({{{255, 128, 0}, {255, 128, 255}, {255, 64, 255}, {255, 77, 0}}}, false));
  const Both mapped = both(scene, "maps properties");
  const std::array<std::array<float, 2>, 4> roughness_metallic{
      {{128.0f / 255.0f, 0.0f}, {128.0f / 255.0f, 1.0f}, {64.0f / 255.0f, 1.0f}, {77.0f / 255.0f, 0.0f}}};
  for (std::size_t q = 0; q < 4; ++q) {
    CAPTURE(q);
    look.roughness = roughness_metallic[q][0];
    look.metallic = roughness_metallic[q][1];
    const Both even = both(plate(look), "maps properties " + std::to_string(q));
    for (int c = 0; c < 3; ++c) {
      CHECK(double(mapped.rasterised[q][c]) == relative(double(even.rasterised[q][c]), 0.01));
      CHECK(double(mapped.traced[q][c]) == relative(double(even.traced[q][c]), 0.04));
    }
  }
}

TEST_CASE("an image darkens the light from around and not the sun's, alike in both renderers") {
  scene::ResolvedScene scene = plate(grey(0.5f));
  const Both open = both(scene, "maps without occlusion");
  set_map(scene, SurfaceMap::properties,
          quarters_image({{{255, 255, 255}, {170, 255, 255}, {85, 255, 255}, {0, 255, 255}}}, false));
  const Both seen = both(scene, "maps occlusion");
  check_alike(seen, 0.08);
  for (const Quarters& quarters : {seen.rasterised, seen.traced}) {
    // The light from around is taken in three even steps, and the sun's is left.
    const float step = quarters[0].b - quarters[1].b;
    CHECK(step > 0.05f * quarters[0].b);
    CHECK(quarters[1].b - quarters[2].b == relative(double(step), 0.25));
    CHECK(quarters[2].b - quarters[3].b == relative(double(step), 0.25));
    CHECK(quarters[3].r > 0.3f * quarters[0].r);
  }
  // Where nothing is taken, the layer that an image of properties has is all that differs.
  CHECK(seen.rasterised[0].g == relative(double(open.rasterised[0].g), 0.1));
}

TEST_CASE("normals of an image lean along u and up in the picture, in both renderers, also where it lies mirrored") {
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    scene::ResolvedScene scene = plate(grey(0.5f), mirrored);
    const Quarters even = rasterised(scene, "maps without normals");
    // Out of the surface, and leaning by 45° along u, up, and against u.
    set_map(scene, SurfaceMap::normal,
            quarters_image({{{128, 128, 255}, {218, 128, 218}, {128, 218, 218}, {37, 128, 218}}}, false));
    const Both seen = both(scene, mirrored ? "maps normal mirrored" : "maps normal");
    check_alike(seen, 0.08);
    for (const Quarters& quarters : {seen.rasterised, seen.traced}) {
      const glm::vec3 flat = quarters[mirrored ? 1 : 0], along = quarters[mirrored ? 0 : 1],
                      up = quarters[mirrored ? 3 : 2], against = quarters[mirrored ? 2 : 3];
      CHECK(flat.g == relative(even[0].g, 0.05));
      CHECK(up.g > 1.1f * flat.g);
      // The sun is on the right.
      const glm::vec3 right = mirrored ? against : along, left = mirrored ? along : against;
      CHECK(right.g > 1.1f * flat.g);
      CHECK(left.g < 0.6f * flat.g);
    }
  }
}

TEST_CASE("an image that ends goes on as its edge is, and a sharp one has even pixels, in both renderers") {
  scene::SurfaceMaterial look = grey(0.0f);
  look.emission = glm::vec3(4.0f);
  scene::ResolvedScene scene = plate(look);
  // The image takes the upper left sixteenth of the plate; to the right its right column goes on.
  for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) vertex.uv *= 4.0f;
  scene::TextureImage image = quarters_image({{{255, 0, 0}, {0, 255, 0}, {255, 0, 0}, {0, 255, 0}}}, true);
  image.sampling.clamps_u = true;
  set_map(scene, SurfaceMap::emission, image);
  const Both ends = both(scene, "maps clamped");
  // Two pixels: smoothed, the middle of a quarter would be a mixture.
  for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) vertex.uv /= 4.0f;
  scene.images[0] = {.revision = 1, .width = 2, .height = 1, .rgba = {255, 0, 0, 255, 0, 255, 0, 255}};
  scene.images[0].sampling.sharp = true;
  const Both sharp = both(scene, "maps sharp");
  for (const Quarters& quarters : {ends.rasterised, ends.traced}) {
    CHECK(quarters[1].r < 0.1f * quarters[1].g);
    CHECK(quarters[3].r < 0.1f * quarters[3].g);
  }
  for (const Quarters& quarters : {sharp.rasterised, sharp.traced}) {
    CHECK(quarters[0].g < 0.1f * quarters[0].r);
    CHECK(quarters[1].r < 0.1f * quarters[1].g);
  }
}

TEST_CASE("the colours of vertices multiply the base colour between them, in both renderers") {
  scene::ResolvedScene scene = plate(grey(0.5f));
  const Both white = both(scene, "maps vertices white");
  // From dark on the left to white on the right, and no red.
  for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) {
    const float share = glm::clamp(vertex.uv.x, 0.0f, 1.0f);
    vertex.color = glm::packUnorm4x8(glm::vec4(0.0f, share, share, 1.0f));
  }
  const Both seen = both(scene, "maps vertices coloured");
  const auto check = [](const Quarters& coloured, const Quarters& plain) {
    for (std::size_t q = 0; q < 4; ++q) {
      CAPTURE(q);
      CHECK(coloured[q].r < 0.02f * plain[q].r);
      const double share = double(coloured[q].g) / double(plain[q].g);
      CHECK(share == relative(q % 2 == 0 ? 0.25 : 0.75, 0.2));
    }
  };
  check(seen.rasterised, white.rasterised);
  check(seen.traced, white.traced);
}

TEST_CASE("a vertex's own tangent turns the normals of an image, in both renderers") {
  scene::ResolvedScene scene = plate(grey(0.5f));
  // All lean along the image's red, which the coordinates have on the right, towards the sun.
  const std::array<std::uint8_t, 3> along{218, 128, 218};
  set_map(scene, SurfaceMap::normal, quarters_image({{along, along, along, along}}, false));
  const Both right = both(scene, "maps tangent by coordinates");
  const auto with_tangent = [&](const glm::vec4& tangent, const std::string& name) {
    for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) vertex.tangent = glm::packSnorm4x8(tangent);
    return both(scene, name);
  };
  const Both same = with_tangent({0, -1, 0, 1}, "maps tangent right"),
             left = with_tangent({0, 1, 0, 1}, "maps tangent left"), up = with_tangent({0, 0, 1, 1}, "maps tangent up");
  check_alike(left, 0.08);
  check_alike(up, 0.08);
  for (const auto which : {&Both::rasterised, &Both::traced}) {
    CHECK((same.*which)[0].g == relative(double((right.*which)[0].g), 0.02));
    CHECK((left.*which)[0].g < 0.6f * (right.*which)[0].g);
    CHECK((up.*which)[0].g > 1.1f * (left.*which)[0].g);
  }
  // The side of green: the image leans up, and with −1 down.
  scene.images.back() = quarters_image({{{128, 218, 218}, {128, 218, 218}, {128, 218, 218}, {128, 218, 218}}}, false);
  const Both upwards = with_tangent({0, -1, 0, 1}, "maps green up"),
             downwards = with_tangent({0, -1, 0, -1}, "maps green down");
  for (const auto which : {&Both::rasterised, &Both::traced})
    CHECK((upwards.*which)[0].g > 1.2f * (downwards.*which)[0].g);
}

TEST_CASE("an image lies by the second coordinates where the material says so, in both renderers") {
  scene::SurfaceMaterial look = grey(0.0f);
  look.emission = glm::vec3(4.0f);
  look.by_second_uv = 1;
  scene::ResolvedScene scene = plate(look);
  set_map(scene, SurfaceMap::emission, quarters_image({{{255, 0, 0}, {0, 255, 0}, {255, 0, 0}, {0, 255, 0}}}, true));
  for (scene::SurfaceVertex& vertex : scene.meshes[0].vertices) vertex.second_uv = {1.0f - vertex.uv.x, vertex.uv.y};
  const Both seen = both(scene, "maps second coordinates");
  for (const Quarters& quarters : {seen.rasterised, seen.traced}) {
    CHECK(quarters[0].r < 0.1f * quarters[0].g);
    CHECK(quarters[1].g < 0.1f * quarters[1].r);
  }
}

}  // namespace septet::render::maps
