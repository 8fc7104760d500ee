#include "engine/scene/resolve.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/scene/builder.hpp"
#include "tests/engine/scene/sample_commands.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

using geometry::PolygonMesh;

PolygonMesh cube() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_m.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  mesh.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

std::size_t triangles_of(const SurfaceMesh& mesh) { return mesh.indices.size() / 3; }

struct World {
  Store store;
  SceneBuilder build{store};
};

}  // namespace

TEST_CASE("a smooth mesh shares vertices and a sharp one has a normal for every face") {
  World w;
  PolygonMesh smooth = cube(), sharp = cube();
  sharp.default_edge_crease = geometry::crease_sharp;
  w.build.add_object("", {.geometry = w.build.add_mesh("smooth", smooth)});
  w.build.add_object("", {.geometry = w.build.add_mesh("sharp", sharp)});
  const ResolvedScene scene = resolve(w.store);
  REQUIRE(scene.meshes.size() == 2);
  CHECK(scene.meshes[0].vertices.size() == 8);
  CHECK(scene.meshes[1].vertices.size() == 24);
  for (const auto& mesh : scene.meshes) CHECK(triangles_of(mesh) == 12);
  for (const auto& v : scene.meshes[0].vertices)
    CHECK(glm::dot(v.normal, glm::normalize(v.position_m)) == doctest::Approx(1.0));
  for (const auto& v : scene.meshes[1].vertices) {
    const glm::vec3 n = glm::abs(v.normal);
    CHECK(std::max({n.x, n.y, n.z}) == doctest::Approx(1.0));
  }
  CHECK(scene.meshes[0].bounds_min_m == glm::vec3(-1.0f));
  CHECK(scene.meshes[0].bounds_max_m == glm::vec3(1.0f));
}

TEST_CASE("triangles face outwards") {
  World w;
  PolygonMesh mesh = cube();
  mesh.default_edge_crease = geometry::crease_sharp;
  w.build.add_object("", {.geometry = w.build.add_mesh("", mesh)});
  const ResolvedScene scene = resolve(w.store);
  const auto& surface = scene.meshes[0];
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto& a = surface.vertices[surface.indices[i]];
    const auto& b = surface.vertices[surface.indices[i + 1]];
    const auto& c = surface.vertices[surface.indices[i + 2]];
    const glm::vec3 normal = glm::cross(b.position_m - a.position_m, c.position_m - a.position_m);
    CHECK(glm::dot(normal, a.position_m) > 0.0f);
    CHECK(glm::dot(normal, a.normal) > 0.0f);
  }
}

TEST_CASE("one sharp edge splits normals at that edge alone") {
  World w;
  PolygonMesh roof;  // a ridge with a flat strip beside it
  for (int i = 0; i < 2; ++i)
    for (const glm::vec2 xz : {glm::vec2(-2, 0), {0, 1}, {2, 0}, {4, -1}}) roof.vertices_m.push_back({xz.x, i, xz.y});
  roof.polygons = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}};
  roof.edge_creases.assign(3, {0, 0, 0, 0});
  roof.edge_creases[1][3] = geometry::crease_sharp;  // from corner 3 (vertex 5) to corner 0 (vertex 1)
  w.build.add_object("", {.geometry = w.build.add_mesh("", roof)});
  CHECK(resolve(w.store).meshes[0].vertices.size() == 8 + 2);
}

TEST_CASE("a control cage is subdivided as its tag says") {
  World w;
  w.build.add_object("", {.geometry = w.build.add_mesh("", cube(), {.subdivision_level = 2})});
  const ResolvedScene scene = resolve(w.store);
  CHECK(triangles_of(scene.meshes[0]) == 6 * 16 * 2);
  CHECK(scene.meshes[0].bounds_max_m.x < 0.9f);
}

