#pragma once
/// Parts of the vehicles, as meshes with finishes, before they enter the scene.
///
/// Three levels of detail: near (up to about 6,000 triangles, with the interior behind windows), middle (800) and far
/// (120). Parts that turn or shine are parts of their own with a role. Vehicle frame, metres; wheels have their origin
/// in their centre.

#include <string>
#include <vector>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scenery/palette.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

inline constexpr float near_until_m = 36.0f, middle_until_m = 130.0f, vehicles_until_m = 2500.0f;

enum class DetailLevel { near, middle, far };

struct VehiclePart {
  std::string name;
  geometry::PolygonMesh mesh;  ///< Materials are Finish indices.
  std::uint32_t subdivision_level = 0;
  std::vector<Placement> places;  ///< Instances; visibility ranges are filled in by set_detail.
};

using VehicleParts = std::vector<VehiclePart>;

/// Name suffix " near", " middle" or " far", which distinguishes parts of different levels.
const char* suffix_of(DetailLevel level);

/// Gives `of_level` its range and its names, and adds it to `parts`.
void add_level(VehicleParts& parts, VehicleParts of_level, DetailLevel level);

/// Gives every placement of `part` the range of the level.
void set_detail(VehiclePart& part, DetailLevel level);

/// All parts of a model of the catalogue, all three levels.
VehicleParts vehicle_parts(const VehicleModel& model);

VehicleParts car_parts(const VehicleModel& model);    ///< Cars, vans, ambulances.
VehicleParts lorry_parts(const VehicleModel& model);  ///< Lorries with their loads, trailers, fire engines.
VehicleParts bus_parts(const VehicleModel& model);
VehicleParts farm_tractor_parts(const VehicleModel& model);
VehicleParts caravan_parts(const VehicleModel& model);
VehicleParts bicycle_parts(const VehicleModel& model);
VehicleParts motorcycle_parts(const VehicleModel& model);
VehicleParts pedestrian_parts(const VehicleModel& model);
VehicleParts box_parts();  ///< Of a metre each way; frames stretch it (instant::DrawnParticipant).
/// Parts of a vehicle as its driver, rider or walker sees them who looks out of it: all near ones without its panes and
/// without that person's head (of those who sit, body), with dashboard, steering wheel and mirrors. Empty for what is
/// towed, and for the model with a cockpit (interior_parts).
VehicleParts inside_parts(const VehicleModel& model);
/// The head that inside_parts leaves out of a rider or walker, which throws its shadow all the same; empty for others.
VehicleParts own_head_parts(const VehicleModel& model);
/// Parts of the S80 that its driver sees: bonnet, dashboard, pillars, steering wheel. Materials are CockpitFinish
/// indices, as in all functions below but the next.
VehicleParts interior_parts();
/// Other parts of that car that throw shadows and shine while its inside is drawn: wheels, lamps, the body without the
/// part that the cabin's frame replaces. The whole body, of a model for the view from outside, would stand among the
/// dashboard and keep light from it. Materials are Finish indices.
VehicleParts shell_parts();
VehicleParts hands_parts();       ///< Driver's hands; they turn as the wheel does.
VehicleParts instrument_parts();  ///< Faces of the instruments alone, for a screen with no other content.
VehicleParts dial_parts();        ///< The same without anything around them, for other vehicles' dashboards.
VehicleParts water_parts();       ///< Sample of the material of drops on the windscreen.
VehicleParts sign_parts();  ///< Sample of the material of needles and lit signs, which each frame puts in their places.

}  // namespace septet::scenery
