#pragma once
/// Progress of an experiment's simulated subjects, in words.

#include <cstddef>
#include <string>

namespace septet::server {

struct ExperimentProgress {
  std::size_t finished = 0, subjects = 0;
  double driven_s = 0.0, planned_s = 0.0;  ///< Of all drives, those of earlier runs included.
  double driven_now_s = 0.0, wall_s = 0.0;
};
/// The rest takes at most the time told: drives may end earlier than planned.
std::string text_of(const ExperimentProgress& progress);

}  // namespace septet::server
