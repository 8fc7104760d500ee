#include "sim-client/film/film_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/film_script/film_script.hpp"
#include "engine/image/draw.hpp"
#include "engine/scene/resolve.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-client/film/ghosts.hpp"
#include "sim-client/film/last_seen.hpp"
#include "sim-client/film/overlay/overlay_cast.hpp"
#include "sim-client/film/overlay/overlay_drawing.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "sim-client/playback/driver_eye.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr double time_slack_s = 1e-6;
constexpr std::size_t longest_script_bytes = 1 << 22;
constexpr std::size_t most_frames = 1'000'000;
constexpr std::int64_t border_px = 4;  ///< Between two cameras' pictures.

/// Anchors of a shot's cameras.
struct Pivots {
  Pivot first;
  std::optional<Pivot> beside;
};

/// The one direction of a second camera, which holds still.
std::vector<Look> look_beside(const Shot& second) {
  return {{{std::cos(second.heading_rad), std::sin(second.heading_rad)},
           {std::cos(second.pitch_rad), std::sin(second.pitch_rad)}}};
}

/// Anchors of each shot's cameras.
Expected<std::vector<Pivots>> find_pivots(const logging::SessionReader& session, const FilmPlan& plan) {
  const auto names = logging::participant_names(session);
  if (!names) return tl::unexpected(names.error());
  const Vec3 eye_m = playback::driver_eye_m(session.info());
  std::vector<Pivots> pivots;
  for (std::size_t n = 0; n < plan.script.shots.size(); ++n) {
    const auto world = world_at(session, plan.script.shots[n].from_s);
    if (!world) return tl::unexpected(world.error());
    const Shot& shot = plan.script.shots[n];
    const auto pivot = find_pivot(shot, *world, eye_m, plan.paths[n], *names);
    if (!pivot) return tl::unexpected(pivot.error());
    pivots.push_back({*pivot, std::nullopt});
    if (!shot.beside) continue;
    const Shot second = shot_beside(shot);
    const auto beside = find_pivot(second, *world, eye_m, look_beside(second), *names);
    if (!beside) return tl::unexpected(beside.error());
    pivots.back().beside = *beside;
  }
  return pivots;
}

/// Script of the options, or one for the whole session.
Expected<Script> choose_script(const FilmOptions& options, const logging::SessionReader& session,
                               std::pair<double, double> span_s) {
  if (!options.shots.empty()) {
    const auto text = read_regular_file(options.shots, longest_script_bytes);
    if (!text) return tl::unexpected(text.error());
    return read_script(*text, options.shots.string());
  }
  const double from_s = options.from_s.value_or(span_s.first), to_s = options.to_s.value_or(span_s.second);
  if (!(from_s >= span_s.first - time_slack_s && to_s <= span_s.second + time_slack_s && from_s < to_s))
    return failure(fmt::format("from {} to {} s is not a part of the session, which lasts from {:.2f} to {:.2f} s",
                               from_s, to_s, span_s.first, span_s.second),
                   "--from, --to", "choose a beginning and a later end within it");
  Script script = default_script(from_s, to_s, options.frames_per_second);
  const auto world = world_at(session, script.shots.back().from_s);
  if (!world) return tl::unexpected(world.error());
  if (world->participants.size() < 2 && script.shots.size() > 1) script.shots.pop_back();
  return script;
}

/// Direction between two frames of a camera that turns evenly.
Look between(const Look& from, const Look& to, double share) {
  const auto mixed = [share](const auto& a, const auto& b) {
    const double x = (1.0 - share) * a[0] + share * b[0], y = (1.0 - share) * a[1] + share * b[1],
                 length = std::hypot(x, y);
    return length > 0.0 ? UnitVector<double, 2>{x / length, y / length} : a;
  };
  return {mixed(from.heading, to.heading), mixed(from.pitch, to.pitch)};
}

}  // namespace

struct FilmFrames::State {
  logging::SessionReader session;
  FilmPlan plan;
  std::vector<Pivots> pivots;  ///< Indexed by shot.
  logging::RecordedScene recorded;
  Ghosts ghosts;
  scene::Store store;
  scene::Resolver resolver;
  std::uint32_t width_px, height_px;
  double frames_per_second;
  // Previous frame's reading, reused from here on.
  std::optional<FilmFrame> last{};
  double last_instant_s = 0.0;
  std::optional<playback::SessionInstants> instants{};
  std::optional<LastSeen> last_seen{}, last_seen_beside{};
  frame::EffectsDrawing effects{};
  OverlayCast cast{};
  // Of the last frame, for its overlay and its second camera.
  Snapshot world{};
  std::vector<instant::FrameView> views{};

  Expected<frame::Viewpoint> viewpoint(const Shot& shot, const Pivot& pivot, std::optional<LastSeen>& seen_last,
                                       double instant_s);

  /// Brings the scene to a tick, later or earlier than before.
  Expected<void> bring_scene_to(Tick tick) {
    if (recorded.is_past(tick)) {
      store = scene::Store();
      recorded.begin_anew();
      resolver.forget();
    }
    auto done = recorded.advance(tick, store);
    resolver.update(store);
    return done;
  }
};

