#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

double turn(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

/// Fills a polygon by cutting off ears until a triangle is left; one that crosses itself is filled as far as ears are
/// found.
void fill_top(geometry::MeshBuilder& builder, const std::vector<glm::vec3>& top) {
  std::vector<std::size_t> left(top.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const auto is_ear = [&](std::size_t k) {
    const std::size_t n = left.size();
    const glm::vec3 &a = top[left[(k + n - 1) % n]], &b = top[left[k]], &c = top[left[(k + 1) % n]];
    if (turn(a, b, c) < 0.0) return false;
    for (std::size_t m = 0; m + 3 < n; ++m) {
      const glm::vec3& p = top[left[(k + 2 + m) % n]];
      if (turn(a, b, p) > 0.0 && turn(b, c, p) > 0.0 && turn(c, a, p) > 0.0) return false;
    }
    return true;
  };
  std::size_t k = 0;
  while (left.size() >= 3) {
    const std::size_t n = left.size();
    // Starts at the last ear, beside which the next one mostly is.
    std::size_t tried = 0;
    for (k %= n; tried < n && !is_ear(k); ++tried) k = (k + 1) % n;
    if (tried == n) return;
    builder.triangle(builder.vertex(top[left[(k + n - 1) % n]]), builder.vertex(top[left[k]]),
                     builder.vertex(top[left[(k + 1) % n]]));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

/// Draws the pavement of a corner: slabs, towards the junction a stone with its face.
void draw_corner(geometry::MeshBuilder& builder, const WorldContext& world, const RoadTile& tile,
                 const roadside::JunctionCorner& corner) {
  constexpr double stone_m = 0.14, slabs_m = 1.5;
  constexpr float face_m = 0.2f;
  const auto seam = [&](std::size_t i) {
    const double width_m = glm::distance(corner.kerb_m[i], corner.edge_m[i]);
    return width_m > 2.0 * stone_m ? glm::mix(corner.kerb_m[i], corner.edge_m[i], stone_m / width_m)
                                   : 0.5 * (corner.kerb_m[i] + corner.edge_m[i]);
  };
  const auto local = [&](const Vec3& p) { return world.roads.local(tile, p); };
  const auto uv = [&](const Vec3& p) { return glm::vec2((Vec2(p) - Vec2(corner.kerb_m.front())) / slabs_m); };
  const glm::vec3 down(0.0f, 0.0f, -face_m);
  for (std::size_t i = 0; i + 1 < corner.kerb_m.size(); ++i) {
    const Vec3 &a = corner.kerb_m[i], &b = corner.kerb_m[i + 1], &c = corner.edge_m[i + 1], &d = corner.edge_m[i],
               &p = seam(i), &q = seam(i + 1);
    builder.material = index_of(Ground::kerb_stone);
    builder.patch(local(b) + down, local(a) + down, local(a), local(b));
    builder.patch(local(b), local(a), local(p), local(q));
    builder.material = index_of(Ground::paving);
    builder.patch(local(q), local(p), local(d), local(c), {{uv(q), uv(p), uv(d), uv(c)}});
  }
}

bool begins_in(const RoadTile& tile, const WorldContext& world, road::RoadIndex road, double s_m) {
  const double kept_m = std::min(s_m, std::nextafter(world.roads.road(road).length_m, 0.0));
  return road == tile.road && kept_m >= tile.s0_m && kept_m < tile.s1_m;
}

}  // namespace

void build_kerbs(const WorldContext& world) {
  const roadside::RaisedAreas& raised = world.raised;
  if (raised.of_objects().empty() && raised.corners().empty()) return;
  constexpr float foot_m = 0.5f;  // Depth of the face: the road under it may fall away.
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    geometry::MeshBuilder builder;
    for (const roadside::JunctionCorner& corner : raised.corners())
      if (begins_in(tile, world, corner.road, corner.s_m)) draw_corner(builder, world, tile, corner);
    for (const roadside::RaisedArea& area : raised.of_objects()) {
      if (!begins_in(tile, world, area.road, area.s_m)) continue;
      std::vector<glm::vec3> top;
      for (const Vec3& corner : area.top_m) top.push_back(world.roads.local(tile, corner));
      double around = 0.0;
      for (std::size_t i = 0; i < top.size(); ++i) {
        const glm::vec3 &a = top[i], &b = top[(i + 1) % top.size()];
        around += a.x * b.y - a.y * b.x;
      }
      if (around < 0.0) top = {top.rbegin(), top.rend()};
      builder.material = index_of(area.is_grown ? Ground::kerb_stone : Ground::concrete);
      for (std::size_t i = 0; i < top.size(); ++i) {
        const glm::vec3 &a = top[i], &b = top[(i + 1) % top.size()], down(0.0f, 0.0f, -foot_m);
        builder.patch(a + down, b + down, b, a);
      }
      if (area.is_grown) builder.material = index_of(Ground::verge);
      fill_top(builder, top);
    }
    geometry::PolygonMesh mesh = builder.take();
    mesh.default_edge_crease = geometry::crease_sharp;
    add_tile_mesh(world, tile, "kerbs", mesh, 0.0f, road_near_m);
  }
}

}  // namespace septet::scenery
