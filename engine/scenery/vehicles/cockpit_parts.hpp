#pragma once
/// Parts of the inside of the driver's car, each as a mesh in the vehicle's frame whose materials are CockpitFinish
/// indices.

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::scenery {

/// Dashboard with the hood over the instruments, vents and the centre console.
geometry::PolygonMesh dashboard();
/// Faces of the instruments (engine/world/instrument_panel.hpp).
geometry::PolygonMesh instrument_faces();
/// Enclosure of the cabin, seen from inside: pillars with the doors' frames, roof, sun visors, doors below their
/// windows, floor and bulkheads.
geometry::PolygonMesh cabin_frame();
/// Steering wheel in its own frame: it turns about x, which points away from the driver, and its top is at z.
geometry::PolygonMesh steering_wheel();
/// Driver's hands on that wheel when it stands straight, in the same frame.
geometry::PolygonMesh hands();

}  // namespace septet::scenery
