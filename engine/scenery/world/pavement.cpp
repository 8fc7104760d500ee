#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/scenery/world/far_road.hpp"
#include "engine/scenery/world/lane_surfaces.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr double texture_length_m = 7.5, texture_width_m = 3.75;
constexpr double near_step_m = 10.0;
constexpr double mark_lift_m = 0.010, repair_lift_m = 0.006, repair_edge_lift_m = 0.003, far_mark_lift_m = 0.04;

/// Points between a tile's stations, on the chords of which the pavement is made, so that paint stays above it.
class TileSurface {
 public:
  TileSurface(const RoadShape& roads, const RoadTile& tile, std::vector<double> along)
      : roads_(roads), tile_(tile), stations_(std::move(along)) {}

  const std::vector<double>& at() const { return stations_; }
  glm::vec3 point(double s_m, double t_m, double up_m) const {
    const auto next = std::upper_bound(stations_.begin() + 1, stations_.end() - 1, s_m);
    const double s0 = *(next - 1), s1 = *next;
    return glm::mix(roads_.local(tile_, s0, t_m, up_m), roads_.local(tile_, s1, t_m, up_m),
                    static_cast<float>((s_m - s0) / (s1 - s0)));
  }

 private:
  const RoadShape& roads_;
  const RoadTile& tile_;
  std::vector<double> stations_;
};

/// Texture coordinates of a stripe: across it as far as the asphalt's texture reaches, or from one edge to the other.
enum class StripeUv { none, texture, edges };

/// Draws a stripe `width_m` wide around t(s) from s0 to s1, broken at the pavement's stations.
template <class T>
void draw_stripe(MeshBuilder& builder, const TileSurface& surface, double s0, double s1, double width_m, double lift_m,
                 const T& t_of, StripeUv uv) {
  std::vector<double> cuts{s0};
  for (const double s : surface.at())
    if (s > s0 + 0.05 && s < s1 - 0.05) cuts.push_back(s);
  cuts.push_back(s1);
  std::uint32_t left = 0, right = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double t = t_of(cuts[i]);
    const std::uint32_t new_left = builder.vertex(surface.point(cuts[i], t + width_m / 2, lift_m));
    const std::uint32_t new_right = builder.vertex(surface.point(cuts[i], t - width_m / 2, lift_m));
    if (i > 0) {
      const auto u = uv == StripeUv::edges ? 1.0f : static_cast<float>(width_m / texture_width_m),
                 v0 = static_cast<float>((cuts[i - 1] - s0) / texture_length_m),
                 v1 = static_cast<float>((cuts[i] - s0) / texture_length_m);
      builder.quad(
          left, right, new_right, new_left,
          uv == StripeUv::none ? geometry::CornerUvs{} : geometry::CornerUvs{{{0, v0}, {u, v0}, {u, v1}, {0, v1}}});
    }
    left = new_left;
    right = new_right;
  }
}

Ground mark_of(const RoadTile& tile, bool broken, bool near) {
  if (near) return tile.in_tunnel ? Ground::mark_tunnel : Ground::mark;
  return broken ? Ground::far_mark_broken : Ground::far_mark;
}

/// Draws all lines of a tile; far ones are three times as wide and darker, and broken ones become continuous in their
/// mean grey, which avoids flicker.
void draw_marks(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, bool near, double step_m) {
  const double widening = near ? 1.0 : 3.0;
  const road::Road& road = world.roads.road(tile.road);
  const road::LaneSection& section = road::section_at(road, tile.middle_m());
  const TileSurface surface(world.roads, tile,
                            near ? roadside::close_stations(world.roads, tile, step_m) : stations(tile, step_m));
  for (const road::Lane& lane : section.lanes) {
    const auto border = [&](double s) { return road::outer_border_t_m(road, section, lane.id, s); };
    for (const road::RoadMark& mark : lane.marks)
      for (const road::RoadMarkLine& line : mark.lines) {
        const double begin = std::max(tile.s0_m, mark.s_m > 1e-6 ? mark.s_m : tile.s0_m);
        const double end = std::min(tile.s1_m, mark.s_end_m < road.length_m - 1e-6 ? mark.s_end_m : tile.s1_m);
        if (end - begin < 0.05 || line.width_m <= 0.0) continue;
        const auto t_of = [&](double s) { return border(s) + line.t_offset_m; };
        const bool broken = line.space_m > 0.0;
        if (broken && step_m > 60.0) continue;  // Indistinguishable from the asphalt at this distance.
        builder.material = index_of(mark_of(tile, broken, near));
        if (!broken || !near) {
          draw_stripe(builder, surface, begin, end, line.width_m * widening, near ? mark_lift_m : far_mark_lift_m, t_of,
                      near ? StripeUv::edges : StripeUv::none);
          continue;
        }
        const double period = line.length_m + line.space_m;
        const double origin = mark.s_m + line.s_offset_m;
        for (double s = origin + std::floor((begin - origin) / period) * period; s < end; s += period) {
          const double s0 = std::max(s, begin), s1 = std::min(s + line.length_m, end);
          if (s1 - s0 > 0.05) draw_stripe(builder, surface, s0, s1, line.width_m, mark_lift_m, t_of, StripeUv::edges);
        }
      }
  }
}

