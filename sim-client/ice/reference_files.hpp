#pragma once
/// Input for a path tracer to draw the same picture: the object as an OBJ file, the panorama around it as a PFM image,
/// the camera as JSON. tests/benchmarks/peers/ice_reference.py reads them.

#include "engine/core/expected.hpp"
#include "sim-client/ice/ice_viewer.hpp"

namespace septet::ice_viewer {

/// Place of the camera: it looks at the origin.
struct Seat {
  Vec3 eye_m{0.0};
  double pitch_rad = 0.0, horizontal_rad = 0.0, vertical_rad = 0.0;
};
Seat seat_of(const IceOptions& options);

/// Writes object.obj, panorama.pfm (2048 × 1024; columns by azimuth from −y over +x, rows from the zenith) and
/// camera.json.
Expected<void> write_reference_files(const ice::Surface& surface, const IceOptions& options);

}  // namespace septet::ice_viewer
