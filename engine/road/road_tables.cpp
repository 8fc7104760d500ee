#include "engine/road/road_tables.hpp"

#include <array>
#include <cmath>
#include <istream>
#include <numbers>
#include <ostream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/document/table_line.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::road {
namespace {

using document::cells_of, document::number_in, document::trimmed;

tl::unexpected<Error> wrong_line(std::size_t number, std::string what, std::string_view columns) {
  return failure(std::move(what), fmt::format("line {} of the table", number), fmt::format("write {}", columns));
}

constexpr std::string_view sample_columns = "road_id,lane_id,s_m,lane_offset_m", locate_columns = "x_m,y_m";

}  // namespace

Expected<void> sample_table(const RoadNetwork& network, std::istream& in, std::ostream& out) {
  out << sample_columns
      << ",x_m,y_m,z_m,heading_rad,pitch_rad,roll_rad,lane_width_m,curvature_per_m,t_m,drive_"
         "heading_rad\n";
  std::string line;
  for (std::size_t number = 1; out && std::getline(in, line); ++number) {
    const auto fields = cells_of(line);
    if (trimmed(line).empty() || (number == 1 && fields[0] == "road_id")) continue;
    if (fields.size() < 4) return wrong_line(number, "it has fewer than four fields", sample_columns);
    const auto road_index = find_road(network, fields[0]);
    const auto lane = number_in<int>(fields[1]);
    const auto s = number_in<double>(fields[2]), offset = number_in<double>(fields[3]);
    if (!road_index) return wrong_line(number, fmt::format("road {} does not exist", fields[0]), sample_columns);
    if (!lane || !s || !offset) return wrong_line(number, "a field is not a number", sample_columns);
    const Road& road = network.roads[*road_index];
    if (!(*s >= 0.0 && *s <= road.length_m)) {
      return wrong_line(number, fmt::format("s {} is not on the road, which is {} m long", *s, road.length_m),
                        sample_columns);
    }
    const LaneSection& section = section_at(road, *s);
    if (!section.has_lane(*lane))
      return wrong_line(number, fmt::format("there is no lane {} at s {}", *lane, *s), sample_columns);
    const LanePoint point = evaluate_lane(network, {*road_index, *lane, *s, *offset});
    const double turn = runs_along_s(road, section, *lane) ? 0.0 : std::numbers::pi;
    const double drive_heading = wrap_angle(point.road.heading_rad + std::atan(point.lane_slope) + turn);
    out << fmt::format("{},{},{},{},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.5f},{:.8f},{:.5f},{:.7f}\n", fields[0],
                       fields[1], fields[2], fields[3], point.road.position_m.x, point.road.position_m.y,
                       point.road.position_m.z, point.road.heading_rad, point.road.pitch_rad, point.road.roll_rad,
                       point.lane_width_m, point.road.curvature_per_m, point.t_m, drive_heading);
  }
  return {};
}

Expected<void> locate_table(const RoadNetwork& network, std::istream& in, std::ostream& out) {
  out << locate_columns << ",road_id,lane_id,s_m,t_m,lane_offset_m,lane_id_any,residual_m,s_true_m,t_true_m\n";
  std::string line;
  for (std::size_t number = 1; out && std::getline(in, line); ++number) {
    const auto fields = cells_of(line);
    if (trimmed(line).empty() || (number == 1 && fields[0] == "x_m")) continue;
    if (fields.size() < 2) return wrong_line(number, "it has fewer than two fields", locate_columns);
    const auto x = number_in<double>(fields[0]), y = number_in<double>(fields[1]);
    if (!x || !y) return wrong_line(number, "a field is not a number", locate_columns);
    const auto found = locate(network, {*x, *y});
    if (!found) {
      out << fmt::format("{},{},,,,,,,,,\n", fields[0], fields[1]);
      continue;
    }
    const auto& [road, s, t] = found->position;
    const Vec3 again = evaluate(network, found->position).position_m;
    out << fmt::format("{},{},{},{},{:.5f},{:.5f},{:.5f},{},{:.5f},{:.5f},{:.5f}\n", fields[0], fields[1],
                       network.roads[road].id, found->lanes.lane, s, t, found->lanes.offset_m,
                       found->lanes.lane_any_type, glm::distance(Vec2(again), Vec2(*x, *y)), s, t);
  }
  return {};
}

}  // namespace septet::road
