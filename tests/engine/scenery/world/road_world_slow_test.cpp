#include "engine/scenery/world/road_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/hash.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

using road::motorway;
using roadside::RoadShape;
using roadside::Terrain;

struct Encoded {
  std::size_t bytes = 0;
  std::uint64_t hash = 0;
};

Encoded encoded(const scene::Store& store) {
  Encoded result;
  StateHash hash;
  scene::describe_store(store, [&](const scene::Command& command) {
    Bytes bytes;
    scene::encode(command, bytes);
    hash.add_bytes(bytes);
    result.bytes += bytes.size();
  });
  result.hash = hash.value();
  return result;
}

/// Object of the world, with the distances between which it is drawn.
struct Drawn {
  const scene::Node* node;
  Vec3 position_m;
  double from_m, to_m;
};

double distance_tag(const scene::Node& node, const char* name, double otherwise) {
  const scene::TagValue* value = scene::find_tag(node, "draw", name);
  const double* number = value ? std::get_if<double>(value) : nullptr;
  return number ? *number : otherwise;
}

std::vector<Drawn> drawn(const scene::Store& store, std::string_view name) {
  std::vector<Drawn> found;
  for (const auto& [id, node] : store.nodes())
    if (const auto* object = std::get_if<scene::ObjectData>(&node.data); object && node.name == name)
      found.push_back(
          {&node, object->transform.position_m, distance_tag(node, "from_m", 0.0), distance_tag(node, "to_m", 1e9)});
  return found;
}

/// Corners of its mesh's polygons in the world, three by three and, of a quad, twice.
std::vector<std::array<Vec3, 3>> triangles(const scene::Store& store, const Drawn& object) {
  std::vector<std::array<Vec3, 3>> found;
  const auto& data = std::get<scene::ObjectData>(object.node->data);
  const RigidTransform world_from_object{data.transform.position_m, glm::normalize(data.transform.rotation)};
  for (const auto& [id, link] : data.links) {
    const scene::Node* node = link.label == "geometry" ? store.find(link.target) : nullptr;
    if (!node) continue;
    const auto& geometry = std::get<scene::GeometryData>(node->data);
    const auto at = [&](std::uint32_t v) { return world_from_object * Vec3(geometry.vertices_m[v]); };
    for (const auto& corners : geometry.polygons)
      for (std::uint32_t k = 1; k + 1 < geometry::corner_count(corners); ++k)
        found.push_back({at(corners[0]), at(corners[k]), at(corners[k + 1])});
  }
  return found;
}

const scene::Store& motorway_store() {
  static const scene::Store store = [] {
    scene::Store made;
    scene::SceneBuilder builder(made);
    build_road_world(builder, motorway(), 3);
    return made;
  }();
  return store;
}

}  // namespace

TEST_CASE("the same seed gives the same world byte for byte and it fits on the wire") {
  const auto world = [](std::uint64_t seed) {
    scene::Store store;
    scene::SceneBuilder builder(store);
    build_road_world(builder, motorway(), seed);
    return encoded(store);
  };
  const Encoded first = world(3), again = world(3), other = world(4);
  CHECK(first.hash == again.hash);
  CHECK(first.hash != other.hash);
  MESSAGE("the motorway's world takes " << first.bytes << " bytes");
  CHECK(first.bytes < 11'500'000);
}

TEST_CASE("the land between roads that are far apart is not walked") {
  const std::string xml = road::replaced(
      road::SmallRoad{}.xml(), "</OpenDRIVE>",
      road::replaced(road::replaced(road::SmallRoad{}.xml(), "id=\"a\"", "id=\"b\""), "x=\"0\"", "x=\"9e7\"")
          .substr(std::string("<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"8\"></header>\n").size()));
  scene::Store store;
  scene::SceneBuilder builder(store);
  RoadWorldOptions options{.vegetation = false, .buildings = false, .overrun_m = 0.0};
  const road::RoadNetwork network = road::read_or_fail(xml);
  REQUIRE(check_world_size(network, options).has_value());
  build_road_world(builder, network, 3, options);
  CHECK(scene::resolve(store).meshes.size() > 0);
}

