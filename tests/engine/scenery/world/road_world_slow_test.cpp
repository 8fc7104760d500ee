#include "engine/scenery/world/road_world.hpp"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/hash.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/engine/road/road_files.hpp"

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

using Areas = std::map<std::array<float, 3>, double>;  ///< By the materials' colours, m².

/// In every level of detail.
Areas areas(const scene::ResolvedScene& scene) {
  Areas sums;
  for (const scene::SurfaceMesh& mesh : scene.meshes)
    for (const scene::MeshPart& part : mesh.parts)
      for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
        const auto corner = [&](std::uint32_t k) { return mesh.vertices[mesh.indices[i + k]].position_m; };
        const glm::vec3 color = scene.materials[part.material].base_color;
        sums[{color.r, color.g, color.b}] +=
            0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
      }
  return sums;
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
  CHECK(first.bytes < 11'000'000);
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
  REQUIRE(with_island.all().size() == 1);
  REQUIRE(without.all().empty());
  const auto world_from = [&](const roadside::RaisedAreas* raised) {
    scene::Store store;
    scene::SceneBuilder builder(store);
    build_road_world(builder, network, 3, {.vegetation = false, .buildings = false, .raised = raised});
    return encoded(store).hash;
  };
  CHECK(world_from(&with_island) == world_from(nullptr));
  CHECK(world_from(&without) != world_from(nullptr));
}

TEST_CASE("a lane is covered with what its type is of") {
  const auto world_with = [](const std::string& type) {
    const std::string xml =
        road::SmallRoad{.sections = "<laneSection s=\"0\"><center>" + road::lane(0, 0) + "</center><right>" +
                                    road::lane(-1, 3.5) + road::lane(-2, 2.5, "", type) + "</right></laneSection>"}
            .xml();
    scene::Store store;
    scene::SceneBuilder builder(store);
    build_road_world(builder, road::read_or_fail(xml), 3, {.vegetation = false, .buildings = false, .overrun_m = 0.0});
    return areas(scene::resolve(store));
  };
  Areas lane = world_with("driving");
  CHECK(world_with("border") == lane);
  std::set<std::array<float, 3>> covers;
  for (const char* type : {"sidewalk", "none", "rail"}) {
    CAPTURE(type);
    double more = 0.0, less = 0.0;
    for (const auto& [color, area_m2] : world_with(type)) {
      const double added = area_m2 - lane[color];
      (added > 0.0 ? more : less) += added;
      if (added > 1.0) covers.insert(color);
    }
    CHECK(more == doctest::Approx(250.0).epsilon(0.01));
    CHECK(less == doctest::Approx(-250.0).epsilon(0.01));
  }
  CHECK(covers.size() == 3);
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

}  // namespace septet::scenery
