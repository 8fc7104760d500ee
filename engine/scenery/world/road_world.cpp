#include "engine/scenery/world/road_world.hpp"

#include <optional>

#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

void build_road_world(scene::SceneBuilder& builder, const road::RoadNetwork& network, std::uint64_t seed,
                      const RoadWorldOptions& options) {
  const RoadShape roads(network, options.overrun_m);
  const Terrain terrain(roads, seed);
  const Palette palette = add_world_finishes(builder, seed);
  const WorldContext world{builder, roads, terrain, palette, seed};
  std::optional<roadside::RaisedAreas> own_raised;
  build_pavement(world);
  build_verges(world);
  build_far_road(world);
  build_land(world);
  build_barriers(world);
  build_kerbs(world, options.raised ? *options.raised : own_raised.emplace(network));
  build_bridges(world);
  build_tunnels(world);
  build_gantries(world);
  if (options.vegetation) build_trees(world);
  if (options.buildings) build_buildings(world);
}

}  // namespace septet::scenery
