#pragma once
/// Generated world around a road network: pavement and markings, land, structures, signs, trees.
///
/// The same network, seed and options give the same scene. Levels of detail keep one 44° × 30° view within about 60,000
/// triangles.

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
  /// Own models of trees, houses, lamps and posts, which replace the generated ones; null: none.
  const OwnModels* own = nullptr;
  double overrun_m = roadside::usual_overrun_m;  ///< Overrun of loose ends of roads.
  /// Raised areas of this network; null: they are computed.
  const roadside::RaisedAreas* raised = nullptr;
};

/// Checks that the world around the roads can be built in reasonable time and memory: as much land, road, paint and
/// structures as a region holds. Error: the quantity that is too large.
Expected<void> check_world_size(const road::RoadNetwork& network, const RoadWorldOptions& options = {});

/// Builds the world of a network that check_world_size accepts.
void build_road_world(scene::SceneBuilder& builder, const road::RoadNetwork& network, std::uint64_t seed,
                      const RoadWorldOptions& options = {});

}  // namespace septet::scenery
