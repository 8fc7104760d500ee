#include "sim-client/film/time_limit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace septet::film {
namespace {

constexpr std::size_t frames_tried = 4;
constexpr double used = 0.9;  ///< Share of the time limit.
/// More samples are tried until a trial takes the first share of the time; a trial that would take more than the second
/// is skipped.
constexpr double enough_tried = 0.03, most_tried = 0.1;

struct Trial {
  std::size_t frames = 0;
  std::uint32_t samples = 0;
  double took_s = 0.0;
};

/// Times of the model, from three trials: one frame and some frames with one sample, and the same frames with more.
FilmTimes times_of(const Trial& one, const Trial& some, const Trial& more) {
  const auto frames = static_cast<double>(some.frames);
  FilmTimes times;
  times.sample_s =
      more.samples > 1 ? std::max(0.0, (more.took_s - some.took_s) / (frames * (more.samples - 1.0))) : 0.0;
  const double frame_s = some.frames > one.frames
                             ? std::max(0.0, (some.took_s - one.took_s) / (frames - static_cast<double>(one.frames)))
                             : times.sample_s;
  times.ready_s = std::max(0.0, frame_s - times.sample_s);
  times.start_s = std::max(0.0, one.took_s - times.ready_s - times.sample_s);
  return times;
}

}  // namespace

Expected<TimeChoice> choose_samples(std::size_t frames, double limit_s, std::uint32_t most,
                                    const TryFrames& try_frames) {
  const std::size_t every = (frames + frames_tried - 1) / frames_tried;
  TimeChoice choice;
  const auto attempt = [&](std::size_t of, std::uint32_t samples) -> Expected<Trial> {
    const auto took_s = try_frames(of, samples);
    if (!took_s) return tl::unexpected(took_s.error());
    choice.tried_s += *took_s;
    return Trial{(frames + of - 1) / of, samples, *took_s};
  };
  const auto one = attempt(frames, 1);
  if (!one) return tl::unexpected(one.error());
  const auto some = every < frames ? attempt(every, 1) : one;
  if (!some) return tl::unexpected(some.error());
  Trial more = *some;
  while (more.samples < most && (more.samples == 1 || more.took_s - some->took_s < enough_tried * limit_s)) {
    // First four times as many; then the number predicted to be enough, so that the clock's own noise does not count.
    const double per_sample_s = times_of(*one, *some, more).sample_s * static_cast<double>(some->frames);
    const double wanted = more.samples == 1 ? 4.0
                          : per_sample_s > 0.0
                              ? std::min(16.0 * more.samples, 1.5 * enough_tried * limit_s / per_sample_s)
                              : 16.0 * more.samples;
    const auto samples = static_cast<std::uint32_t>(std::clamp(wanted, more.samples + 1.0, static_cast<double>(most)));
    if (choice.tried_s + some->took_s + per_sample_s * samples > most_tried * limit_s && more.samples > 1) break;
    const auto next = attempt(every, samples);
    if (!next) return tl::unexpected(next.error());
    more = *next;
  }
  const FilmTimes times = times_of(*one, *some, more);
  const double left_s = used * (limit_s - choice.tried_s);
  if (!(times.of(frames, 1.0) <= left_s))
    return failure(fmt::format("one sample a pixel takes about {:.0f} s, and {:.0f} s are left of {:.0f}",
                               times.of(frames, 1.0), std::max(0.0, limit_s - choice.tried_s), limit_s),
                   "--within", "allow more time, or draw fewer frames (--fps) or smaller ones (--size)");
  const double samples = (left_s - times.of(frames, 0.0)) / (static_cast<double>(frames) * times.sample_s);
  choice.samples = samples < most ? std::max(1u, static_cast<std::uint32_t>(samples)) : most;
  choice.foretold_s = times.of(frames, choice.samples);
  return choice;
}

}  // namespace septet::film
