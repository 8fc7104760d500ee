#pragma once
/// The signals of a road file as things that stand or lie somewhere: what the scenery draws and, of posts, what cars run against.
///
/// OpenDRIVE 1.8, §14: zOffset is the lower edge over the road, width and height are the face's. Files also write the height of a light with
/// its pole, and roads' paint as signals of no height. What says nothing of its size gets a usual one. Signals at one place hang over one
/// another.

#include <cstdint>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class SignalForm : std::uint8_t {
  none,     ///< Nothing to be seen.
  board,    ///< A static sign.
  display,  ///< A changeable sign over the lanes of a motorway.
  light,    ///< Of vehicles.
  pedestrian_light,
  stop_line,
  arrow,     ///< Paint that points along a lane.
  crossing,  ///< Paint: see crossings.hpp.
};

SignalForm form_of(const road::Signal& signal);

struct StandingSignal {
  road::RoadIndex road = 0;
  const road::Signal* signal = nullptr;
  SignalForm form = SignalForm::none;
  RigidTransform world_from_signal;  ///< x the way that who reads it drives; on the road, below the signal.
  double bottom_m = 0.0;             ///< Of the face, over the road.
  double width_m = 0.6, height_m = 0.6;
  bool has_post = true;  ///< None over lanes that are driven, and under a gantry.
};
/// Boards and lights, in the order of the file.
std::vector<StandingSignal> standing_signals(const RoadShape& roads);

inline constexpr double signal_post_radius_m = 0.04;

/// The direction in which those drive whom a signal is for: +1 along s, −1 against it.
int direction_of(const road::Road& road, const road::Signal& signal);

}  // namespace septet::roadside
