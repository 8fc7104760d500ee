#pragma once
/// A road network as traffic drives it: ways, how they follow each other, and where they meet.
///
/// A way is one driving lane of one lane section, in its direction of travel; a way within a junction is a connection.
/// All is found once, at load, in flat arrays: a way names its ranges in them. Positions on a way are metres along its
/// middle from where it is entered. Curvature gives the speed of a bend; outlines' width gives the stretches of two
/// ways that two vehicles cannot hold at a time (conflicts).
///
/// Memory and time grow with the length of the lanes; conflicts are sought among the ways of one junction alone.
/// Immutable once built; pure functions; safe from many threads. World frame, metres, radians.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/road/road_network.hpp"
#include "engine/traffic/crossing.hpp"
#include "engine/traffic/yield_line.hpp"

namespace septet::traffic {

using WayIndex = std::uint32_t;
inline constexpr WayIndex no_way = 0xFFFF'FFFFu;

/// Sideways acceleration in a bend that nobody exceeds, and the one that drivers choose: as in lane_way.hpp.
inline constexpr double most_bend_mps2 = 2.5, town_bend_mps2 = 2.0;
/// Speed where the file posts no limit: of a built-up area (Vienna Convention's practice, 50 km/h).
inline constexpr double unposted_mps = 50.0 / 3.6;

/// Two widths of the widest vehicle, half each, and 0.2 m of air: ways nearer than that meet.
inline constexpr double meeting_m = 2.75;

/// Vehicles longer than this are long ones, and the length of the longest that is no articulated one (96/53/EC).
inline constexpr double long_vehicle_m = 8.0, longest_rigid_m = 12.0;

struct Range {
  std::uint32_t first = 0, count = 0;
};

/// What right of way a road gives to traffic that enters a junction from it.
enum class Rank : std::uint8_t { yields, equal, priority };

struct Way {
  road::RoadIndex road = 0;
  std::uint32_t section = 0;
  std::int32_t lane = 0;
  bool along_s = true;
  bool left_hand = false;  ///< Traffic keeps left.
  std::uint32_t junction = road::no_index;
  double length_m = 0.0;
  double limit_mps = unposted_mps;
  /// Of a connection: heading where its junction is entered, angle through which the junction turns it (left is
  /// positive), and its right of way there.
  double enters_rad = 0.0, turns_rad = 0.0;
  Rank rank = Rank::equal;
  bool onto_ring = false;  ///< It leads into a roundabout.
  bool on_ring = false;    ///< It lies on a roundabout's ring, or leads out of it and crosses nobody.
  /// Its connecting road's first and last way, and the distances from where that begins and to where it ends.
  WayIndex entry = no_way, exit = no_way;
  double from_entry_m = 0.0, to_exit_m = 0.0;
  /// Of a way that ends at a junction: distance of its stop line from its end, whether lights hang there, and whether a
  /// stop sign (206) has everybody stand at the line.
  double line_before_m = 1.0;
  bool has_light = false, has_stop = false;
  bool goes_on = true;          ///< A drive from here need not end.
  double tightest_per_m = 0.0;  ///< Greatest curvature, as a magnitude.
  Range points, next, before, conflicts, long_conflicts, walked;

