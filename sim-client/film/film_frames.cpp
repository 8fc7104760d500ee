#include "sim-client/film/film_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/film_script/film_script.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-client/frame/client_frame.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr double time_slack_s = 1e-6;
constexpr std::size_t longest_script_bytes = 1 << 22;
constexpr std::size_t most_frames = 1'000'000;

Expected<Snapshot> world_at(const logging::SessionReader& session, double instant_s) {
  return SessionInstants::start(session, instant_s).and_then([&](SessionInstants instants) {
    return instants.at(instant_s);
  });
}

/// Eye point of the driver, vehicle frame, from the session's rig.
Vec3 driver_eye_m(const logging::SessionInfo& info) {
  for (const auto& source : info.files)
    if (source.role == "rig")
      if (const auto rig = rig::read_rig(source.content, source.name)) return rig->eye_point_m;
  return scenery::eye_in(vehicle_models().front());
}

/// Anchor of each shot's camera.
Expected<std::vector<Pivot>> find_pivots(const logging::SessionReader& session, const FilmPlan& plan) {
  const auto names = logging::participant_names(session);
  if (!names) return tl::unexpected(names.error());
  const Vec3 eye_m = driver_eye_m(session.info());
  std::vector<Pivot> pivots;
  for (std::size_t n = 0; n < plan.script.shots.size(); ++n) {
    const auto world = world_at(session, plan.script.shots[n].from_s);
    if (!world) return tl::unexpected(world.error());
    const auto pivot = find_pivot(plan.script.shots[n], *world, eye_m, plan.paths[n], *names);
    if (!pivot) return tl::unexpected(pivot.error());
    pivots.push_back(*pivot);
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

/// Waiting place of the camera for a participant that is gone: from the last tick of the shot that holds them. Reads on
/// as instants ascend.
class LastSeen {
 public:
  static Expected<LastSeen> start(const logging::SessionReader& session, const Shot& shot, const Pivot& pivot) {
    const auto world = world_at(session, shot.from_s);
    if (!world) return tl::unexpected(world.error());
    auto cursor = session.snapshots_from(shot.from_s);
    if (!cursor) return tl::unexpected(cursor.error());
    return LastSeen(shot, pivot, std::move(*cursor), viewpoint_at(shot, pivot, *world, {}));
  }

  /// Viewpoint at an instant not before the previous call's.
  Expected<frame::Viewpoint> at(double instant_s) {
    while (!ended_ && (!next_ || next_->simulated_time_s <= instant_s)) {
      if (next_) viewpoint_ = viewpoint_at(*shot_, pivot_, *next_, viewpoint_);
      auto next = cursor_.next();
      if (!next) return tl::unexpected(next.error());
      next_ = std::move(*next);
      ended_ = !next_.has_value();
    }
    return viewpoint_;
  }

 private:
  LastSeen(const Shot& shot, const Pivot& pivot, logging::SnapshotCursor cursor, const frame::Viewpoint& viewpoint)
      : shot_(&shot), pivot_(pivot), cursor_(std::move(cursor)), viewpoint_(viewpoint) {}

  const Shot* shot_;
  Pivot pivot_;
  logging::SnapshotCursor cursor_;
  std::optional<Snapshot> next_;
  frame::Viewpoint viewpoint_;
  bool ended_ = false;
};

}  // namespace

namespace {

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
  std::vector<Pivot> pivots;  ///< Indexed by shot.
  logging::RecordedScene recorded;
  scene::Store store;
  scene::Resolver resolver;
  std::uint32_t width_px, height_px;
  double frames_per_second;
  // Previous frame's reading, reused from here on.
  std::optional<FilmFrame> last{};
  double last_instant_s = 0.0;
  std::optional<SessionInstants> instants{};
  std::optional<LastSeen> last_seen{};
  frame::EffectsDrawing effects{};

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
  auto recorded = logging::RecordedScene::open(*session);
  if (!recorded) return tl::unexpected(recorded.error());
  std::unique_ptr<State> state(new State{std::move(*session), std::move(*plan), std::move(*pivots),
                                         std::move(*recorded), scene::Store(), scene::Resolver(), options.width_px,
                                         options.height_px, options.frames_per_second});
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
  const Pivot& pivot = state.pivots[film_frame.shot];
  const bool follows = state.last && state.last->shot == film_frame.shot && state.last->number <= film_frame.number &&
                       state.last_instant_s <= instant_s + time_slack_s;
  state.last.reset();  // After a read error the next frame starts afresh.
  if (!follows) {
    auto instants = SessionInstants::start(state.session, instant_s);
    if (!instants) return tl::unexpected(instants.error());
    state.instants.emplace(std::move(*instants));
    state.last_seen.reset();
  }
  const auto world = state.instants->at(instant_s);
  if (!world) return tl::unexpected(world.error());
  if (brings_scene)
    if (auto brought = state.bring_scene_to(world->tick); !brought) return tl::unexpected(brought.error());
  frame::Viewpoint waiting;
  if (pivot.participant && !find_participant(*world, *pivot.participant)) {
    if (!state.last_seen) {
      auto last_seen = LastSeen::start(state.session, shot, pivot);
      if (!last_seen) return tl::unexpected(last_seen.error());
      state.last_seen.emplace(std::move(*last_seen));
    }
    const auto seen = state.last_seen->at(instant_s);
    if (!seen) return tl::unexpected(seen.error());
    waiting = *seen;
  }
  auto input = frame::client_frame(*world, views_at(shot, pivot, look, state.width_px, state.height_px),
                                   viewpoint_at(shot, pivot, *world, waiting), state.resolver.scene());
  state.effects.show(*world, state.instants->history(), state.instants->tick_s(), state.resolver.scene());
  state.effects.add_to(input);
  state.last = film_frame, state.last_instant_s = instant_s;
  return input;
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
