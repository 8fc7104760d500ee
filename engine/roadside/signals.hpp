#pragma once
/// Signals of a road file as objects with a position, for the scenery that draws them and the cars that run against
/// their posts.
///
/// OpenDRIVE 1.8, §14: zOffset is the lower edge over the road, width and height are the face's. Files also write the
/// height of a light with its pole, and roads' paint as signals of no height. Missing sizes get usual values. Signals
/// at one place hang one above another.

#include <cstdint>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class SignalForm : std::uint8_t {
  none,     ///< Invisible.
  board,    ///< A static sign.
  display,  ///< A changeable sign over the lanes of a motorway.
  light,    ///< Light for vehicles.
  pedestrian_light,
  stop_line,
  waiting_line,  ///< Bars across the lanes that give way.
  arrow,         ///< Paint that points along a lane.
  crossing,      ///< Paint of a crossing: see crossings.hpp.
};

SignalForm form_of(const road::Signal& signal);

struct StandingSignal {
  road::RoadIndex road = 0;
  const road::Signal* signal = nullptr;
  SignalForm form = SignalForm::none;
  RigidTransform world_from_signal;  ///< On the road below the signal; x in the driving direction of its readers.
  double bottom_m = 0.0;             ///< Lower edge of the face, over the road.
  double width_m = 0.6, height_m = 0.6;
  bool has_post = true;  ///< False over lanes that are driven, and under a gantry.
};
/// Boards and lights, in the order of the file.
std::vector<StandingSignal> standing_signals(const RoadShape& roads);

inline constexpr double signal_post_radius_m = 0.04;

/// Driving direction of the traffic that a signal is for: +1 along s, −1 against it.
int direction_of(const road::Road& road, const road::Signal& signal);

}  // namespace septet::roadside
