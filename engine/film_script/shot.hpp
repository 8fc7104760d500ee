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

/// A second camera of a shot, at the same instants: its picture lies to the right of the first one's, each half as wide.
/// It holds still.
struct SecondCamera {
  std::string participant = "driver";
  std::optional<Vec3> place_m;
  double distance_m = 0.0;
  Bearings bearings = Bearings::vehicle;
  double heading_rad = 0.0, pitch_rad = 0.0;
  double field_of_view_rad = std::numbers::pi / 3.0;  ///< Across its half of the picture.
  bool interior = false;
  std::string title;
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
  std::optional<SecondCamera> beside;
  std::string title;     ///< Over the picture, if the script has an overlay.
  bool overlay = false;  ///< Clock, speeds and notes of the script's overlay lie over the picture.
  /// With the overlay: the ways of its participants, and their outlines, as lines over the picture.
  bool paths = false;
  std::string where;  ///< For messages: "shots.toml, shot 2".
};

/// The shot of the second camera alone, which must be there.
Shot shot_beside(const Shot& shot);

/// Radius of the lens' opening; 0 of a pinhole.
double lens_radius_m(const Shot& shot);

/// What lies over the pictures of a script's shots besides the clock.
struct Overlay {
  std::optional<double> contact_s;        ///< The clock also counts to this instant,
  std::string contact = "the contact";    ///< which is called so.
  std::optional<Vec3> contact_m;          ///< Its place in the world, marked in views from outside.
  std::vector<std::string> participants;  ///< Those with speed, label and way: as Shot::participant, no models.
  std::vector<std::string> notes;         ///< Lines at the bottom: what is measured, assumed, computed.
};

struct Script {
  std::vector<Shot> shots;
  Overlay overlay{};
};

}  // namespace septet::film
