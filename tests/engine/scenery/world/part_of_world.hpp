#pragma once
/// One part of a generated world by itself, without its pictures, for tests.

#include <cstdint>
#include <string>

#include "engine/road/road_network.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/store.hpp"
#include "engine/scenery/own_models.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

/// Name of a ground's material in such a part.
inline std::string name_of(Ground ground) { return std::to_string(index_of(ground)); }

/// `build` is one of world_context.hpp. Roads end where they end.
inline scene::Store part_of_world(const road::RoadNetwork& network, void (*build)(const WorldContext&)) {
  constexpr std::uint64_t seed = 1;
  scene::Store store;
  scene::SceneBuilder builder(store);
  Palette palette;
  for (std::uint32_t i = 0; i <= index_of(Ground::palette); ++i)
    palette.push_back(builder.add_material(std::to_string(i), {}));
  const RoadShape roads(network, 0.0);
  const Terrain terrain(roads, seed);
  const roadside::RaisedAreas raised(network);
  OwnShapes own(builder, nullptr);
  build({builder, roads, terrain, raised, palette, own, seed});
  return store;
}

}  // namespace septet::scenery
