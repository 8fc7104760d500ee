#include "sim-client/sound/sound_program.hpp"

#include <span>

#include <fmt/core.h>

#include "logging/session/session_reader.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/soundtrack/session_track.hpp"
#include "sim-client/soundtrack/wav_file.hpp"

namespace septet::sound {
namespace fs = std::filesystem;
namespace {

constexpr double time_slack_s = 1e-6;

struct Span {
  double from_s, to_s;
};

Expected<Span> span_of(const SoundOptions& options, const logging::SessionReader& session) {
  const auto whole = session.shown_span_s();
  if (!whole) return tl::unexpected(whole.error());
  const auto [first_s, last_s] = *whole;
  const Span span{options.from_s.value_or(first_s), options.to_s.value_or(last_s)};
  if (!(span.from_s >= first_s - time_slack_s && span.to_s <= last_s + time_slack_s && span.from_s < span.to_s))
    return failure(fmt::format("from {} to {} s is not a part of the session, which lasts from {:.2f} to {:.2f} s",
                               span.from_s, span.to_s, first_s, last_s),
                   "--from, --to", "choose a beginning and a later end within it");
  return span;
}

}  // namespace

Expected<int> run_sound(SoundOptions options) {
  if (options.out.empty()) options.out = options.session.parent_path() / "drive.wav";
  program::catch_stop_signals();
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  const auto sound = sound_of(*session);
  if (!sound) return tl::unexpected(sound.error());
  const auto span = span_of(options, *session);
  if (!span) return tl::unexpected(span.error());
  const std::size_t channels = audio::channels_of(options.stage.speakers);
  if ((span->to_s - span->from_s + 1.0) * audio::sample_rate_hz > static_cast<double>(most_frames(channels)))
    return failure("a WAV file cannot be that long", options.out.string(), "make it in parts with --from and --to");
  auto file = WavFile::create(options.out, channels);
  if (!file) return tl::unexpected(file.error());
  program::ProgressLine progress;
  const auto made = render_track(
      *session, *sound, {.from_s = span->from_s, .to_s = span->to_s, .stage = options.stage, .seed = options.seed},
      [&](std::span<const float> samples, double tick_s) -> Expected<bool> {
        if (auto written = file->write(samples); !written) return tl::unexpected(written.error());
        if (progress.is_due(program::monotonic_s()))
          progress.show(fmt::format("{:.0f} of {:.0f} s", tick_s - span->from_s, span->to_s - span->from_s));
        return !program::should_stop();
      });
  progress.close();
  if (!made) return tl::unexpected(made.error());
  if (made->stopped) {
    program::say("septet: stopped; there is no file");
    return program::failed_status;
  }
  if (auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  if (made->bad_numbers > 0)
    program::say(fmt::format("septet: {} numbers of the session are not finite; they are silent", made->bad_numbers));
  program::announce(fmt::format("{}: {:.2f} s, {}", options.out.string(),
                                static_cast<double>(made->blocks) / ticks_per_second,
                                channels == 2 ? "stereo" : "5.1"));
  return 0;
}

}  // namespace septet::sound