TEST_CASE("kerbs are drawn from the areas that wheels climb, where they are worked out already") {
  const road::RoadNetwork network = road::read_or_fail(road::replaced(
      road::SmallRoad{}.xml(), "</lanes>",
      "</lanes><objects><object id=\"1\" type=\"trafficIsland\" s=\"50\" t=\"0\" length=\"4\" width=\"1\" "
      "height=\"0.15\"/></objects>"));
  const roadside::RaisedAreas with_island(network), without(motorway());
  REQUIRE(with_island.of_objects().size() == 1);
  REQUIRE(without.of_objects().empty());
  const auto world_from = [&](const roadside::RaisedAreas* raised) {
    scene::Store store;
    scene::SceneBuilder builder(store);
    build_road_world(builder, network, 3, {.vegetation = false, .buildings = false, .raised = raised});
    return encoded(store).hash;
  };
  CHECK(world_from(&with_island) == world_from(nullptr));
  CHECK(world_from(&without) != world_from(nullptr));
}

TEST_CASE("everything of the world is finite and has a material") {
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, motorway(), 3);
  const scene::ResolvedScene scene = scene::resolve(store);
  std::size_t bad = 0;
  for (const scene::SurfaceMesh& mesh : scene.meshes) {
    for (const scene::SurfaceVertex& v : mesh.vertices)
      if (!std::isfinite(v.position_m.x + v.position_m.y + v.position_m.z + v.normal.x + v.uv.x + v.uv.y)) ++bad;
    for (const scene::MeshPart& part : mesh.parts)
      if (part.material >= scene.materials.size()) ++bad;
  }
  CHECK(bad == 0);
  CHECK(scene.instances.size() > 3000);
}

TEST_CASE("the land lies below the road beside it and above a tunnel and below a bridge") {
  const RoadShape roads(motorway(), 500.0);
  const Terrain terrain(roads, 3);
  int above = 0;
  for (double s = 20.0; s < 6200.0; s += 20.0)
    for (const double t : {-20.0, -10.0, 0.0, 10.0, 20.0}) {
      const Vec3 p = roads.point(0, s, t);
      const bool tunnel = roads.structure_at(0, s, road::RoadStructure::Kind::tunnel) != nullptr;
      const double over = terrain.height_m(Vec2(p)) - p.z;
      if (tunnel)
        CHECK(over > 7.0);
      else if (over > -0.3)
        ++above;
    }
  CHECK(above == 0);
  const Vec3 bridge = roads.point(0, 1230.0, 0.0);
  CHECK(terrain.height_m(Vec2(bridge)) < bridge.z - 10.0);
}

TEST_CASE("loose ends of a road run on straight") {
  const RoadShape roads(motorway(), 500.0);
  CHECK(roads.begin_m(0) == -500.0);
  const Vec3 start = roads.point(0, 0.0, 0.0), before = roads.point(0, -100.0, 0.0),
             further = roads.point(0, -200.0, 0.0);
  CHECK(std::hypot(start.x - before.x, start.y - before.y) == doctest::Approx(100.0));
  CHECK((start.x - before.x) == doctest::Approx(before.x - further.x));
}

