#pragma once
/// Shots of a film, each a stretch of the session seen by one camera. Plain data; sim-client/film/FILM.md is the file's
/// format.
///
/// The camera hangs on a pivot, a participant or a fixed place, `distance_m` behind it as it looks: at 0 it looks
/// around from there, through the participant's eyes; further away it looks at the pivot and orbits it as it turns. Its
/// head pans and tilts, so the horizon is level. Angles are radians: heading counter-clockwise, pitch positive upwards.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/math/rigid_transform.hpp"

namespace septet::film {

/// Zero direction of headings.
enum class Bearings : std::uint8_t {
  vehicle,  ///< The participant's own heading: the camera goes round bends with it.
  world,    ///< East.
  gaze,     ///< Where a participant's eyes look: the driver's by their logged head, others straight on.
};

/// Turns the camera, from the end of the turn before, by the shorter path.
struct Turn {
  double until_s = 0.0;  ///< Simulated time of its end.
  double heading_rad = 0.0, pitch_rad = 0.0;
  double sigma = 0.0;  ///< 1 begins at rest and speeds up, 0 is even, −1 slows down to rest (incremental_turn.hpp).
};

struct Shot {
  double from_s = 0.0, to_s = 0.0;  ///< Simulated time; a frame at from_s, none at to_s.
  double speed = 1.0;  ///< Rate of time: 0.25 is slow motion, in which a frame is a quarter as far from the next.
  std::string participant = "driver";  ///< "driver", "nearest", a scenario's name, a number or a model.
  std::optional<Vec3> place_m;         ///< World: the pivot, in the participant's stead.
  double distance_m = 0.0;
  Bearings bearings = Bearings::vehicle;
  double heading_rad = 0.0, pitch_rad = 0.0;  ///< Direction at the beginning.
  std::vector<Turn> turns;                    ///< Ascending `until_s`; after the last one the camera holds still.
  double field_of_view_rad = std::numbers::pi / 3.0;  ///< Across the picture's width.
  /// f-number of a lens before a film 36 mm wide: its focal length, which follows from the field of view, over its
  /// opening. 0: a pinhole, all is sharp.
  double f_number = 0.0;
  double focus_m = 10.0;  ///< Distance before the camera at which a lens is sharp.
  /// Shutter angle: the exposure, where a whole turn is the time to the next frame. 0: instantaneous.
  double shutter_rad = 0.0;
  bool interior = false;  ///< Through a participant's eyes: the car's inside is drawn, where there is a model of it.
  std::string where;      ///< For messages: "shots.toml, shot 2".
};

/// Radius of the lens' opening; 0 of a pinhole.
double lens_radius_m(const Shot& shot);

struct Script {
  std::vector<Shot> shots;
};

}  // namespace septet::film
