#pragma once
/// The examiner's memory from tick to tick (examiner.hpp).

#include <optional>

#include "engine/road/road_position.hpp"

namespace septet::simulation {

struct ExaminerState {
  std::optional<road::RoadPosition> front;  ///< Last position of the car's front.
  int lane = 0;                             ///< Lane of that position.
  double limit_mps = 0.0;                   ///< Speed limit there.
  double entered_s = 0.0;                   ///< Time at which the car entered its present road of a junction.
};

}  // namespace septet::simulation