TEST_CASE("at each distance a tree is drawn once until it is too small to be seen") {
  std::map<std::array<double, 3>, std::vector<std::pair<double, double>>> trees;
  for (const Drawn& tree : drawn(motorway_store(), "tree"))
    trees[{tree.position_m.x, tree.position_m.y, tree.position_m.z}].emplace_back(tree.from_m, tree.to_m);
  REQUIRE(trees.size() > 1000);
  int wrong = 0;
  for (auto& [place, levels] : trees) {
    std::sort(levels.begin(), levels.end());
    double until_m = 0.0;
    for (const auto& level : levels) {
      wrong += level.first != until_m;
      until_m = level.second;
    }
    wrong += until_m < 400.0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("from near to seven kilometres no stretch of the road is without a picture") {
  const auto far = drawn(motorway_store(), "road far");
  REQUIRE(far.size() > 20);
  double longest_from_m = 0.0;
  for (const Drawn& tile : far) longest_from_m = std::max(longest_from_m, tile.from_m);
  int gaps = 0;
  for (double s = 500.0; s < 5500.0; s += 250.0) {
    const road::RoadPoint point = road::evaluate(motorway(), {0, s, 0.0});
    for (double away_m = 480.0; away_m < 6500.0; away_m += 50.0)
      for (const double side : {1.0, -1.0}) {
        const Vec3 eye =
            point.position_m + side * away_m * Vec3(std::cos(point.heading_rad), std::sin(point.heading_rad), 0.0);
        gaps += std::none_of(far.begin(), far.end(), [&](const Drawn& tile) {
          const double half_m = tile.from_m == longest_from_m ? 320.0 : 80.0;
          const double distance_m = glm::distance(tile.position_m, eye);
          return glm::distance(tile.position_m, point.position_m) < half_m + 5.0 && distance_m >= tile.from_m &&
                 distance_m < tile.to_m;
        });
      }
  }
  CHECK(gaps == 0);
}

TEST_CASE("no fifty metres of a bridge are without a pier or an abutment") {
  const RoadShape roads(motorway(), 500.0);
  int bridges = 0;
  for (const road::RoadStructure& bridge : motorway().roads[0].structures) {
    if (bridge.kind != road::RoadStructure::Kind::bridge) continue;
    ++bridges;
    std::vector<double> held_m;
    for (const Drawn& tile : drawn(motorway_store(), "bridge"))
      for (const auto& corners : triangles(motorway_store(), tile))
        for (const Vec3& corner : corners) {
          const auto place = road::locate(motorway(), Vec2(corner));
          if (!place || place->position.road != 0) continue;
          const double s = place->position.s_m;
          if (s < bridge.s_m - 5.0 || s > bridge.s_m + bridge.length_m + 5.0) continue;
          if (corner.z < roads.point(0, s, 0.0).z - 5.0) held_m.push_back(s);
        }
    std::sort(held_m.begin(), held_m.end());
    REQUIRE_FALSE(held_m.empty());
    CHECK(held_m.front() < bridge.s_m + 5.0);
    CHECK(held_m.back() > bridge.s_m + bridge.length_m - 5.0);
    double widest_m = 0.0;
    for (std::size_t i = 1; i < held_m.size(); ++i) widest_m = std::max(widest_m, held_m[i] - held_m[i - 1]);
    CHECK(widest_m < 50.0);
  }
  CHECK(bridges > 0);
}

TEST_CASE("the strip beside the road lies below the pavement of a ramp that runs there") {
  int above = 0, shallow = 0, beside = 0;
  for (const Drawn& tile : drawn(motorway_store(), "verge"))
    for (const auto& corners : triangles(motorway_store(), tile))
      for (const Vec3& corner : corners) {
        const auto place = road::locate(motorway(), Vec2(corner), nullptr, 1.0);
        if (!place || place->lanes.outside_m > 0.0) continue;
        // Only places within the pavement of some road, not at its own road's edge.
        const road::RoadExtent extent = road::road_extent(motorway().roads[place->position.road], place->position.s_m);
        if (std::min(extent.left_t_m - place->position.t_m, place->position.t_m - extent.right_t_m) < 0.7) continue;
        ++beside;
        const double over_m = corner.z - road::evaluate(motorway(), place->position).position_m.z;
        above += over_m > 0.02;
        shallow += over_m > -0.3 && over_m < -0.02;  // Edges of two roads meet at their joint.
      }
  CHECK(beside > 0);
  CHECK(above == 0);
  CHECK(shallow == 0);
}

TEST_CASE("a kerb's faces look outwards and its top up") {
  const road::RoadNetwork network = road::read_or_fail(road::replaced(
      road::SmallRoad{}.xml(), "</lanes>",
      "</lanes><objects><object id=\"1\" type=\"trafficIsland\" s=\"50\" t=\"0\" length=\"4\" width=\"1\" "
      "height=\"0.15\"/></objects>"));
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, network, 3, {.vegetation = false, .buildings = false});
  const auto kerbs = drawn(store, "kerbs");
  REQUIRE(kerbs.size() == 1);
  const Vec3 middle = road::evaluate(network, {0, 50.0, 0.0}).position_m;
  double top_m2 = 0.0;
  for (const auto& [a, b, c] : triangles(store, kerbs[0])) {
    const Vec3 across = 0.5 * glm::cross(b - a, c - a);
    if (std::abs(across.z) > 0.5 * glm::length(across))
      top_m2 += across.z;
    else
      CHECK(glm::dot(across, (a + b + c) / 3.0 - middle) > 0.0);
  }
  CHECK(top_m2 == relative(4.0, 0.02));
}

}  // namespace septet::scenery
