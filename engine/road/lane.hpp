#pragma once
/// Lanes, lane sections and road marks (OpenDRIVE 1.8, §11), as plain data.
///
/// Stations are metres along the reference line of the road, never relative to the section. Left lanes have ids > 0,
/// right lanes ids < 0, the centre lane, which has no width, is 0. Immutable once the network is read.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/road/cubic_record.hpp"

namespace septet::road {

enum class LaneType : std::uint8_t {
  none,
  driving,
  entry,
  exit,
  on_ramp,
  off_ramp,
  connecting_ramp,
  slip_lane,
  bidirectional,
  shoulder,
  stop,
  border,
  curb,
  median,
  sidewalk,
  biking,
  parking,
  restricted,
  road_works,
  rail,
  tram,
  bus,
  taxi,
  hov,
  other,
};

/// True for lanes of cars: driving, entry, exit, the ramps, slip lane and bidirectional.
bool is_drivable(LaneType type);
/// The word of the standard for a lane type, such as "onRamp"; "none" for `other`.
const char* name_of(LaneType type);

enum class RoadMarkType : std::uint8_t {
  none,
  solid,
  broken,
  solid_solid,
  solid_broken,
  broken_solid,
  broken_broken,
  botts_dots,
  grass,
  curb,
  edge,
  custom,
};
enum class RoadMarkColor : std::uint8_t { white, yellow, blue, green, red, orange, violet, black };
enum class LaneChange : std::uint8_t { both, increase, decrease, none };

/// One painted line of a mark: painted for length_m, then bare for space_m, and again from there;
/// space 0 is a continuous line. A line that is painted `once` stands alone, length_m long.
struct RoadMarkLine {
  double length_m = 0.0;
  double space_m = 0.0;
  double t_offset_m = 0.0;  ///< From the mark's border.
  double s_offset_m = 0.0;  ///< From the start of the mark.
  double width_m = 0.0;
  bool once = false;
};

/// A mark on the outer border of its lane (of the centre lane: on the centre line), from s_m to s_end_m.
struct RoadMark {
  double s_m = 0.0;
  double s_end_m = 0.0;
  RoadMarkType type = RoadMarkType::none;
  RoadMarkColor color = RoadMarkColor::white;
  LaneChange lane_change = LaneChange::both;
  bool bold = false;
  double width_m = 0.12;
  double height_m = 0.0;
  std::vector<RoadMarkLine> lines;  ///< Never empty unless the type is none, grass, curb or edge:
                                    ///< filled from the type if need be.
};

/// Height of the lane's surface over the road's plane, constant along s, linear from the inner to the outer border.
struct LaneHeight {
  double s_m = 0.0;
  double inner_m = 0.0;
  double outer_m = 0.0;
};

struct LaneSpeed {
  double s_m = 0.0;
  double limit_mps = 0.0;
};

/// Material of a surface (OpenDRIVE 1.8, §11.8.1 lane material; §13.4 material of objects, for patches of the road).
struct SurfaceMaterial {
  std::string surface;     ///< The file's own word; Septet knows wet, snow and ice, all others are paved.
  double friction = 0.0;   ///< Coefficient when dry; 0 where the file gives none.
  double roughness = 0.0;  ///< For sound and shaking; 0 where the file gives none.
};
struct LaneMaterial {
  double s_m = 0.0;
  SurfaceMaterial material;
};

/// Direction of traffic, beyond the rule of the road.
enum class LaneDirection : std::uint8_t { standard, reversed, both };

struct Lane {
  int id = 0;
  LaneType type = LaneType::none;
  LaneDirection direction = LaneDirection::standard;
  bool level = false;
  CubicProfile widths;   ///< Width; used where not empty.
  CubicProfile borders;  ///< |t| of the outer border; used where there are no widths.
  std::vector<LaneHeight> heights;
  std::vector<LaneSpeed> speeds;
  std::vector<LaneMaterial> materials;
  std::vector<RoadMark> marks;
  std::vector<int> predecessors;  ///< Lane ids in the section (or linked road) before this one.
  std::vector<int> successors;    ///< Lane ids in the section (or linked road) after this one.
};

/// Lanes from s_m to s_end_m, sorted from the leftmost (highest id) to the rightmost; ids run without a gap through 0.
struct LaneSection {
  double s_m = 0.0;
  double s_end_m = 0.0;
  int left_count = 0;
  int right_count = 0;
  std::vector<Lane> lanes;

  bool has_lane(int id) const { return id <= left_count && id >= -right_count; }
  /// The lane with this id, which must exist.
  const Lane& lane(int id) const { return lanes[static_cast<std::size_t>(left_count - id)]; }
};

}  // namespace septet::road
