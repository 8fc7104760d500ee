#pragma once
/// What lies on a car's body: windows, seams, lamps, plates and livery, laid onto the surface of
/// one level of detail.

#include <vector>

#include "engine/geometry/mesh_measures.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// A body of one level and what it was made from.
struct CarSurface {
  const VehicleModel& model;
  const CarShape& shape;
  const geometry::PolygonMesh& body;  ///< As it is shown.
  DetailLevel level;

  float half_width_m() const { return static_cast<float>(model.width_m / 2); }
  float height_m() const { return geometry::bounds(body).max_m.z; }
};

/// Where the side windows end: x of what is before and behind them, z of their edges.
struct Glasshouse {
  float cowl, roof_front, roof_rear, backlight, pillar, low_front, low_rear, high;
};
Glasshouse glasshouse_of(const CarSurface& car);

/// Behind its seats is a bulkhead, and goods or a stretcher.
bool carries_goods(const VehicleModel& model);

/// One pane; Face::left stands for both sides.
struct Window {
  Face face;
  PatchOutline outline;
  bool clear = true;  ///< One sees through it; not where the load is.
};
std::vector<Window> car_windows(const CarSurface& car);
PatchOptions window_options(const CarSurface& car, Face face, float lift_m);

/// The body with its windows cut out, lined with the dark of the cabin: what one looks into through the glass.
geometry::PolygonMesh open_body(const CarSurface& car);

/// Seats, and who sits on them.
VehicleParts occupants(const CarSurface& car);

/// Windows with their frames, seams, handles, grille, plates: one mesh, finishes as materials.
geometry::PolygonMesh car_trim(const CarSurface& car);

/// One part a lamp role, without visibility ranges.
VehicleParts car_lamps(const CarSurface& car);

/// Chequers and lettering of ambulances and police cars; nothing on others.
geometry::PolygonMesh livery(const CarSurface& car);

/// What the body wears where others have paint.
Finish body_finish(const VehicleModel& model);

/// The blue lamps on roof and grille, a taxi's sign.
VehicleParts roof_parts(const CarSurface& car);

/// What stands behind the cab of a van without a van's body.
geometry::PolygonMesh van_load(const CarSurface& car);

}  // namespace septet::scenery
