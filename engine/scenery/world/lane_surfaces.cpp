#include "engine/scenery/world/lane_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/road/decks.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/lane_levels.hpp"
#include "engine/roadside/town.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr double lane_texture_length_m = 7.5, lane_texture_width_m = 3.75;
constexpr double plain_texture_m = 3.75, paving_texture_m = 1.5, lawn_texture_m = 3.5;
constexpr double surface_step_m = 10.0;
constexpr double least_kerb_m = 0.004, kerb_stone_m = 0.14;

Ground asphalt_of(const RoadTile& tile) {
  if (tile.in_tunnel) return Ground::asphalt_tunnel;
  // Stretches were laid in different years.
  const auto stretch = static_cast<std::int64_t>(std::floor(tile.middle_m() / 900.0)) + tile.road * 3;
  constexpr Ground laid[]{Ground::asphalt, Ground::asphalt_old, Ground::asphalt, Ground::asphalt_fresh};
  return laid[((stretch % 4) + 4) % 4];
}

/// Size of a texture laid over the land as a whole, not along a lane, so that overlapping lanes look the same.
double world_texture_m(Ground ground) {
  switch (ground) {
    case Ground::asphalt_plain:
    case Ground::cycle_path:
      return plain_texture_m;
    case Ground::verge:
      return lawn_texture_m;
    default:
      return 0.0;
  }
}

/// Surface of one tile. Rows are stations; where a height steps there are two of them at one place.
class TileSurfaces {
 public:
  TileSurfaces(const WorldContext& world, const RoadTile& tile)
      : world_(world),
        tile_(tile),
        road_(world.roads.road(tile.road)),
        section_(road::section_at(road_, tile.middle_m())) {
    constexpr double inside_m = 1e-6;
    const std::vector<double> steps = roadside::height_steps(world.roads, tile);
    for (const double s : roadside::close_stations(world.roads, tile, surface_step_m)) {
      const bool is_step = std::ranges::binary_search(steps, s);
      if (is_step) rows_.push_back(s - inside_m);
      rows_.push_back(is_step ? s + inside_m : s);
    }
    anchor_ = glm::floor(Vec2(tile.world_from_tile.position_m) / anchor_m) * anchor_m;
  }

  geometry::PolygonMesh mesh() {
    if (section_.lanes.size() < 2) return {};
    Edge last;
    for (int lane = section_.left_count; lane >= -section_.right_count; --lane) {
      if (lane == 0) continue;
      const road::Lane& own = section_.lane(lane);
      const Ground ground = ground_of(world_, tile_, own);
      const Edge left = edge(lane, true), right = edge(lane, false);
      const bool joined = !last.points.empty() && meet(last, left);
      if (!last.points.empty() && !joined) draw_kerb(last, left);
      const Strip whole = strip(joined ? last : left, right);
      if (ground == Ground::paving)
        draw_paving(whole, lane > 0);
      else
        draw(whole, ground, lane);
      last = whole.right;
    }
    draw_faces_across();
    return builder_.take();
  }

 private:
  struct Edge {
    std::vector<double> t_m;
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> vertices;
  };
  struct Strip {
    Edge left, right;
  };

  /// Border of a lane at the lane's own height: 0.01 mm inside it.
  Edge edge(int lane, bool leftmost) const {
    Edge edge;
    for (const double s : rows_) {
      const road::LaneBorders borders = road::lane_borders(road_, section_, lane, s);
      const double left = std::max(borders.inner_t_m, borders.outer_t_m),
                   right = std::min(borders.inner_t_m, borders.outer_t_m),
                   inside = std::min(1e-5, 0.25 * (left - right));
      edge.t_m.push_back(leftmost ? left : right);
      edge.points.push_back(world_.roads.local(tile_, s, leftmost ? left - inside : right + inside));
    }
    return edge;
  }

