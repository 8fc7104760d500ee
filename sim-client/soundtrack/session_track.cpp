#include "sim-client/soundtrack/session_track.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/audio/ground_feel.hpp"
#include "engine/audio/soundtrack.hpp"

namespace septet::sound {
namespace {

constexpr double time_slack_s = 1e-6;
constexpr Tick longest_gap = 10 * 120;  // Longest gap that is filled, so that later sound keeps its time.

}  // namespace

Expected<SessionSound> sound_of(const logging::SessionReader& session) {
  if (session.info().ticks_per_second != ticks_per_second)
    return failure(
        fmt::format("it has {} ticks a second; sound is made of {}", session.info().ticks_per_second, ticks_per_second),
        "session", "give a session that Septet recorded");
  auto boxes = echo_boxes_of(session);
  if (!boxes) return tl::unexpected(boxes.error());
  return SessionSound{car_sound_of(session.info()), std::move(*boxes), roads_of(session.info())};
}

Expected<TrackMade> render_track(const logging::SessionReader& session, const SessionSound& sound,
                                 const TrackOptions& options, const TakeBlock& take) {
  auto cursor = session.snapshots_from(std::max(0.0, options.from_s - 1.5 / ticks_per_second));
  if (!cursor) return tl::unexpected(cursor.error());
  auto stage = audio::SoundStage::open_loopback(options.stage);
  if (!stage) return tl::unexpected(stage.error());
  audio::State state = audio::start(sound.car, Random(options.seed));
  std::vector<audio::Voice> voices;
  std::vector<float> samples;
  std::optional<Snapshot> before;
  std::optional<road::RoadPosition> place;
  std::optional<double> first_s;
  TrackMade made;
  std::uint64_t rendered = 0;
  // The audio output is a block late: its first block is dropped.
  const auto render = [&](const audio::Heard& heard) -> Expected<bool> {
    audio::render(state, heard, voices);
    stage->put(voices, heard.car.tunnel);
    stage->render(samples);
    if (rendered++ == 0) return true;
    ++made.blocks;
    return take(samples, *first_s + static_cast<double>(made.blocks - 1) / ticks_per_second);
  };
  audio::Heard heard;
  for (;;) {
    auto next = cursor->next();
    if (!next) return tl::unexpected(next.error());
    if (!*next || (*next)->simulated_time_s >= options.to_s - time_slack_s) break;
    if ((*next)->simulated_time_s >= options.from_s - time_slack_s) {
      const Tick missing = before && (*next)->tick > before->tick ? (*next)->tick - before->tick - 1 : 0;
      heard.car.blow_mps = heard.car.bump_mps = 0.0;
      if (!first_s) first_s = (*next)->simulated_time_s;
      Expected<bool> goes_on = true;
      for (Tick i = 0; rendered > 0 && goes_on && *goes_on && i < std::min(missing, longest_gap); ++i)
        goes_on = render(heard);
      heard = audio::hear(**next, before && missing == 0 ? &*before : nullptr, sound.car, sound.boxes,
                          audio::feel_ground(sound.roads, **next, place, sound.car.wheelbase_m));
      made.bad_numbers += heard.bad_numbers;
      if (goes_on && *goes_on) goes_on = render(heard);
      if (!goes_on) return tl::unexpected(goes_on.error());
      if ((made.stopped = !*goes_on)) return made;
    }
    before = std::move(**next);
  }
  if (rendered > 0)
    if (auto goes_on = render(heard); !goes_on) return tl::unexpected(goes_on.error());
  return made;
}

}  // namespace septet::sound
