#include "engine/simulation/walkways_of_drive.hpp"

#include "engine/roadside/junction_corners.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::simulation {

traffic::WalkwayGraph walkways_of(const road::RoadNetwork& roads, const roadside::Obstacles& obstacles,
                                  const roadside::RaisedAreas& raised, const std::vector<SwitchedLight>& lights) {
  traffic::WalkwaySurroundings around;
  for (const roadside::JunctionCorner& corner : raised.corners())
    around.corners.push_back({corner.kerb_m, corner.edge_m});
  for (const Obstacle& obstacle : obstacles.listed())
    if (obstacle.from_m == obstacle.to_m) around.posts.push_back({obstacle.from_m, obstacle.radius_m});
  for (const SwitchedLight& light : lights) around.lights.push_back(light.head);
  around.ground_m = [&](const Vec2& p, double road_z_m) { return raised.ground_at(p, road_z_m); };
  return traffic::build_walkways(roads, around);
}

}  // namespace septet::simulation