  bool meet(const Edge& a, const Edge& b) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (std::abs(a.points[i].z - b.points[i].z) > least_kerb_m) return false;
    return true;
  }

  void add(Edge& edge) {
    if (!edge.vertices.empty()) return;
    for (const glm::vec3& p : edge.points) edge.vertices.push_back(builder_.vertex(p));
  }

  Strip strip(const Edge& left, const Edge& right) {
    Strip strip{left, right};
    add(strip.left);
    add(strip.right);
    return strip;
  }

  /// Draws a kerb stone's face between a higher and a lower edge.
  void draw_kerb(const Edge& left, const Edge& right) {
    builder_.material = index_of(Ground::kerb_stone);
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
      const glm::vec3 &a = left.points[i], &b = left.points[i + 1], &c = right.points[i + 1], &d = right.points[i];
      if (rows_[i + 1] - rows_[i] < 1e-3 || std::max(std::abs(a.z - d.z), std::abs(b.z - c.z)) < 1e-3f) continue;
      if (a.z + b.z > c.z + d.z)
        builder_.patch(d, c, b, a);
      else
        builder_.patch(a, d, c, b);
    }
  }

  /// True where drivable lanes of other roads take the place of lawn or of a junction's pavement, and walked lanes that
  /// of lawn. Lanes on another level take no place.
  bool is_taken(const glm::vec3& place, Ground ground) const {
    const road::RoadNetwork& network = world_.roads.network();
    const Vec3 place_m = tile_.world_from_tile * Vec3(place);
    return std::ranges::any_of(road::roads_holding(network, Vec2(place_m)), [&](const road::Location& location) {
      const road::RoadPosition& at = location.position;
      if (at.road == tile_.road) return false;
      const road::LaneType type = road::lane_type(network, at.road, location.lanes.lane_any_type, at.s_m);
      return (road::is_drivable(type) || (ground == Ground::verge && roadside::is_walked(type))) &&
             std::abs(road::evaluate(network, at).position_m.z - place_m.z) < road::least_rise_m;
    });
  }
  /// True in the middle of the quad, or near a corner.
  bool is_taken(const std::array<glm::vec3, 4>& quad, Ground ground) const {
    constexpr float near_corner = 0.25f;
    const glm::vec3 middle = 0.25f * (quad[0] + quad[1] + quad[2] + quad[3]);
    return is_taken(middle, ground) || std::ranges::any_of(quad, [&](const glm::vec3& corner) {
             return is_taken(glm::mix(corner, middle, near_corner), ground);
           });
  }

  glm::vec2 world_uv(const glm::vec3& local, double texture_m) const {
    return {(Vec2(tile_.world_from_tile * Vec3(local)) - anchor_) / texture_m};
  }

  void draw(const Strip& strip, Ground ground, int lane) {
    builder_.material = index_of(ground);
    const bool may_be_taken =
        ground == Ground::verge || (road_.junction != road::no_index && !road::is_drivable(section_.lane(lane).type));
    const double world_m = world_texture_m(ground);
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
      const double width0 = strip.left.t_m[i] - strip.right.t_m[i],
                   width1 = strip.left.t_m[i + 1] - strip.right.t_m[i + 1];
      if ((width0 < 1e-3 && width1 < 1e-3) || rows_[i + 1] - rows_[i] < 1e-3) continue;
      const glm::vec3 &a = strip.left.points[i], &b = strip.right.points[i], &c = strip.right.points[i + 1],
                      &d = strip.left.points[i + 1];
      if (may_be_taken && is_taken(std::array{a, b, c, d}, ground)) continue;
      const bool worn = std::max(width0, width1) > 3.0;  // The texture shows the wheel tracks of a lane.
      const auto u0 = static_cast<float>(worn ? 1.0 : width0 / lane_texture_width_m),
                 u1 = static_cast<float>(worn ? 1.0 : width1 / lane_texture_width_m);
      const auto v0 = static_cast<float>((rows_[i] - tile_.s0_m) / lane_texture_length_m),
                 v1 = static_cast<float>((rows_[i + 1] - tile_.s0_m) / lane_texture_length_m);
      geometry::CornerUvs uvs{{{0, v0}, {u0, v0}, {u1, v1}, {0, v1}}};
      if (world_m > 0.0) uvs = {world_uv(a, world_m), world_uv(b, world_m), world_uv(c, world_m), world_uv(d, world_m)};
      builder_.quad(strip.left.vertices[i], strip.right.vertices[i], strip.right.vertices[i + 1],
                    strip.left.vertices[i + 1], uvs);
    }
  }

  /// Draws slabs, and towards the road a stone.
  void draw_paving(const Strip& whole, bool left_of_road) {
    Edge seam;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double width = whole.left.t_m[i] - whole.right.t_m[i], stone = std::min(kerb_stone_m, 0.5 * width);
      const double share = width > 1e-3 ? stone / width : 0.5;
      const Edge &inner = left_of_road ? whole.right : whole.left, &outer = left_of_road ? whole.left : whole.right;
      seam.t_m.push_back(std::lerp(inner.t_m[i], outer.t_m[i], share));
      seam.points.push_back(glm::mix(inner.points[i], outer.points[i], static_cast<float>(share)));
    }
    add(seam);
    draw_slabs(left_of_road ? Strip{seam, whole.right} : Strip{whole.left, seam}, Ground::kerb_stone, 0.0);
    draw_slabs(left_of_road ? Strip{whole.left, seam} : Strip{seam, whole.right}, Ground::paving, paving_texture_m);
  }

  void draw_slabs(const Strip& strip, Ground ground, double texture_m) {
    builder_.material = index_of(ground);
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
      const double width0 = strip.left.t_m[i] - strip.right.t_m[i],
                   width1 = strip.left.t_m[i + 1] - strip.right.t_m[i + 1];
      if ((width0 < 1e-3 && width1 < 1e-3) || rows_[i + 1] - rows_[i] < 1e-3) continue;
      const glm::vec3 middle =
          0.25f * (strip.left.points[i] + strip.right.points[i] + strip.left.points[i + 1] + strip.right.points[i + 1]);
      if (road_.junction != road::no_index && is_taken(middle, ground)) continue;
      geometry::CornerUvs uvs{};
      if (texture_m > 0.0) {
        const auto v0 = static_cast<float>((rows_[i] - tile_.s0_m) / texture_m),
                   v1 = static_cast<float>((rows_[i + 1] - tile_.s0_m) / texture_m);
        uvs = {{{0, v0},
                {static_cast<float>(width0 / texture_m), v0},
                {static_cast<float>(width1 / texture_m), v1},
                {0, v1}}};
      }
      builder_.quad(strip.left.vertices[i], strip.right.vertices[i], strip.right.vertices[i + 1],
                    strip.left.vertices[i + 1], uvs);
    }
  }

  /// Draws the faces where a lane's height steps along the road.
  void draw_faces_across() {
    builder_.material = index_of(Ground::kerb_stone);
    for (int lane = section_.left_count; lane >= -section_.right_count; --lane) {
      if (lane == 0 || section_.lane(lane).heights.size() < 2) continue;
      const Edge left = edge(lane, true), right = edge(lane, false);
      for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
        if (rows_[i + 1] - rows_[i] > 1e-3) continue;
        const glm::vec3 &a = left.points[i], &b = right.points[i], &c = right.points[i + 1], &d = left.points[i + 1];
        if (std::max(std::abs(a.z - d.z), std::abs(b.z - c.z)) < 1e-3f) continue;
        // Visible from the lower side.
        if (d.z + c.z > a.z + b.z)
          builder_.patch(a, b, c, d);
        else
          builder_.patch(d, c, b, a);
      }
    }
  }

  /// Whole number of repeats of every texture that is laid over the land.
  static constexpr double anchor_m = 105.0;

  const WorldContext& world_;
  const RoadTile& tile_;
  const road::Road& road_;
  const road::LaneSection& section_;
  std::vector<double> rows_;
  Vec2 anchor_{0.0};
  MeshBuilder builder_;
};

