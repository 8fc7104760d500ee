#pragma once
/// A road network as plain data: the content of an OpenDRIVE file, checked, linked by index and ready to be evaluated.
///
/// Made by read_opendrive (opendrive_reader.hpp), immutable afterwards, safe to read from many threads. World frame:
/// see rigid_transform.hpp; the header's offset is already applied to plan and elevation. Metres and radians
/// throughout.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/road/cubic_record.hpp"
#include "engine/road/lane.hpp"
#include "engine/road/plan_curve.hpp"
#include "engine/road/road_furniture.hpp"

namespace septet::road {

using RoadIndex = std::uint32_t;
using JunctionIndex = std::uint32_t;
inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

enum class TrafficRule : std::uint8_t { right_hand, left_hand };
enum class ContactPoint : std::uint8_t { start, end };

/// Link of a road's start or end; at most one index is set.
struct RoadLink {
  RoadIndex road = no_index;
  JunctionIndex junction = no_index;
  ContactPoint contact = ContactPoint::start;  ///< The end of `road` at the link.
};

struct RoadTypeRecord {
  double s_m = 0.0;
  std::string type;
  double speed_limit_mps = 0.0;  ///< 0 where the file gives none.
};

/// Height over the road's plane as a cubic of dt from t_m on, at station s_m (OpenDRIVE 1.8, §10.5.2, lateral shape).
struct LateralShape {
  double s_m = 0.0;
  double t_m = 0.0;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
};

/// A patch of other material on a road: a polygon in road coordinates (x is s, y is t) with its bounds.
struct SurfacePatch {
  SurfaceMaterial material;
  std::vector<Vec2> corners_st_m;
  Vec2 low_st_m{0.0}, high_st_m{0.0};
};

struct Road {
  std::string id, name;
  double length_m = 0.0;
  TrafficRule rule = TrafficRule::right_hand;
  JunctionIndex junction = no_index;  ///< The junction that this road is a part of.
  RoadLink predecessor, successor;
  std::vector<RoadTypeRecord> types;
  PlanCurve plan;
  CubicProfile elevation;       ///< z of the reference line.
  CubicProfile superelevation;  ///< Roll: positive lifts the left side.
  CubicProfile crossfall_left,
      crossfall_right;                ///< OpenDRIVE 1.4: angle by which each side falls outwards.
  std::vector<LateralShape> shapes;   ///< Sorted by s_m, then t_m.
  CubicProfile lane_offset;           ///< t of the centre lane.
  std::vector<LaneSection> sections;  ///< At least one, the first at 0, sorted.
  bool flat = false;  ///< True without lane height, shape or crossfall, so that the surface is the road's plane.
  bool has_materials = false;  ///< Some lane has one.
  std::vector<RoadObject> objects;
  std::vector<SurfacePatch> patches;  ///< Patches among the objects; the last one on top.
  std::vector<RoadStructure> structures;
  std::vector<Signal> signals;
};

struct LaneLink {
  int from = 0;
  int to = 0;
};

/// Traffic from `incoming` enters `connecting` at its `contact` end.
/// In a direct junction `connecting` is the linked road itself.
struct JunctionConnection {
  std::string id;
  RoadIndex incoming = no_index;
  RoadIndex connecting = no_index;
  ContactPoint contact = ContactPoint::start;
  std::vector<LaneLink> lane_links;
};

/// Traffic from, or on, one road of a junction goes before that of another one (ASAM OpenDRIVE 1.8, 12.8).
struct JunctionPriority {
  RoadIndex high = no_index, low = no_index;
};

struct Junction {
  enum class Kind : std::uint8_t { common, direct, virtual_junction, crossing };
  std::string id, name;
  Kind kind = Kind::common;
  std::vector<JunctionConnection> connections;
  std::vector<JunctionPriority> priorities;
};

/// A node of the tree of bounding boxes over stretches of road; in pre-order, `skip` is the next node outside this one.
struct StretchNode {
  Vec2 low_m, high_m;
  std::uint32_t skip = 0;
  RoadIndex road = no_index;  ///< Leaf: the stretch of this road from s_m on, step_m long. Inner node: no_index.
  double s_m = 0.0, step_m = 0.0;
};

struct NetworkHeader {
  int revision_major = 1, revision_minor = 0;
  std::string name, geo_reference;
};

struct RoadNetwork {
  NetworkHeader header;
  std::vector<Road> roads;
  std::vector<Junction> junctions;
  std::vector<StretchNode> stretches;      ///< Spatial index for locate (road_locate.hpp).
  Vec2 low_m{0.0, 0.0}, high_m{0.0, 0.0};  ///< Bounds of all lanes.
};

/// The road with this id of the file.
std::optional<RoadIndex> find_road(const RoadNetwork& network, std::string_view id);

}  // namespace septet::road
