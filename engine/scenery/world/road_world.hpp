#pragma once
/// The world around a road network, generated: pavement and markings, land, structures, signs,
/// trees.
///
/// The same network, seed and options give the same scene. Everything is seen through levels of
/// detail that keep one 44° × 30° view within about 60,000 triangles.

#include <cstdint>

#include "engine/core/expected.hpp"
#include "engine/road/road_network.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/roadside/road_shape.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/own_models.hpp"

namespace septet::scenery {

struct RoadWorldOptions {
  bool vegetation = true;
  bool buildings = true;
  const OwnModels* own =
      nullptr;  ///< Of trees, houses, lamps and posts, drawn in the place of those that are made here.
  double overrun_m = roadside::usual_overrun_m;  ///< How far loose ends of roads run on.
  const roadside::RaisedAreas* raised =
      nullptr;  ///< Of this network, where the caller has them; else they are worked out.
};

/// Whether the world around the roads can be built in reasonable time and memory: as much land,
/// road, paint and structures as a region holds. Error: what there is too much of.
Expected<void> check_world_size(const road::RoadNetwork& network, const RoadWorldOptions& options = {});

/// For a network that check_world_size lets pass.
void build_road_world(scene::SceneBuilder& builder, const road::RoadNetwork& network, std::uint64_t seed,
                      const RoadWorldOptions& options = {});

}  // namespace septet::scenery