Ground far_ground_of(Ground ground) {
  switch (ground) {
    case Ground::verge:
      return Ground::far_verge;
    case Ground::paving:
    case Ground::kerb_stone:
      return Ground::far_concrete;
    case Ground::asphalt_tunnel:
      return Ground::asphalt_tunnel;
    default:
      return Ground::far_asphalt;
  }
}

}  // namespace

Ground ground_of(const WorldContext& world, const RoadTile& tile, const road::Lane& lane) {
  using enum road::LaneType;
  const bool on_earth = !tile.in_tunnel && !tile.on_bridge;
  const bool in_junction = world.roads.road(tile.road).junction != road::no_index;
  const Ground asphalt = in_junction && !tile.in_tunnel ? Ground::asphalt_plain : asphalt_of(tile);
  switch (lane.type) {
    case none:
      return on_earth ? Ground::verge : asphalt;
    case sidewalk:
      return tile.in_tunnel ? Ground::concrete_tunnel : Ground::paving;
    case curb:
      return tile.in_tunnel ? Ground::concrete_tunnel : Ground::kerb_stone;
    case median:
      // In the country a median is paved like the lanes, before a motorway's barrier.
      return on_earth && roadside::is_in_town(world.roads.network(), tile.road, tile.middle_m()) ? Ground::verge
                                                                                                 : asphalt;
    case rail:
    case tram:
      return on_earth ? Ground::gravel : asphalt;
    case biking:
      return tile.in_tunnel ? asphalt : Ground::cycle_path;
    case parking:
      return tile.in_tunnel || in_junction ? asphalt : Ground::asphalt_old;
    default:
      return asphalt;
  }
}