TEST_CASE("materials reach the parts of a mesh by face index") {
  World w;
  PolygonMesh mesh = cube();
  mesh.polygon_materials = {0, 1, 0, 1, 0, 5};
  const NodeId red = w.build.add_material("red", {.base_color = {1, 0, 0}, .roughness = 0.25f, .takes_paint = true});
  const NodeId lamp = w.build.add_material("lamp", {.opacity = 0.5f, .refraction_index = 1.33f, .emission = {9, 8, 7}});
  const NodeId geometry = w.build.add_mesh("", mesh);
  w.build.add_object("", {.geometry = geometry, .materials = {red, lamp}});
  w.build.add_object("", {.geometry = geometry});
  const ResolvedScene scene = resolve(w.store);
  REQUIRE(scene.meshes.size() == 2);
  REQUIRE(scene.meshes[0].parts.size() == 2);  // Index 5 has no material of its own and takes that of 0.
  CHECK(scene.meshes[0].parts[0].index_count == 4 * 6);
  CHECK(scene.meshes[0].parts[1].index_count == 2 * 6);
  const SurfaceMaterial& first = scene.materials[scene.meshes[0].parts[0].material];
  CHECK(first.base_color == glm::vec3(1, 0, 0));
  CHECK(first.roughness == 0.25f);
  CHECK(first.takes_paint);
  CHECK(first.opacity == 1.0f);
  const SurfaceMaterial& second = scene.materials[scene.meshes[0].parts[1].material];
  CHECK(second.base_color.g == doctest::Approx(0.8));
  CHECK(second.opacity == doctest::Approx(0.5));
  CHECK(second.refraction_index == doctest::Approx(1.33));
  CHECK(second.emission == glm::vec3(9, 8, 7));
  CHECK(scene.meshes[1].parts.size() == 1);
  CHECK(scene.meshes[1].parts[0].material == 0);
}

TEST_CASE("a bitmap becomes the image of the material that shows it") {
  World w;
  std::vector<std::uint8_t> rgba;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 17; ++x)
      for (const int value : {x, y, x * y, x == 3 ? 0 : 255}) rgba.push_back(static_cast<std::uint8_t>(value));
  const NodeId bitmap = w.build.add_bitmap("tiles", 17, 9, rgba, false);
  const NodeId material = w.build.add_material("", {.base_color = {1, 0.5f, 1}, .base_color_bitmap = bitmap});
  w.build.add_object("", {.geometry = w.build.add_mesh("", cube()), .materials = {material}});
  const ResolvedScene scene = resolve(w.store);
  const SurfaceMaterial& shown = scene.materials[scene.meshes[0].parts[0].material];
  REQUIRE(shown.base_color_image == 0);
  CHECK(shown.base_color == glm::vec3(1, 0.5f, 1));
  CHECK(scene.images[0].rgba == rgba);
  CHECK(scene.images[0].width == 17);
  CHECK_FALSE(scene.images[0].srgb);
}

TEST_CASE("a material's images of emission, properties and normals are those of its bitmaps, and it may have none") {
  World w;
  const std::vector<std::uint8_t> grey(4, 128);
  BySurfaceMap<NodeId> maps{{no_node, no_node, no_node}};
  for (NodeId& map : maps.values) map = w.build.add_bitmap("", 1, 1, grey, false);
  const NodeId with = w.build.add_material("", {.maps = maps}), without = w.build.add_material("", {});
  for (const NodeId material : {with, without})
    w.build.add_object("", {.geometry = w.build.add_mesh("", cube()), .materials = {material}});
  const ResolvedScene scene = resolve(w.store);
  const auto shown = [&](std::size_t mesh) { return scene.materials[scene.meshes[mesh].parts[0].material].maps; };
  CHECK(scene.images.size() == 3);
  CHECK(shown(0) == SurfaceMapImages{{0, 1, 2}});
  CHECK(shown(1) == no_surface_maps);
}

TEST_CASE("an image is read as its bitmap says: each edge for itself, and sharp or not") {
  World w;
  const std::vector<std::uint8_t> grey(4, 128);
  std::vector<ImageSampling> ways{{}, {.clamps_u = true}, {.clamps_v = true}, {.sharp = true}};
  for (const ImageSampling& way : ways) {
    const NodeId bitmap = w.build.add_bitmap("", 1, 1, grey, true, way);
    w.build.add_object("", {.geometry = w.build.add_mesh("", cube()),
                            .materials = {w.build.add_material("", {.base_color_bitmap = bitmap})}});
  }
  const ResolvedScene scene = resolve(w.store);
  REQUIRE(scene.images.size() == ways.size());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    CHECK(scene.images[i].sampling == ways[i]);
    CHECK(scene.images[i].srgb);
  }
}