/// Viewpoint in the last frame's world.
Expected<frame::Viewpoint> FilmFrames::State::viewpoint(const Shot& shot, const Pivot& pivot,
                                                        std::optional<LastSeen>& seen_last, double instant_s) {
  frame::Viewpoint waiting;
  if (pivot.participant && !find_participant(world, *pivot.participant)) {
    if (!seen_last) {
      auto started = LastSeen::start(session, shot, pivot);
      if (!started) return tl::unexpected(started.error());
      seen_last.emplace(std::move(*started));
    }
    const auto seen = seen_last->at(instant_s);
    if (!seen) return tl::unexpected(seen.error());
    waiting = *seen;
  }
  return viewpoint_at(shot, pivot, world, waiting);
}

FilmFrames::FilmFrames(std::unique_ptr<State> state) : state_(std::move(state)) {}
FilmFrames::FilmFrames(FilmFrames&&) noexcept = default;
FilmFrames& FilmFrames::operator=(FilmFrames&&) noexcept = default;
FilmFrames::~FilmFrames() = default;

const FilmPlan& FilmFrames::plan() const { return state_->plan; }
const scene::ResolvedScene& FilmFrames::scene() const { return state_->resolver.scene(); }
const logging::SessionInfo& FilmFrames::session() const { return state_->session.info(); }

Expected<FilmFrames> FilmFrames::open(const FilmOptions& options) {
  auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  const auto span_s = session->shown_span_s();
  if (!span_s) return tl::unexpected(span_s.error());
  auto script = choose_script(options, *session, *span_s);
  if (!script) return tl::unexpected(script.error());
  auto plan = plan_film(std::move(*script), options.frames_per_second, *span_s);
  if (!plan) return tl::unexpected(plan.error());
  std::erase_if(plan->frames, [&](const FilmFrame& frame) {
    return (frame.number - 1) % options.every != 0 ||
           !(frame.instant_s >= options.from_s.value_or(frame.instant_s) - time_slack_s &&
             frame.instant_s <= options.to_s.value_or(frame.instant_s) + time_slack_s);
  });
  if (plan->frames.empty())
    return failure("the film shows nothing between them", "--from, --to", "choose them within the script's shots");
  auto pivots = find_pivots(*session, *plan);
  if (!pivots) return tl::unexpected(pivots.error());
  auto cast = OverlayCast::of(*session, plan->script);
  if (!cast) return tl::unexpected(cast.error());
  auto recorded = logging::RecordedScene::open(*session);
  if (!recorded) return tl::unexpected(recorded.error());
  auto ghosts = Ghosts::open(options.ghosts, session->info());
  if (!ghosts) return tl::unexpected(ghosts.error());
  std::unique_ptr<State> state(new State{std::move(*session), std::move(*plan), std::move(*pivots),
                                         std::move(*recorded), std::move(*ghosts), scene::Store(), scene::Resolver(),
                                         options.width_px, options.height_px, options.frames_per_second});
  state->cast = std::move(*cast);
  std::size_t ghosts_named = 0;
  if (state->cast.font)
    for (const ParticipantId driver : state->ghosts.drivers())
      if (ghosts_named < most_ghosts_named)
        state->cast.people.push_back({driver, fmt::format("ghost {}", ++ghosts_named)});
  if (auto begun = state->bring_scene_to(0); !begun) return tl::unexpected(begun.error());
  return FilmFrames(std::move(state));
}

Expected<instant::FrameInput> FilmFrames::input_of(const FilmFrame& film_frame) {
  return input_at(film_frame, film_frame.instant_s, state_->plan.paths[film_frame.shot][film_frame.number_in_shot],
                  true);
}

Expected<std::optional<instant::FrameInput>> FilmFrames::input_as_shutter_closes(const FilmFrame& film_frame) {
  const Shot& shot = state_->plan.script.shots[film_frame.shot];
  if (!(shot.shutter_rad > 0.0)) return std::nullopt;
  return input_after(film_frame, shot.shutter_rad / (2.0 * std::numbers::pi));
}

Expected<instant::FrameInput> FilmFrames::input_of_next(const FilmFrame& film_frame) {
  return input_after(film_frame, 1.0);
}

Expected<instant::FrameInput> FilmFrames::input_after(const FilmFrame& film_frame, double share) {
  const Shot& shot = state_->plan.script.shots[film_frame.shot];
  const double instant_s = std::min(film_frame.instant_s + share * shot.speed / state_->frames_per_second, shot.to_s);
  const std::vector<Look>& path = state_->plan.paths[film_frame.shot];
  const Look &from = path[film_frame.number_in_shot],
             &to = path[std::min(film_frame.number_in_shot + 1, path.size() - 1)];
  return input_at(film_frame, instant_s, between(from, to, share), false);
}