/// Repaired rectangles and sealed cracks.
geometry::PolygonMesh repairs(const WorldContext& world, const RoadTile& tile, Random& random) {
  const road::Road& road = world.roads.road(tile.road);
  const road::LaneSection& section = road::section_at(road, tile.middle_m());
  const TileSurface surface(world.roads, tile, roadside::close_stations(world.roads, tile, near_step_m));
  MeshBuilder builder;
  std::vector<int> lanes;
  for (const road::Lane& lane : section.lanes)
    if (road::is_drivable(lane.type)) lanes.push_back(lane.id);
  if (lanes.empty() || tile.on_bridge || tile.in_tunnel || road.junction != road::no_index) return {};
  const auto any_lane = [&] { return lanes[static_cast<std::size_t>(random.below(lanes.size()))]; };
  const double length = tile.s1_m - tile.s0_m;
  if (random.uniform() < 0.55 && length > 40.0) {
    const int lane = any_lane();
    const double s0 = tile.s0_m + random.uniform(2.0, length - 25.0), s1 = s0 + random.uniform(4.0, 22.0);
    const road::LaneBorders borders = road::lane_borders(road, section, lane, s0);
    const double width = borders.width_m() * random.uniform(0.45, 0.92),
                 shift = random.uniform(-0.5, 0.5) * (borders.width_m() - width - 0.3);
    const auto middle_t = [&](double s) { return road::lane_borders(road, section, lane, s).centre_t_m() + shift; };
    // Edge rolled out thin: half way to the old asphalt's tone.
    constexpr double edge_m = 0.18;
    builder.material = index_of(Ground::repair_edge);
    draw_stripe(builder, surface, s0 - edge_m, s1 + edge_m, width + 2 * edge_m, repair_edge_lift_m, middle_t,
                StripeUv::texture);
    builder.material = index_of(Ground::repair);
    draw_stripe(builder, surface, s0, s1, width, repair_lift_m, middle_t, StripeUv::texture);
  }
  builder.material = index_of(Ground::crack);
  for (int crack = 0; crack < 2; ++crack) {
    const int lane = any_lane();
    double s = tile.s0_m + random.uniform(0.0, length * 0.6), t = random.uniform(-1.4, 1.4);
    const double end = std::min(tile.s1_m - 1.0, s + random.uniform(8.0, 40.0));
    while (s < end) {
      const double next_s = s + random.uniform(0.8, 2.5),
                   next_t = std::clamp(t + random.uniform(-0.14, 0.14), -1.6, 1.6);
      const double stop = std::min(next_s, tile.s1_m);
      draw_stripe(
          builder, surface, s, stop, 0.05, repair_lift_m,
          [&](double at) {
            return road::lane_borders(road, section, lane, at).centre_t_m() +
                   std::lerp(t, next_t, (at - s) / (stop - s));
          },
          StripeUv::texture);
      s = stop;
      t = next_t;
    }
  }
  return builder.take();
}

}  // namespace

void draw_far_marks(MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m) {
  draw_marks(builder, world, tile, false, step_m);
}

void build_pavement(const WorldContext& world) {
  Random random(world.seed, 1);
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    MeshBuilder marks;
    draw_marks(marks, world, tile, true, near_step_m);
    add_tile_mesh(world, tile, "pavement", lane_surfaces(world, tile), 0.0f, road_near_m);
    add_tile_mesh(world, tile, "marks", marks.mesh(), 0.0f, road_near_m);
    add_tile_mesh(world, tile, "repairs", repairs(world, tile, random), 0.0f, 200.0f);
  }
}

}  // namespace septet::scenery
