#include "engine/render/passes/static_geometry.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/render/passes/ice_tiles.hpp"

namespace septet::render {
namespace {

/// A mesh of two materials: two triangles of the first, one of the second.
scene::SurfaceMesh two_parts() {
  scene::SurfaceMesh mesh;
  for (const glm::vec3 p : {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}})
    mesh.vertices.push_back({p, {0, 0, 1}, {p.x, p.y}});
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 1, 4};
  mesh.parts = {{0, 6, 0}, {6, 3, 1}};
  mesh.bounds_max_m = glm::vec3(1.0f);
  return mesh;
}

scene::ResolvedScene scattered(std::size_t count) {
  Random random(9);
  scene::ResolvedScene scene;
  scene.materials.resize(2);
  for (std::size_t i = 0; i < count; ++i) {
    scene.meshes.push_back(two_parts());
    scene::Instance instance;
    instance.mesh = static_cast<std::uint32_t>(i);
    instance.world_from_object = {{random.uniform(-5000, 5000), random.uniform(-5000, 5000), random.uniform(0, 50)},
                                  orientation_from_angles(random.uniform(-3, 3), random.uniform(-1, 1), 0.2)};
    instance.scale = glm::vec3(1.0f, 2.0f, 0.5f);
    instance.visible_to_m = i % 2 ? 3000.0f : 8000.0f;
    scene.instances.push_back(instance);
  }
  return scene;
}

bool everything(const PlacedMesh&, const glm::vec3&) { return true; }
std::uint32_t own_material(std::uint32_t material) { return material; }

}  // namespace

TEST_CASE("meshes that are placed twice or belong to a prototype are not static") {
  scene::ResolvedScene scene = scattered(4);
  scene.instances.push_back(scene.instances[1]);
  scene.prototypes.push_back({"model/x", {scene.instances[2]}});
  CHECK(placed_once(scene) == std::vector<bool>{true, false, false, true});
}

TEST_CASE("gathered vertices lie where their instance puts them to a tenth of a millimetre") {
  const scene::ResolvedScene scene = scattered(200);
  const StaticGeometry geometry = static_geometry(scene, placed_once(scene));
  REQUIRE(geometry.pieces.size() == 200);
  double worst_m = 0.0;
  for (const StaticPiece& piece : geometry.pieces) {
    const scene::Instance& instance = scene.instances[piece.placed.mesh];
    const StaticBlock& block = geometry.blocks[piece.block];
    for (std::uint32_t i = 0; i < piece.part_count; ++i) {
      const StaticPart& part = geometry.parts[piece.first_part + i];
      for (std::uint32_t k = 0; k < part.index_count; ++k) {
        const std::uint32_t source = scene.meshes[0].indices[scene.meshes[0].parts[i].first_index + k];
        const Vec3 expected =
            instance.world_from_object * Vec3(scene.meshes[0].vertices[source].position_m * instance.scale);
        const Vec3 found = block.origin_m + Vec3(block.vertices[geometry.indices[part.first_index + k]].position_m);
        worst_m = std::max(worst_m, glm::length(found - expected));
      }
    }
  }
  CHECK(worst_m < 2e-4);
}

TEST_CASE("a frame gathers just the pieces in range and one draw for each block and material") {
  scene::ResolvedScene scene = scattered(400);
  const Vec3 eye_m(300, -200, 5);
  for (std::size_t i = 0; i < 20; ++i)  // Seen half way through the band where their range ends.
    scene.instances[i].visible_to_m =
        static_cast<float>(glm::length(scene.instances[i].world_from_object.position_m - eye_m));
  const StaticGeometry geometry = static_geometry(scene, placed_once(scene));
  std::size_t wanted = 0, fading = 0;
  for (const scene::Instance& instance : scene.instances) {
    const auto away_m = static_cast<float>(glm::length(instance.world_from_object.position_m - eye_m));
    const LevelFade fade = fade_at(away_m, 0.0f, instance.visible_to_m);
    wanted += !fade.none();
    fading += !fade.none() && !fade.all();
  }
  const Gathered gathered = gather(geometry, eye_m, everything, own_material);
  CHECK(wanted > 50);
  CHECK(wanted < 400);
  CHECK(gathered.pieces == wanted);
  CHECK(gathered.indices.size() == 9 * wanted);
  CHECK(fading > 10);
  CHECK(gathered.draws.size() <= 2 * (geometry.blocks.size() + fading));
  std::size_t of_fading = 0;
  for (const GatheredDraw& draw : gathered.draws)
    if (!draw.fade.all()) of_fading += draw.index_count;
  CHECK(of_fading == 9 * fading);
  std::size_t counted = 0;
  for (const GatheredDraw& draw : gathered.draws) {
    CHECK(draw.first_index == counted);
    counted += draw.index_count;
    for (std::uint32_t i = 0; i < draw.index_count; ++i)
      REQUIRE(gathered.indices[draw.first_index + i] < geometry.blocks[draw.block].vertices.size());
  }
  CHECK(counted == gathered.indices.size());
}

