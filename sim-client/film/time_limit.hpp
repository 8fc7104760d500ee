#pragma once
/// How many samples a pixel there is time for: found by trying a few frames of the film, spread over it, on all that will make it.
///
/// A film is taken to need start + frames · (ready + samples · sample): programs start and read the session, make each frame ready,
/// and trace it. Three trials tell the three apart. A tenth of the time is left free, for frames that are dearer than those tried.

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

struct FilmTimes {
  double start_s = 0.0, ready_s = 0.0, sample_s = 0.0;  ///< The last two of one frame, by all machines together.
  double of(std::size_t frames, double samples) const {
    return start_s + static_cast<double>(frames) * (ready_s + samples * sample_s);
  }
};

/// Makes the first of every so many frames with so many samples, to be thrown away; how long that took, s.
using TryFrames = std::function<Expected<double>(std::size_t every, std::uint32_t samples)>;

struct TimeChoice {
  std::uint32_t samples = 1;
  double foretold_s = 0.0;  ///< Of the film, without the trials.
  double tried_s = 0.0;     ///< By the trials.
};

/// As many samples, up to `most`, that `frames` of them, and the trials, take no longer than `limit_s`. Error: one sample takes longer, or a trial
/// has failed.
Expected<TimeChoice> choose_samples(std::size_t frames, double limit_s, std::uint32_t most,
                                    const TryFrames& try_frames);

}  // namespace septet::film
