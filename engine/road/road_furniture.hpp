#pragma once
/// Objects on, over and beside a road: objects, bridges, tunnels and signals (OpenDRIVE 1.8, §13 and §14).
///
/// Kept as in the file, in road coordinates (metres, radians), for the scenery and for traffic to read.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/road/lane.hpp"

namespace septet::road {

enum class Orientation : std::uint8_t { both, along, against };  ///< "none", "+", "-".

/// A corner of an outline, in road coordinates (cornerRoad) or in the object's frame (cornerLocal).
struct OutlineCorner {
  bool in_road_coordinates = false;
  double s_or_u_m = 0.0;
  double t_or_v_m = 0.0;
  double z_m = 0.0;
  double height_m = 0.0;
};

struct Outline {
  bool closed = true;
  std::vector<OutlineCorner> corners;
};

/// A row of equal objects from s_m to s_m + length_m; distance_m 0 is one continuous object, such as a guard rail.
struct ObjectRepeat {
  double s_m = 0.0, length_m = 0.0, distance_m = 0.0;
  double t_start_m = 0.0, t_end_m = 0.0;
  double width_start_m = 0.0, width_end_m = 0.0;
  double height_start_m = 0.0, height_end_m = 0.0;
  double z_offset_start_m = 0.0, z_offset_end_m = 0.0;
};

struct RoadObject {
  std::string id, name, type, subtype;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;
  double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;  ///< Relative to the road.
  double length_m = 0.0, width_m = 0.0, height_m = 0.0, radius_m = 0.0;
  Orientation orientation = Orientation::both;
  std::vector<ObjectRepeat> repeats;
  std::vector<Outline> outlines;
  std::optional<SurfaceMaterial> material;  ///< Material of a patch of the road, within its outline.
};

/// A bridge or a tunnel: the stretch of the road from s_m to s_m + length_m.
struct RoadStructure {
  enum class Kind : std::uint8_t { bridge, tunnel };
  Kind kind = Kind::bridge;
  std::string id, name, type;
  double s_m = 0.0, length_m = 0.0;
  bool over_road = false;  ///< A bridge with lanes below it (decks.hpp).
  bool inferred = false;   ///< The file says nothing of it.
};

struct Signal {
  std::string id, name, country, type, subtype, unit, text;
  double s_m = 0.0, t_m = 0.0, z_offset_m = 0.0;
  double value = 0.0;
  double height_m = 0.0, width_m = 0.0;
  double heading_offset_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
  Orientation orientation = Orientation::both;
  bool dynamic = false;
  int from_lane = 0, to_lane = 0;  ///< Range of its lanes; both 0 where it is valid for all.

  /// A light for vehicles, of round lamps or of arrows (OpenDRIVE's catalogue).
  bool is_vehicle_light() const { return dynamic && (type == "1000001" || type == "1000011"); }
};

}  // namespace septet::road
