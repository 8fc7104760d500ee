#include "engine/audio/ground_feel.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/road/surface_material.hpp"

namespace septet::audio {
namespace {

constexpr double half_track_m = 0.76, half_tyre_m = 0.10;

/// Beginnings of words, the most specific first.
constexpr std::array<std::pair<std::string_view, double>, 14> surfaces{{{"cobble", class_d_m3},
                                                                        {"sett", class_d_m3},
                                                                        {"paving", class_c_m3},
                                                                        {"brick", class_c_m3},
                                                                        {"gravel", class_d_m3},
                                                                        {"dirt", class_e_m3},
                                                                        {"soil", class_e_m3},
                                                                        {"grass", class_e_m3},
                                                                        {"mud", class_e_m3},
                                                                        {"sand", class_d_m3},
                                                                        {"rail", class_d_m3},
                                                                        {"concrete", class_b_m3},
                                                                        {"snow", class_c_m3},
                                                                        {"ice", class_b_m3}}};

/// True where this lane's mark is paint at the wheel, on its outer border.
bool is_painted(const road::RoadNetwork& roads, const road::RoadPosition& at, int lane, double border_t_m) {
  const road::RoadMark* mark = road::road_mark_at(roads, at.road, lane, at.s_m);
  if (!mark) return false;
  return std::ranges::any_of(mark->lines, [&](const road::RoadMarkLine& line) {
    if (std::abs(at.t_m - border_t_m - line.t_offset_m) > 0.5 * std::max(line.width_m, mark->width_m) + half_tyre_m)
      return false;
    const double along = at.s_m - mark->s_m - line.s_offset_m, period = line.length_m + line.space_m;
    if (along < 0.0 || (line.once && along > line.length_m)) return false;
    return line.space_m <= 0.0 || !(period > 0.0) || std::fmod(along, period) < line.length_m;
  });
}

bool is_on_line(const road::RoadNetwork& roads, const road::RoadPosition& at, int lane) {
  const road::Road& road = roads.roads[at.road];
  const road::LaneSection& section = road::section_at(road, at.s_m);
  if (lane == 0 || !section.has_lane(lane)) return false;
  const road::LaneBorders borders = road::lane_borders(road, section, lane, at.s_m);
  return is_painted(roads, at, lane, borders.outer_t_m) ||
         is_painted(roads, at, lane > 0 ? lane - 1 : lane + 1, borders.inner_t_m);
}

}  // namespace

double unevenness_m3(std::string_view surface) {
  std::string word(surface);
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& known : surfaces)
    if (word.find(known.first) != std::string::npos) return known.second;
  return class_a_m3;
}

double ground_velocity_mps(double unevenness_m3, double speed_mps, double low_hz, double high_hz) {
  constexpr double n0_per_m = 0.1;
  const double turn = 2.0 * std::numbers::pi * n0_per_m;
  return turn * std::sqrt(std::max(unevenness_m3 * std::abs(speed_mps) * (high_hz - low_hz), 0.0));
}

GroundFeel feel_ground(const road::RoadNetwork& roads, const Snapshot& snapshot,
                       std::optional<road::RoadPosition>& place, double wheelbase_m) {
  GroundFeel feel;
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  if (!body || roads.roads.empty()) return feel;
  const RigidTransform& pose = body->world_from_vehicle;
  if (!std::isfinite(pose.position_m.x + pose.position_m.y + pose.orientation.w + pose.orientation.z)) return feel;
  for (const double side : {half_track_m, -half_track_m}) {
    const Vec3 wheel_m = pose * Vec3(wheelbase_m, side, 0.0);
    const auto found = road::locate(roads, {wheel_m.x, wheel_m.y}, place ? &*place : nullptr);
    if (!found || found->lanes.outside_m > 0.0) {
      feel.unevenness_m3 = std::max(feel.unevenness_m3, class_e_m3);
      continue;
    }
    place = found->position;
    const road::SurfaceMaterial* material = road::material_at(roads, found->position);
    const bool is_paved = found->lanes.lane_any_type == found->lanes.lane;
    feel.unevenness_m3 =
        std::max(feel.unevenness_m3, material && !material->surface.empty() ? unevenness_m3(material->surface)
                                     : is_paved                             ? class_a_m3
                                                                            : class_b_m3);
    feel.on_line = feel.on_line || is_on_line(roads, found->position, found->lanes.lane_any_type);
  }
  return feel;
}

}  // namespace septet::audio
