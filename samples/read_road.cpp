/// Reads an OpenDRIVE file: its roads with their lengths and lanes, and there and back between a lane and the world.
///
///     read_road /usr/share/septet/scenarios/motorway-ambulance/motorway.xodr
#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/road/road_position.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  if (argc != 2) {
    fmt::print(stderr, "usage: read_road ROAD.xodr\n");
    return 2;
  }
  const auto network =
      read_regular_file(argv[1]).and_then([&](const std::string& xml) { return road::read_opendrive(xml, argv[1]); });
  if (!network) {
    fmt::print(stderr, "read_road: {}\n", describe(network.error()));
    return 1;
  }
  for (road::RoadIndex index = 0; index < network->roads.size(); ++index) {
    const road::Road& one = network->roads[index];
    fmt::print("road {} \"{}\": {:.1f} m\n", one.id, one.name, one.length_m);
    const double middle_m = one.length_m / 2;
    for (const road::Lane& lane : road::section_at(one, middle_m).lanes) {
      if (!road::is_drivable(lane.type)) continue;
      const road::LanePoint there = road::evaluate_lane(*network, {index, lane.id, middle_m});
      const Vec3& point_m = there.road.position_m;
      const auto back = road::locate(*network, Vec2(point_m));
      if (!back) return 1;  // Not of a point that lies in a lane.
      fmt::print(
          "  lane {:2} {}, {:.2f} m wide; its middle is at x {:.2f} m, y {:.2f} m, z {:.2f} m: road {}, s {:.2f} m, t "
          "{:.2f} m\n",
          lane.id, road::name_of(lane.type), there.lane_width_m, point_m.x, point_m.y, point_m.z,
          network->roads[back->position.road].id, back->position.s_m, back->position.t_m);
    }
  }
  return 0;
}
