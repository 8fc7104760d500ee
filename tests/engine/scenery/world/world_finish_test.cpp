#include "engine/scenery/world/world_finish.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scene/bitmap_image.hpp"
#include "engine/scene/store.hpp"

namespace septet::scenery {
namespace {

/// Colour of the palette's picture where a polygon of that ground has its texture coordinates.
std::vector<std::uint8_t> palette_color(const scene::TextureImage& picture, Ground ground) {
  geometry::MeshBuilder builder;
  builder.material = index_of(ground);
  builder.patch({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  geometry::PolygonMesh mesh = builder.take();
  to_palette(mesh);
  REQUIRE(mesh.polygon_materials[0] == index_of(Ground::palette));
  const glm::vec2 uv = mesh.corner_uvs[0][0];
  const auto column = static_cast<std::size_t>(uv.x * static_cast<float>(picture.width)),
             row = static_cast<std::size_t>(uv.y * static_cast<float>(picture.height));
  const auto pixel = picture.rgba.begin() + static_cast<std::ptrdiff_t>((row * picture.width + column) * 4);
  return {pixel, pixel + 3};
}

}  // namespace

TEST_CASE("what is drawn from far has the colour of its own ground in the palette's picture") {
  scene::Store store;
  scene::SceneBuilder builder(store);
  add_world_finishes(builder, 1, false);
  const scene::Node* palette = store.find(scene::NodeType::bitmap, "palette");
  REQUIRE(palette != nullptr);
  const scene::TextureImage picture = scene::image_of_bitmap(*palette);
  const auto mark = palette_color(picture, Ground::far_mark), verge = palette_color(picture, Ground::far_verge),
             rape = palette_color(picture, Ground::far_rape), canopy = palette_color(picture, Ground::far_canopy);
  CHECK(std::ranges::min(mark) > std::ranges::max(canopy));  // Paint is bright.
  CHECK(verge[1] > verge[2]);                                // Grass is green,
  CHECK(rape[0] > rape[2]);                                  // rape yellow,
  CHECK(rape[1] > canopy[1]);
  CHECK(canopy[1] > canopy[2]);  // and leaves are dark green.
}

}  // namespace septet::scenery
