#include "sim-client/sound/sound_program.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "logging/session_reader.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/sound/session_sound.hpp"
#include "sim-client/sound/wav_file.hpp"

namespace septet::sound {
namespace fs = std::filesystem;
namespace {

constexpr double time_slack_s = 1e-6;
constexpr double ticks_per_second = audio::sample_rate_hz / double(audio::block_samples);
constexpr Tick longest_gap =
    10 * 120;  // Ticks that are missing are heard as the last one, so that what follows keeps its time.

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

struct Made {
  std::uint64_t blocks = 0, bad_numbers = 0;
  bool stopped = false;
};

/// Tick for tick through the stage into the file. The stage is a block late: the first one it gives is left out.
Expected<Made> render_session(const SoundOptions& options, const Span& span, logging::SnapshotCursor cursor,
                              const audio::CarSound& car, const std::vector<audio::EchoBox>& boxes,
                              const road::RoadNetwork& roads, audio::SoundStage& stage, WavFile& file) {
  program::ProgressLine progress;
  audio::State state = audio::start(car, Random(options.seed));
  std::vector<audio::Voice> voices;
  std::vector<float> samples;
  std::optional<Snapshot> before;
  std::optional<road::RoadPosition> place;
  Made made;
  std::uint64_t rendered = 0;
  const auto render = [&](const audio::Heard& heard) -> Expected<void> {
    audio::render(state, heard, voices);
    stage.put(voices, heard.car.tunnel);
    stage.render(samples);
    if (rendered++ == 0) return {};
    ++made.blocks;
    return file.write(samples);
  };
  audio::Heard heard;
  for (;;) {
    if ((made.stopped = program::should_stop())) return made;
    auto next = cursor.next();
    if (!next) return tl::unexpected(next.error());
    if (!*next || (*next)->simulated_time_s >= span.to_s - time_slack_s) break;
    if ((*next)->simulated_time_s >= span.from_s - time_slack_s) {
      const Tick missing = before && (*next)->tick > before->tick ? (*next)->tick - before->tick - 1 : 0;
      heard.car.blow_mps = heard.car.bump_mps = 0.0;
      for (Tick i = 0; rendered > 0 && i < std::min(missing, longest_gap); ++i)
        if (auto done = render(heard); !done) return tl::unexpected(done.error());
      heard = audio::hear(**next, before && missing == 0 ? &*before : nullptr, car, boxes,
                          audio::feel_ground(roads, **next, place, car.wheelbase_m));
      made.bad_numbers += heard.bad_numbers;
      if (auto done = render(heard); !done) return tl::unexpected(done.error());
    }
    before = std::move(**next);
    if (progress.is_due(program::monotonic_s()))
      progress.show(fmt::format("{:.0f} of {:.0f} s", before->simulated_time_s - span.from_s, span.to_s - span.from_s));
  }
  progress.close();
  if (rendered > 0)
    if (auto done = render(heard); !done) return tl::unexpected(done.error());
  return made;
}

}  // namespace

Expected<int> run_sound(SoundOptions options) {
  if (options.out.empty()) options.out = options.session.parent_path() / "drive.wav";
  program::catch_stop_signals();
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  if (session->info().ticks_per_second != ticks_per_second)
    return failure(fmt::format("it has {} ticks a second; sound is made of {}", session->info().ticks_per_second,
                               ticks_per_second),
                   options.session.string(), "give a session that Septet recorded");
  const auto span = span_of(options, *session);
  if (!span) return tl::unexpected(span.error());
  const std::size_t channels = audio::channels_of(options.stage.speakers);
  if ((span->to_s - span->from_s + 1.0) * audio::sample_rate_hz > static_cast<double>(most_frames(channels)))
    return failure("a WAV file cannot be that long", options.out.string(), "make it in parts with --from and --to");
  const auto boxes = echo_boxes_of(*session);
  if (!boxes) return tl::unexpected(boxes.error());
  auto cursor = session->snapshots_from(std::max(0.0, span->from_s - 1.5 / ticks_per_second));
  if (!cursor) return tl::unexpected(cursor.error());
  auto stage = audio::SoundStage::open_loopback(options.stage);
  if (!stage) return tl::unexpected(stage.error());
  auto file = WavFile::create(options.out, channels);
  if (!file) return tl::unexpected(file.error());
  const auto made = render_session(options, *span, std::move(*cursor), car_sound_of(session->info()), *boxes,
                                   roads_of(session->info()), *stage, *file);
  if (!made) return tl::unexpected(made.error());
  if (made->stopped) {
    program::say("septet: stopped; there is no file");
    return program::failed_status;
  }
  if (auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  if (made->bad_numbers > 0)
    program::say(fmt::format("septet: {} numbers of the session are none; they are silent", made->bad_numbers));
  program::announce(fmt::format("{}: {:.2f} s, {}", options.out.string(),
                                static_cast<double>(made->blocks) / ticks_per_second,
                                channels == 2 ? "stereo" : "5.1"));
  return 0;
}

}  // namespace septet::sound