TEST_CASE("children are placed by their parents and prototypes are kept apart") {
  World w;
  const NodeId mesh = w.build.add_mesh("", cube());
  const Quat quarter = orientation_from_angles(1.5707963267948966, 0.0, 0.0);
  const NodeId parent =
      w.build.add_object("", {.parent_from_object = {{100, 0, 0}, quarter}, .scale = glm::vec3(2.0f)});
  const NodeId child = w.build.add_object("", {.parent_from_object = {{10, 0, 1}, {1, 0, 0, 0}},
                                               .geometry = mesh,
                                               .visible_from_m = 5.0f,
                                               .visible_to_m = 80.0f,
                                               .casts_shadow = false});
  w.build.add_child(parent, child);
  const NodeId car = w.build.add_prototype("saloon");
  w.build.add_child(car, w.build.add_object("", {.geometry = mesh, .role = PartRole::wheel_rear_left}));
  const ResolvedScene scene = resolve(w.store);
  REQUIRE(scene.instances.size() == 1);
  const Instance& placed = scene.instances[0];
  CHECK(glm::distance(placed.world_from_object.position_m, Vec3(100, 20, 2)) < 1e-9);
  CHECK(heading_rad(placed.world_from_object.orientation) == doctest::Approx(1.5707963267948966));
  CHECK(placed.scale == glm::vec3(2.0f));
  CHECK(placed.visible_from_m == 5.0f);
  CHECK(placed.visible_to_m == 80.0f);
  CHECK_FALSE(placed.casts_shadow);
  REQUIRE(scene.prototypes.size() == 1);
  CHECK(scene.prototypes[0].name == "saloon");
  REQUIRE(scene.prototypes[0].parts.size() == 1);
  CHECK(scene.prototypes[0].parts[0].role == PartRole::wheel_rear_left);
}

TEST_CASE("only what changed is made again") {
  World w;
  const NodeId moved_mesh = w.build.add_mesh("", cube()), still_mesh = w.build.add_mesh("", cube());
  const NodeId material = w.build.add_material("", {});
  const NodeId object = w.build.add_object("", {.geometry = moved_mesh, .materials = {material}});
  w.build.add_object("", {.geometry = still_mesh, .materials = {material}});
  Resolver resolver;
  CHECK(resolver.update(w.store));
  CHECK_FALSE(resolver.update(w.store));
  const auto& scene = resolver.scene();
  const auto revisions = [&] {
    return std::array{scene.meshes[0].revision, scene.meshes[1].revision, scene.materials[1].revision};
  };
  const auto start = revisions();

  w.build.apply(TransformSet{object, {{5, 0, 0}}});
  CHECK(resolver.update(w.store));
  CHECK(revisions() == start);
  CHECK(scene.instances[0].world_from_object.position_m.x == 5.0);

  w.build.apply(VerticesSet{moved_mesh, 0, {{-3, -1, -1}}});
  CHECK(resolver.update(w.store));
  CHECK(scene.meshes[0].revision > start[0]);
  CHECK(scene.meshes[0].bounds_min_m.x == -3.0f);
  CHECK(scene.meshes[1].revision == start[1]);

  w.build.apply(FragmentSet{material, 0, ColorFragment{{0, 0, 1}}});
  const auto meshes = std::array{scene.meshes[0].revision, scene.meshes[1].revision};
  CHECK(resolver.update(w.store));
  CHECK(scene.materials[1].base_color == glm::vec3(0, 0, 1));
  CHECK(scene.materials[1].revision > start[2]);
  CHECK(meshes == std::array{scene.meshes[0].revision, scene.meshes[1].revision});
}

