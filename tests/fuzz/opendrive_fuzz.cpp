// The OpenDRIVE reader on any bytes; an accepted road is evaluated, located and driven along.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/road/lane_links.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_locate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace septet;
  using namespace septet::road;
  const auto network = read_opendrive({reinterpret_cast<const char*>(data), size}, "fuzz.xodr");
  if (!network) return 0;
  check_opendrive({reinterpret_cast<const char*>(data), size}, "fuzz.xodr");
  for (RoadIndex road = 0; road < network->roads.size(); ++road) {
    const double middle = 0.5 * network->roads[road].length_m;
    const RoadPosition start{road, 0.0, 0.0};
    const RoadPoint point = evaluate(*network, {road, middle, 1.0});
    locate(*network, Vec2(point.position_m));
    surface_at(*network, Vec2(point.position_m), &start);
    advance(*network, {road, -1, middle, 0.0}, 100.0);
  }
  return 0;
}
