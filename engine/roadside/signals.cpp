#include "engine/roadside/signals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"

namespace septet::roadside {
namespace {

constexpr double highest_paint_m = 0.1, usual_bottom_m = 2.1, light_height_m = 0.95, light_width_m = 0.32;

bool is_light_type(std::string_view type) {
  // Catalogue of OpenDRIVE: 1000001 vehicles, 1000002 pedestrians, from 1000007 on further forms of lamps.
  return type.size() == 7 && type.starts_with("10000") && type != "1000003" && type != "1000004" && type != "1000005" &&
         type != "1000006";
}

double usual(double given, double otherwise, double least, double most) {
  return given > 0.0 ? std::clamp(given, least, most) : otherwise;
}

bool is_over_lanes(const road::Road& road, const road::Signal& signal) {
  const road::LanesAt lanes = road::lanes_at(road, signal.s_m, signal.t_m);
  if (lanes.outside_m > 0.0 || lanes.lane_any_type == 0) return false;
  const road::LaneSection& section = road::section_at(road, signal.s_m);
  return section.has_lane(lanes.lane_any_type) && road::is_drivable(section.lane(lanes.lane_any_type).type);
}

}  // namespace

SignalForm form_of(const road::Signal& signal) {
  const std::string_view name = signal.name, type = signal.type;
  if (name == "speed_display" || (signal.dynamic && type == "274")) return SignalForm::display;
  if (type == "1000003" || type == "1000004") return SignalForm::crossing;
  if (is_light_type(type)) {
    const bool walk = type == "1000002" || type == "1000007" || name.find("edestrian") != std::string_view::npos;
    return walk ? SignalForm::pedestrian_light : SignalForm::light;
  }
  if (type == "294") return SignalForm::stop_line;
  if (type == "341") return SignalForm::waiting_line;
  const bool flat = signal.height_m > 0.0 && signal.height_m <= highest_paint_m;
  if (flat || type == "297")
    return name.find("rrow") != std::string_view::npos || type == "297" ? SignalForm::arrow : SignalForm::none;
  const bool nameless = type.empty() || type == "-1" || type == "none";
  if (nameless && !(name.starts_with("de_") || name.starts_with("se_"))) return SignalForm::none;
  if (signal.dynamic) return SignalForm::light;
  return SignalForm::board;
}

int direction_of(const road::Road& road, const road::Signal& signal) {
  if (signal.orientation == road::Orientation::along) return 1;
  if (signal.orientation == road::Orientation::against) return -1;
  const bool right_hand = road.rule == road::TrafficRule::right_hand;
  return (signal.t_m <= 0.0) == right_hand ? 1 : -1;
}

std::vector<StandingSignal> standing_signals(const RoadShape& roads) {
  std::vector<StandingSignal> result;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const road::Road& road = roads.road(index);
    const std::size_t first = result.size();
    for (const road::Signal& signal : road.signals) {
      StandingSignal standing{.road = index, .signal = &signal, .form = form_of(signal)};
      const bool is_light = standing.form == SignalForm::light || standing.form == SignalForm::pedestrian_light;
      if (!is_light && standing.form != SignalForm::board) continue;
      const road::RoadPoint at = roads.at(index, signal.s_m, signal.t_m);
      const double turn = (direction_of(road, signal) > 0 ? 0.0 : std::numbers::pi) +
                          std::remainder(signal.heading_offset_rad, 2.0 * std::numbers::pi);
      standing.world_from_signal = {at.position_m, orientation_from_angles(at.heading_rad + turn, 0.0, 0.0)};
      standing.bottom_m = signal.z_offset_m > 0.3 ? std::min(signal.z_offset_m, 12.0) : usual_bottom_m;
      if (is_light) {
        standing.width_m = light_width_m;
        standing.height_m = standing.form == SignalForm::light ? light_height_m : 0.64;
        if (signal.z_offset_m <= 0.3 && signal.height_m > 1.5)
          standing.bottom_m = std::min(signal.height_m, 12.0) - standing.height_m;
      } else {
        standing.width_m = usual(signal.width_m, 0.6, 0.2, 8.0);
        standing.height_m = usual(signal.height_m, standing.width_m, 0.2, 8.0);
      }
      // Raised above the signals at this place.
      for (std::size_t i = first; i < result.size(); ++i) {
        const StandingSignal& other = result[i];
        if (glm::distance(other.world_from_signal.position_m, at.position_m) > 0.5 ||
            direction_of(road, *other.signal) != direction_of(road, signal))
          continue;
        const double top = other.bottom_m + other.height_m;
        if (standing.bottom_m < top && standing.bottom_m + standing.height_m > other.bottom_m)
          standing.bottom_m = top + 0.05;
      }
      if (standing.bottom_m > 12.0) continue;
      standing.has_post = !is_over_lanes(road, signal);
      result.push_back(standing);
    }
  }
  return result;
}

}  // namespace septet::roadside