TEST_CASE("slots that fall free are emptied and used again") {
  World w;
  const NodeId a = w.build.add_object("", {.geometry = w.build.add_mesh("", cube())});
  w.build.add_object("", {.geometry = w.build.add_mesh("", cube())});
  Resolver resolver;
  resolver.update(w.store);
  const std::uint64_t revision = resolver.scene().revision;
  w.build.apply(NodeDestroy{a});
  resolver.update(w.store);
  CHECK(resolver.scene().meshes[0].vertices.empty());
  CHECK(resolver.scene().meshes[0].revision > revision);
  CHECK(resolver.scene().meshes[1].vertices.size() == 8);
  CHECK(resolver.scene().instances[0].mesh == no_mesh);
  CHECK(resolver.scene().instances[1].mesh == 1);
  w.build.add_object("", {.geometry = w.build.add_mesh("", cube())});
  resolver.update(w.store);
  CHECK(resolver.scene().instances.size() == 2);
  CHECK(resolver.scene().instances[0].mesh == 0);
  CHECK(resolver.scene().meshes.size() == 2);
  CHECK(resolver.scene().meshes[0].vertices.size() == 8);
}

TEST_CASE("a budget spreads meshes over updates until none is pending") {
  World w;
  for (int i = 0; i < 5; ++i) w.build.add_object("", {.geometry = w.build.add_mesh("", cube())});
  Resolver resolver;
  resolver.update(w.store, 2);
  CHECK(resolver.pending() == 3);
  resolver.update(w.store, 2);
  CHECK(resolver.pending() == 1);
  CHECK(resolver.update(w.store, 2));
  CHECK(resolver.pending() == 0);
  CHECK_FALSE(resolver.update(w.store, 2));
  for (const auto& mesh : resolver.scene().meshes) CHECK(mesh.vertices.size() == 8);
}

TEST_CASE("a resolver that followed every change shows what a new one shows") {
  World w;
  Resolver resolver;
  Random random(4);
  std::vector<NodeId> objects;
  for (int step = 0; step < 200; ++step) {
    const auto choice = random.below(5);
    if (choice == 0 || objects.size() < 3) {
      PolygonMesh mesh = cube();
      mesh.default_edge_crease = random.below(2) ? geometry::crease_sharp : 0;
      const NodeId material = w.build.add_material("", {.base_color = glm::vec3(static_cast<float>(random.uniform()))});
      objects.push_back(w.build.add_object("", {.geometry = w.build.add_mesh("", mesh), .materials = {material}}));
    } else if (choice == 1) {
      const auto i = static_cast<std::ptrdiff_t>(random.below(objects.size()));
      w.build.apply(NodeDestroy{objects[static_cast<std::size_t>(i)]});
      objects.erase(objects.begin() + i);
    } else if (choice == 2) {
      w.build.apply(TransformSet{objects[random.below(objects.size())], {{random.uniform(), 0, 0}}});
    } else if (choice == 3) {
      w.build.apply(HideSet{objects[random.below(objects.size())], random.below(2) == 0});
    } else {
      w.build.add_child(objects[random.below(objects.size())], objects[random.below(objects.size())]);
    }
    if (random.below(3) == 0) resolver.update(w.store);
  }
  resolver.update(w.store);
  const ResolvedScene& followed = resolver.scene();
  const ResolvedScene fresh = resolve(w.store);
  // Their order differs: what follows keeps the indices that it has told.
  using Seen = std::tuple<double, std::vector<std::uint32_t>, std::vector<float>>;
  const auto seen = [](const ResolvedScene& scene) {
    std::vector<Seen> all;
    for (const Instance& instance : scene.instances) {
      if (instance.mesh == no_mesh) continue;
      const SurfaceMesh& mesh = scene.meshes[instance.mesh];
      std::vector<float> reds;
      for (const MeshPart& part : mesh.parts) reds.push_back(scene.materials[part.material].base_color.r);
      all.emplace_back(instance.world_from_object.position_m.x, mesh.indices, reds);
    }
    std::ranges::sort(all);
    return all;
  };
  CHECK(seen(fresh).size() > 3);
  CHECK(seen(followed) == seen(fresh));
}

TEST_CASE("a resolver turned to another store shows that one with higher revisions") {
  World first, second;
  first.build.add_object("", {.geometry = first.build.add_mesh("", cube())});
  PolygonMesh large = cube();
  for (auto& v : large.vertices_m) v *= 2.0f;
  second.build.add_object("", {.geometry = second.build.add_mesh("", large)});
  Resolver resolver;
  resolver.update(first.store);
  const std::uint64_t revision = resolver.scene().meshes[0].revision;
  resolver.forget();
  CHECK(resolver.update(second.store));
  CHECK(resolver.scene().meshes[0].revision > revision);
  CHECK(resolver.scene().meshes[0].bounds_max_m.x == 2.0f);
}