Expected<instant::FrameInput> FilmFrames::input_at(const FilmFrame& film_frame, double instant_s, const Look& look,
                                                   bool brings_scene) {
  State& state = *state_;
  const Shot& shot = state.plan.script.shots[film_frame.shot];
  const Pivot& pivot = state.pivots[film_frame.shot].first;
  const bool follows = state.last && state.last->shot == film_frame.shot && state.last->number <= film_frame.number &&
                       state.last_instant_s <= instant_s + time_slack_s;
  state.last.reset();  // After a read error the next frame starts afresh.
  if (!follows) {
    auto instants = playback::SessionInstants::start(state.session, instant_s);
    if (!instants) return tl::unexpected(instants.error());
    state.instants.emplace(std::move(*instants));
    state.last_seen.reset(), state.last_seen_beside.reset();
    state.ghosts.begin_shot();
  }
  auto world = state.instants->at(instant_s);
  if (!world) return tl::unexpected(world.error());
  state.world = std::move(*world);
  if (brings_scene)
    if (auto brought = state.bring_scene_to(state.world.tick); !brought) return tl::unexpected(brought.error());
  if (auto added = state.ghosts.add_to(state.world, instant_s); !added) return tl::unexpected(added.error());
  const auto viewpoint = state.viewpoint(shot, pivot, state.last_seen, instant_s);
  if (!viewpoint) return tl::unexpected(viewpoint.error());
  const std::uint32_t width_px = shot.beside ? state.width_px / 2 : state.width_px;
  auto input = frame::client_frame(state.world, views_at(shot, pivot, look, width_px, state.height_px), *viewpoint,
                                   state.resolver.scene());
  state.views = {input.views.front()};
  state.effects.show(state.world, state.instants->history(), state.instants->tick_s(), state.resolver.scene());
  state.effects.add_to(input);
  state.last = film_frame, state.last_instant_s = instant_s;
  return input;
}

Expected<std::optional<instant::FrameInput>> FilmFrames::input_beside(const FilmFrame& film_frame) {
  State& state = *state_;
  const Shot& shot = state.plan.script.shots[film_frame.shot];
  if (!shot.beside) return std::nullopt;
  SEPTET_CHECK(state.last && state.last->number == film_frame.number, "frame {}", film_frame.number);
  const Shot second = shot_beside(shot);
  const Pivot& pivot = *state.pivots[film_frame.shot].beside;
  const auto viewpoint = state.viewpoint(second, pivot, state.last_seen_beside, film_frame.instant_s);
  if (!viewpoint) return tl::unexpected(viewpoint.error());
  const std::uint32_t left_px = state.width_px / 2;
  auto views = views_at(second, pivot, look_beside(second).front(), state.width_px - left_px, state.height_px);
  for (instant::FrameView& view : views.views) view.viewport.x += static_cast<std::int32_t>(left_px);
  auto input = frame::client_frame(state.world, views, *viewpoint, state.resolver.scene());
  state.views.resize(1);
  state.views.push_back(input.views.front());
  state.effects.add_to(input);
  return input;
}

void FilmFrames::draw_over(const FilmFrame& film_frame, image::Image& picture) const {
  const State& state = *state_;
  const Shot& shot = state.plan.script.shots[film_frame.shot];
  if (shot.beside) image::fill(picture, (picture.width - border_px) / 2, 0, border_px, picture.height, {0, 0, 0, 255});
  if (!shot.overlay || !state.cast.font) return;
  const OverlayMoment moment{.script = state.plan.script,
                             .shot = shot,
                             .world = state.world,
                             .people = state.cast.people,
                             .ways = state.cast.ways,
                             .views = state.views,
                             .width_px = picture.width,
                             .height_px = picture.height};
  draw(overlay_content(moment, *state.cast.font), *state.cast.font, picture);
}

Expected<FilmPlan> plan_film(Script script, double frames_per_second, std::pair<double, double> span_s) {
  FilmPlan plan;
  for (std::size_t n = 0; n < script.shots.size(); ++n) {
    const Shot& shot = script.shots[n];
    if (shot.from_s < span_s.first - time_slack_s || shot.to_s > span_s.second + time_slack_s)
      return failure(fmt::format("it shows {} to {} s, and the session lasts from {:.2f} to {:.2f} s", shot.from_s,
                                 shot.to_s, span_s.first, span_s.second),
                     shot.where, "choose instants within the session");
    if (!((shot.to_s - shot.from_s) / shot.speed * frames_per_second <
          static_cast<double>(most_frames - plan.frames.size())))
      return failure(fmt::format("with it the film has more than {} frames", most_frames), shot.where,
                     "split the film");
    auto path = camera_path(shot, frames_per_second);
    if (!path) return tl::unexpected(path.error());
    for (std::size_t in_shot = 0; in_shot < path->size(); ++in_shot)
      plan.frames.push_back({plan.frames.size() + 1, n, in_shot,
                             shot.from_s + static_cast<double>(in_shot) * shot.speed / frames_per_second});
    plan.paths.push_back(std::move(*path));
  }
  plan.script = std::move(script);
  return plan;
}

}  // namespace septet::film
