#pragma once
/// From where on the way to a junction a driver has those in view to whom he gives way.
///
/// Walls are looked past once, at load: for each way of a junction and each other one that has right of way over it, the
/// distance before the stop line from which on nothing as long as a car can hide within the critical gap of whoever
/// comes. Bodies higher than a driver's eyes, and smoke and fog, are looked past in the tick in which it matters.
///
/// A driver to whom a junction is hidden keeps being able to stop at its line, and sees enough once he is there.
///
/// Sources: gaps: Highway Capacity Manual (Transportation Research Board, 2010), table 19-10. Heights of the eye and of
/// what it looks for: about those of an approach sight triangle (AASHTO's Green Book, 1.08 m each), to the top of a
/// car rather than to its lamps. World frame, metres, seconds. Pure.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/sight/air.hpp"
#include "engine/sight/line_of_sight.hpp"
#include "engine/sight/walls.hpp"
#include "engine/traffic/network/lane_graph.hpp"

namespace septet::traffic {

/// Height of a car driver's eyes over the road, their distance behind his bumper, and the height of what he looks for.
inline constexpr double eye_height_m = 1.2, eye_behind_m = 2.2, looked_for_height_m = 1.2;

/// Distances before the stop line at which views are tried; who sees all from the first one on always does.
inline constexpr std::array<double, 8> looks_before_m{50.0, 40.0, 30.0, 20.0, 15.0, 10.0, 5.0, 2.0};
/// So near to it a driver is at the line: he has no better place to look from.
inline constexpr double at_stop_line_m = looks_before_m.back();

/// Farther than that from his eyes a driver who comes to a junction looks for nobody.
inline constexpr double farthest_looked_for_m = 150.0;

/// Least gap in traffic with right of way for a vehicle that stands.
double critical_gap_s(const Way& way);

/// The greatest speed all along a way.
double most_mps_on(const Way& way);

/// How far back from where it enters the junction who comes by `his` matters to one on `mine`, who gives way to him.
double looked_for_back_m(const Way& mine, const WayConflict& conflict, const Way& his);

/// Sets `seen_from_m` of every conflict. `gone`: things whose walls do not stand, ascending.
void look_past_walls(const sight::Walls& walls, LaneGraph& graph, std::span<const std::uint32_t> gone = {});

/// A road through a junction on which some others have right of way, as one looks for them on the way to it.
struct ApproachView {
  road::RoadIndex road = 0;
  bool along_s = true;
  double seen_from_m = 0.0;  ///< As of a conflict; the least of any lane.
  /// One for each way on which they come: places at the height of what is looked for, from the junction back.
  std::vector<std::vector<Vec3>> looked_for_m;
};

/// All of a network, by road. `gone` as above.
std::vector<ApproachView> approach_views(const road::RoadNetwork& network, const sight::Walls& walls,
                                         std::span<const std::uint32_t> gone = {});

/// A body that is higher than drivers' eyes.
struct HighBody {
  std::int32_t who = 0;  ///< As of a presence (town_stages.hpp).
  bool moves = false;
  sight::Box box;
};

/// True for one that hides what is behind it from a car's driver.
bool hides_behind(const VehicleModel& model);
inline bool does_move(double speed_mps) { return speed_mps >= 0.5; }

/// True where bodies, or the air (empty: it is clear), hide a stretch of the way to `his` as long as a car from an eye, up
/// to `back_m` before the junction. Who drives behind a body that moves there comes after it, and is not looked for.
bool is_hidden_by(std::span<const HighBody> bodies, const sight::OpticalDepth& air, const LaneGraph& graph,
                  const Vec3& eye_m, const Way& his, double back_m);
/// The same of bodies, on any of the ways of a view.
bool is_hidden_by(std::span<const HighBody> bodies, const ApproachView& view, const Vec3& eye_m);

}  // namespace septet::traffic
