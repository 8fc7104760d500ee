#include "engine/scenery/world/road_world.hpp"
#include "engine/roadside/lane_levels.hpp"

#include <algorithm>
#include <optional>

#include "engine/roadside/lane_levels.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

namespace {

/// True if anything of junctions or towns is drawn.
bool has_towns(const road::RoadNetwork& network) {
  return std::ranges::any_of(network.roads, [](const road::Road& road) {
    return road.junction != road::no_index || std::ranges::any_of(road.sections, [](const road::LaneSection& section) {
             return std::ranges::any_of(section.lanes,
                                        [](const road::Lane& lane) { return roadside::is_walked(lane.type); });
           });
  });
}

}  // namespace

void build_road_world(scene::SceneBuilder& builder, const road::RoadNetwork& network, std::uint64_t seed,
                      const RoadWorldOptions& options) {
  const RoadShape roads(network, options.overrun_m);
  const Terrain terrain(roads, seed);
  const Palette palette = add_world_finishes(builder, seed, has_towns(network));
  OwnShapes own(builder, options.own);
  std::optional<roadside::RaisedAreas> own_raised;
  const roadside::RaisedAreas& raised = options.raised ? *options.raised : own_raised.emplace(network);
  const WorldContext world{builder, roads, terrain, raised, palette, own, seed};
  build_pavement(world);
  build_verges(world);
  build_far_road(world);
  build_land(world);
  build_barriers(world);
  build_kerbs(world);
  build_bridges(world);
  build_tunnels(world);
  build_gantries(world);
  build_signals(world);
  build_road_paint(world);
  if (options.vegetation) build_trees(world);
  if (!options.buildings) return;
  build_buildings(world);
  build_streets(world);
  build_furniture(world);
  build_objects(world);
}

}  // namespace septet::scenery