TEST_CASE("of a wide mesh a view takes the clumps that it may see, and with all views around an eye none is missed") {
  scene::ResolvedScene scene = scattered(1);
  scene::SurfaceMesh& wide = scene.meshes[0];
  wide = {};
  constexpr std::uint32_t cells = 100;
  for (std::uint32_t i = 0; i < cells; ++i)
    for (std::uint32_t j = 0; j < cells; ++j)
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
        wide.indices.push_back(static_cast<std::uint32_t>(wide.vertices.size()));
        wide.vertices.push_back({{float(i) + float(x), float(j) + float(y), 0.3f * float(j % 3)}, {0, 0, 1}, {}});
      }
  wide.parts = {{0, 3 * cells * cells, 0}};
  wide.bounds_min_m = glm::vec3(0.0f);
  wide.bounds_max_m = glm::vec3(cells, cells, 1.0f);
  scene.instances[0].world_from_object = {{20.0, -30.0, 2.0}, {}};
  scene.instances[0].scale = glm::vec3(1.0f);
  const StaticGeometry geometry = static_geometry(scene, placed_once(scene));
  const Vec3 eye_m(61.3, 11.7, 3.0);
  std::vector<bool> taken(wide.indices.size(), false);
  std::size_t drawn = 0;
  for (const FrameView& view : surrounding_views(eye_m, 32)) {
    const ViewVolume volume = view_volume(view);
    const Gathered seen = gather(geometry, eye_m, everything, own_material, {}, &volume);
    drawn += seen.indices.size();
    for (const std::uint32_t index : seen.indices) taken[index] = true;
    const glm::vec3 origin(geometry.blocks[0].origin_m - eye_m);
    std::vector<bool> here(wide.indices.size(), false);
    for (const std::uint32_t index : seen.indices) here[index] = true;
    int missed = 0;
    for (std::uint32_t i = 0; i < wide.indices.size(); ++i)
      missed += intersects(volume, origin + geometry.blocks[0].vertices[i].position_m, 0.0f) && !here[i];
    CHECK(missed == 0);
  }
  CHECK(std::ranges::find(taken, false) == taken.end());
  CHECK(drawn < 3 * wide.indices.size());
}

TEST_CASE("materials of one group share a draw and those of none are left out") {
  const scene::ResolvedScene scene = scattered(100);
  const StaticGeometry geometry = static_geometry(scene, placed_once(scene));
  const Gathered merged = gather(geometry, {0, 0, 0}, everything, [](std::uint32_t) { return 0u; });
  CHECK(merged.pieces > 0);
  CHECK(merged.indices.size() == 9 * merged.pieces);
  std::size_t whole = 0;
  for (const GatheredDraw& draw : merged.draws) whole += draw.fade.all();
  CHECK(whole <= geometry.blocks.size());
  const Gathered second =
      gather(geometry, {0, 0, 0}, everything, [](std::uint32_t material) { return material == 1 ? 1u : no_group; });
  CHECK(second.pieces == merged.pieces);
  CHECK(second.indices.size() == 3 * second.pieces);
}

TEST_CASE("a part that points outside its mesh is left out") {
  scene::ResolvedScene scene = scattered(2);
  scene.meshes[0].indices[7] = 1000;
  scene.meshes[1].parts[0].index_count = 1u << 31;
  const StaticGeometry geometry = static_geometry(scene, placed_once(scene));
  REQUIRE(geometry.pieces.size() == 2);
  CHECK(geometry.parts.size() == 2);
  CHECK(geometry.parts[0].material == 0);
  CHECK(geometry.parts[1].material == 1);
}

}  // namespace septet::render
