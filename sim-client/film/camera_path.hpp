#pragma once
/// Camera directions of a shot, frame by frame, computed incrementally without trigonometry.
///
/// Frames are equal steps, so that the camera turns with IncrementalTurn (engine/math/incremental_turn.hpp): the head's
/// pan is one unit vector in the plane and its tilt another, and both follow the quadratic law angle(t) = θ(σt² +
/// (1−σ)t). One turn of the direction in space would be a great circle, along which the pitch changes: an orbit at 12°
/// would dip to 17° within a quarter of a circle and go over the top in half of one. Pure functions.

#include <vector>

#include "engine/film_script/shot.hpp"
#include "engine/math/incremental_turn.hpp"

namespace septet::film {

/// Cosine and sine of the camera's heading and pitch.
struct Look {
  UnitVector<double, 2> heading{1.0, 0.0}, pitch{1.0, 0.0};

  double heading_rad() const { return std::atan2(heading[1], heading[0]); }
  double pitch_rad() const { return std::atan2(pitch[1], pitch[0]); }
  /// Viewing direction, in the frame that headings are counted in.
  Vec3 direction() const { return {heading[0] * pitch[0], heading[1] * pitch[0], pitch[1]}; }
};

/// Looks of a shot, one per frame: the first is that of its beginning, and a turn over the whole shot ends with the
/// last. Error: a shot shorter than a frame, a turn shorter than one frame or over half a circle, and |sigma| > 1.
Expected<std::vector<Look>> camera_path(const Shot& shot, double frames_per_second);

}  // namespace septet::film