geometry::PolygonMesh lane_surfaces(const WorldContext& world, const RoadTile& tile) {
  return TileSurfaces(world, tile).mesh();
}

void draw_far_pavement(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double far_step_m) {
  const road::Road& road = world.roads.road(tile.road);
  const road::LaneSection& section = road::section_at(road, tile.middle_m());
  // Runs from left to right, cut where the colour changes.
  struct Run {
    Ground ground;
    int first, last;
  };
  std::vector<Run> runs;
  for (int lane = section.left_count; lane >= -section.right_count; --lane) {
    if (lane == 0) continue;
    const Ground ground = far_ground_of(ground_of(world, tile, section.lane(lane)));
    if (!runs.empty() && runs.back().ground == ground)
      runs.back().last = lane;
    else
      runs.push_back({ground, lane, lane});
  }
  const std::vector<double> along = stations(tile, far_step_m);
  for (const Run& run : runs) {
    builder.material = index_of(run.ground);
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      const road::LaneBorders first = road::lane_borders(road, section, run.first, along[i]),
                              end = road::lane_borders(road, section, run.last, along[i]);
      const double left = run.first > 0 ? first.outer_t_m : first.inner_t_m,
                   right = run.last > 0 ? end.inner_t_m : end.outer_t_m;
      const bool crowned = run.first > 0 && run.last < 0;  // True if the middle of the road lies in it.
      const std::uint32_t row = builder.vertex(world.roads.local(tile, along[i], left));
      if (crowned) builder.vertex(world.roads.local(tile, along[i], std::clamp(0.0, right, left)));
      builder.vertex(world.roads.local(tile, along[i], right));
      if (i > 0)
        for (std::uint32_t k = 0; k < (crowned ? 2u : 1u); ++k)
          builder.quad(last + k, last + k + 1, row + k + 1, row + k);
      last = row;
    }
  }
}

}  // namespace septet::scenery
