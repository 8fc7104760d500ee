#pragma once
/// Details on a car's body: windows, seams, lamps, plates and livery, laid onto the surface of one level of detail.

#include <vector>

#include "engine/geometry/mesh_measures.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// Body of one level, with the model and shape from which it was made.
struct CarSurface {
  const VehicleModel& model;
  const CarShape& shape;
  const geometry::PolygonMesh& body;  ///< Subdivided surface.
  DetailLevel level;

  float half_width_m() const { return static_cast<float>(model.width_m / 2); }
  float height_m() const { return geometry::bounds(body).max_m.z; }
};

/// Extents of the side windows: x of the parts before and behind them, z of their edges.
struct Glasshouse {
  float cowl, roof_front, roof_rear, backlight, pillar, low_front, low_rear, high;
};
Glasshouse glasshouse_of(const CarSurface& car);

/// True for a bulkhead behind the seats, with goods or a stretcher.
bool carries_goods(const VehicleModel& model);

/// Window pane; Face::left stands for both sides.
struct Window {
  Face face;
  PatchOutline outline;
  bool clear = true;  ///< True for transparent panes; false where the load is.
};
std::vector<Window> car_windows(const CarSurface& car);
PatchOptions window_options(const CarSurface& car, Face face, float lift_m);

/// Body with its windows cut out.
geometry::PolygonMesh open_body(const CarSurface& car);

/// Lining of the cabin of an open body, which is visible through the glass: roof, pillars, doors, tub.
geometry::PolygonMesh cabin_lining(const CarSurface& car, const geometry::PolygonMesh& open);

/// Seats and occupants.
VehicleParts occupants(const CarSurface& car);

/// Windows with their frames, seams, handles, grille, plates: one mesh, finishes as materials.
geometry::PolygonMesh car_trim(const CarSurface& car);

/// Lamps, one part for each role, without visibility ranges.
VehicleParts car_lamps(const CarSurface& car);

/// Chequers and lettering of ambulances and police cars; empty for others.
geometry::PolygonMesh livery(const CarSurface& car);

/// Finish of the body in place of paint.
Finish body_finish(const VehicleModel& model);

/// Blue lamps on roof and grille, a taxi's sign.
VehicleParts roof_parts(const CarSurface& car);

/// Bed or box behind the cab of a van without a van's body.
geometry::PolygonMesh van_load(const CarSurface& car);

}  // namespace septet::scenery