  bool in_junction() const { return junction != road::no_index; }
};

/// Points of a way, evenly spaced from its begin to its end.
struct WayPoint {
  Vec3 position_m{0.0};
  Vec3 tangent{1.0, 0.0, 0.0};   ///< Unit, in the direction of travel.
  double curvature_per_m = 0.0;  ///< Of the lane's middle in the plan; positive turns left.
  double width_m = 0.0;          ///< Of the lane.
  double bend_m2ps2 = 0.0;       ///< Square of the speed that the bends from here on allow, with braking before them.
};

/// A stretch of a way, and the stretch of another one that is too near to it.
struct WayConflict {
  enum class Kind : std::uint8_t { crossing, merging, diverging };
  Kind kind = Kind::crossing;
  WayIndex with = no_way;
  double from_m = 0.0, to_m = 0.0;
  double with_from_m = 0.0, with_to_m = 0.0;
  /// The stretch of their connecting roads in which this one lies, over all of their sections: before a way's begin or
  /// beyond its end it lies on other sections. It is held by one at a time.
  double whole_from_m = 0.0, whole_to_m = 0.0;
  double with_whole_from_m = 0.0, with_whole_to_m = 0.0;
  /// Distance from the own stop line from which those who come by the other way are in view past the walls
  /// (approach_view.hpp); infinite: they always are.
  double seen_from_m = std::numeric_limits<double>::infinity();
};

/// A stretch of a way on which people cross.
struct WalkedStretch {
  std::uint32_t crossing = 0;
  double from_m = 0.0, to_m = 0.0;
  double lane_from_m = 0.0, lane_to_m = 0.0;  ///< The lane's breadth, as places on the crossing (crossing.hpp).
};

struct LaneGraph {
  std::vector<Way> ways;  ///< By road, section, then lane from the left.
  std::vector<WayPoint> points;
  std::vector<WayIndex> next, before;
  std::vector<WayConflict> conflicts;
  /// By way: others of its junction that one vehicle may pass on and another drive beside, but no two long ones: their
  /// ends reach over in bends (body_on_route, town_stages.hpp).
  std::vector<WayIndex> long_conflicts;
  std::vector<WalkedStretch> walked;
  std::vector<WayIndex> way_of_lane;         ///< By `first_lane` of the section; no_way: not driven on.
  std::vector<std::uint32_t> first_section;  ///< By road: index in `first_lane`.
  std::vector<std::uint32_t> first_lane;

  std::span<const WayIndex> next_of(const Way& way) const { return {next.data() + way.next.first, way.next.count}; }
  std::span<const WayIndex> before_of(const Way& way) const {
    return {before.data() + way.before.first, way.before.count};
  }
  std::span<const WayConflict> conflicts_of(const Way& way) const {
    return {conflicts.data() + way.conflicts.first, way.conflicts.count};
  }
  std::span<const WalkedStretch> walked_of(const Way& way) const {
    return {walked.data() + way.walked.first, way.walked.count};
  }
  std::span<const WayIndex> long_conflicts_of(const Way& way) const {
    return {long_conflicts.data() + way.long_conflicts.first, way.long_conflicts.count};
  }
};

LaneGraph build_lane_graph(const road::RoadNetwork& network);

/// Adds the stretches of these crossings, in the place of earlier ones.
void mark_crossings(const road::RoadNetwork& network, std::span<const CrossingPlace> places, LaneGraph& graph);

/// The way of a lane at a station; no_way: cars do not drive there.
WayIndex way_at(const LaneGraph& graph, const road::RoadNetwork& network, road::RoadIndex road, int lane, double s_m);

/// A place on a way: position and tangent are those of the smooth curve through its points.
struct PlaceOnWay {
  Vec3 position_m{0.0};
  Vec3 tangent{1.0, 0.0, 0.0};
  double curvature_per_m = 0.0;
  double width_m = 0.0;  ///< Of the lane.
};
PlaceOnWay place_on_way(const LaneGraph& graph, const Way& way, double at_m);

/// Its curvature alone.
double curvature_on_way_per_m(const LaneGraph& graph, const Way& way, double at_m);

/// Square of the speed that bends allow at a place, and its slope by the metre.
struct AllowedSquare {
  double m2ps2 = 0.0, by_m = 0.0;
};
AllowedSquare bend_square_at(const LaneGraph& graph, const Way& way, double at_m);

/// True where two ways of a junction cross: then traffic is more than lines of roads.
bool has_crossings(const LaneGraph& graph);

/// True where who drives `mine` lets him pass who drives `his`: by rank, else who comes from the right (keeping left:
/// from the left), and who turns across the oncoming.
bool yields_to(const Way& mine, const Way& his);

}  // namespace septet::traffic