TEST_CASE("loops of children and of fragments and children without end are cut") {
  World w;
  const NodeId mesh = w.build.add_mesh("", cube());
  const NodeId a = w.build.add_object("", {.geometry = mesh}), b = w.build.add_object("", {.geometry = mesh});
  const NodeId root = w.build.add_object("", {});
  w.build.add_child(root, a), w.build.add_child(a, b), w.build.add_child(b, a);
  NodeId top = w.build.add_object("", {.geometry = mesh});
  for (int i = 0; i < 30; ++i) {
    const NodeId above = w.build.add_object("", {});
    w.build.add_child(above, top), w.build.add_child(above, top);
    top = above;
  }
  const NodeId material = w.build.add_material("", {});
  w.build.apply(FragmentSet{material, 0, BlenderFragment{BlendKind::add, 0, 0, 0}});
  w.build.add_object("", {.geometry = mesh, .materials = {material}});
  const ResolvedScene scene = resolve(w.store);
  CHECK(scene.instances.size() >= 2);
  CHECK(scene.instances.size() <= 1u << 20);
}

TEST_CASE("random content is resolved without harm") {
  Random random(3);
  const auto commands = sample_commands();
  Store store;
  Resolver resolver;
  for (int i = 0; i < 3000; ++i) {
    Command command = commands[random.below(commands.size())];
    if (auto* polygons = std::get_if<PolygonsSet>(&command))
      for (auto& corners : polygons->polygons)
        for (auto& corner : corners) corner = static_cast<std::uint32_t>(random.below(7));
    if (auto* link = std::get_if<LinkSet>(&command)) link->value.target = static_cast<NodeId>(random.below(6));
    (void)store.apply(command);
    if (random.below(4) == 0 && store.find(2)) {
      (void)store.apply(TagGroupSet{2, 0, "draw"});
      (void)store.apply(TagSet{2, 0, 0, {"subdivision_level", static_cast<std::uint32_t>(random.below(4))}});
    }
    resolver.update(store);
    for (const auto& mesh : resolver.scene().meshes) {
      for (const auto index : mesh.indices) REQUIRE(index < mesh.vertices.size());
      for (const auto& part : mesh.parts) REQUIRE(part.material < resolver.scene().materials.size());
    }
    for (const auto& instance : resolver.scene().instances)
      REQUIRE((instance.mesh < resolver.scene().meshes.size() || instance.mesh == no_mesh));
  }
}

TEST_CASE("the material of face index 0 is worn by what has none in whatever order they were linked") {
  World w;
  PolygonMesh mesh = cube();
  mesh.polygon_materials = {0, 1, 0, 1, 0, 5};
  const NodeId red = w.build.add_material("red", {.base_color = {1, 0, 0}});
  const NodeId blue = w.build.add_material("blue", {.base_color = {0, 0, 1}});
  const NodeId object = w.build.add_object("", {.geometry = w.build.add_mesh("", mesh)});
  REQUIRE(w.store.apply(LinkSet{object, 10, {"material", blue, 1}}));
  REQUIRE(w.store.apply(LinkSet{object, 11, {"material", red, 0}}));
  const ResolvedScene scene = resolve(w.store);
  REQUIRE(scene.meshes.size() == 1);
  std::uint32_t red_indices = 0;
  for (const auto& part : scene.meshes[0].parts)
    if (scene.materials[part.material].base_color == glm::vec3(1, 0, 0)) red_indices += part.index_count;
  CHECK(red_indices == 4 * 6);
}

TEST_CASE("a participant whose root is hidden is told so, and shown again, without anything else being placed anew") {
  Store store;
  SceneBuilder build(store);
  const NodeId root = build.add_prototype("participant/5");
  Resolver resolver;
  for (const bool hidden : {false, true, false}) {
    build.apply(HideSet{root, hidden});
    resolver.update(store);
    REQUIRE(resolver.scene().prototypes.size() == 1);
    CHECK(resolver.scene().prototypes[0].is_hidden == hidden);
  }
}
