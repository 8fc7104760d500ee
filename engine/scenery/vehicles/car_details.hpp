#pragma once
/// What lies on a car's body: windows, seams, lamps, plates and livery, laid onto the surface of
/// one level of detail.

#include "engine/geometry/mesh_measures.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/finish.hpp"
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
