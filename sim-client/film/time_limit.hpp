#pragma once
/// Samples a pixel that fit into a time limit: found by trying a few frames of the film, spread over it, on all
/// machines that will make it.
///
/// Model: time = start + frames · (ready + samples · sample), for starting and reading the session, preparing each
/// frame, and tracing it. Three trials separate the three terms. A tenth of the time is left free, for frames dearer
/// than those tried.

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

struct FilmTimes {
  double start_s = 0.0, ready_s = 0.0, sample_s = 0.0;  ///< The last two for one frame, by all machines together.
  double of(std::size_t frames, double samples) const {
    return start_s + static_cast<double>(frames) * (ready_s + samples * sample_s);
  }
};

/// Draws every n-th frame with this many samples, and discards the pictures; returns the time, s.
using TryFrames = std::function<Expected<double>(std::size_t every, std::uint32_t samples)>;

struct TimeChoice {
  std::uint32_t samples = 1;
  double foretold_s = 0.0;  ///< Predicted time of the film, without the trials.
  double tried_s = 0.0;     ///< Time of the trials.
};

/// Largest number of samples, up to `most`, for which `frames` frames and the trials take no longer than `limit_s`.
/// Error: one sample takes longer, or a trial has failed.
Expected<TimeChoice> choose_samples(std::size_t frames, double limit_s, std::uint32_t most,
                                    const TryFrames& try_frames);

}  // namespace septet::film
