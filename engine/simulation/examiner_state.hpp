#pragma once
/// What the examiner remembers from tick to tick (examiner.hpp).

#include <optional>

#include "engine/road/road_position.hpp"

namespace septet::simulation {

struct ExaminerState {
  std::optional<road::RoadPosition> front;  ///< Where the car's front was.
  int lane = 0;                             ///< Of that.
  double limit_mps = 0.0;                   ///< That holds there.
  double entered_s = 0.0;                   ///< When the car came onto the road of a junction that it is on.
};

}  // namespace septet::simulation
