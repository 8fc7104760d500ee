#include "sim-client/film/film.hpp"

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/film_script/film_script.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "logging/recorded_scene.hpp"
#include "sim-client/film/camera.hpp"
#include "sim-client/film/session_instants.hpp"
#include "sim-client/frame/effects_drawing.hpp"
#include "sim-client/frame/picture_writer.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr double time_slack_s = 1e-6;
constexpr std::size_t longest_script_bytes = 1 << 22;
constexpr std::size_t most_frames = 1'000'000;

Expected<std::pair<double, double>> span_of(const logging::SessionReader& session, const fs::path& file) {
  const auto span = session.time_span_s();
  if (!span) return tl::unexpected(span.error());
  if (!*span) return failure("the session holds no tick", file.string(), "record a longer drive");
  return **span;
}

Expected<Snapshot> world_at(const logging::SessionReader& session, double instant_s) {
  return SessionInstants::start(session, instant_s).and_then([&](SessionInstants instants) {
    return instants.at(instant_s);
  });
}

/// Where the driver's eyes were: in the rig that was driven with, which the session holds.
Vec3 driver_eye_m(const logging::SessionInfo& info) {
  for (const auto& source : info.files)
    if (source.role == "rig")
      if (const auto rig = rig::read_rig(source.content, source.name)) return rig->eye_point_m;
  return frame::eye_in(vehicle_models().front());
}

/// Nothing that is in the folder for the pictures is touched.
Expected<void> check_is_free(const fs::path& out) {
  std::error_code error;
  if (fs::exists(out, error) && !(fs::is_directory(out, error) && fs::is_empty(out, error)))
    return failure("it is there already and not an empty folder", out.string(), "choose a new folder with --out");
  return {};
}

Expected<void> make_folder(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error) return failure(error.message(), out.string(), "choose a folder that can be written with --out");
  return {};
}

/// What each shot's camera hangs on.
Expected<std::vector<Pivot>> find_pivots(const logging::SessionReader& session, const FilmPlan& plan) {
  const Vec3 eye_m = driver_eye_m(session.info());
  std::vector<Pivot> pivots;
  for (std::size_t n = 0; n < plan.script.shots.size(); ++n) {
    const auto world = world_at(session, plan.script.shots[n].from_s);
    if (!world) return tl::unexpected(world.error());
    const auto pivot = find_pivot(plan.script.shots[n], *world, eye_m, plan.paths[n]);
    if (!pivot) return tl::unexpected(pivot.error());
    pivots.push_back(*pivot);
  }
  return pivots;
}

/// What stays from frame to frame.
class Studio {
 public:
  Studio(const logging::SessionReader& session, const FilmOptions& options, std::vector<Pivot> pivots,
         render::Renderer renderer, scene::ResolvedScene scene)
      : session_(session),
        options_(options),
        pivots_(std::move(pivots)),
        renderer_(std::move(renderer)),
        scene_(std::move(scene)) {}

  Expected<void> upload() { return renderer_.upload(scene_); }
  Expected<void> draw(const FilmPlan& plan, const FilmFrame& film_frame);
  Expected<void> finish() { return pictures_.finish(); }

 private:
  Expected<void> begin_shot(const Shot& shot, const Pivot& pivot);

  const logging::SessionReader& session_;
  const FilmOptions& options_;
  std::vector<Pivot> pivots_;  ///< By shot.
  render::Renderer renderer_;
  scene::ResolvedScene scene_;
  std::optional<std::size_t> shot_;
  std::optional<SessionInstants> instants_;
  frame::Viewpoint viewpoint_;
  frame::EffectsDrawing effects_;
  frame::PictureWriter pictures_;
};

Expected<void> Studio::begin_shot(const Shot& shot, const Pivot& pivot) {
  auto instants = SessionInstants::start(session_, shot.from_s);
  if (!instants) return tl::unexpected(instants.error());
  instants_.emplace(std::move(*instants));
  const auto world = instants_->at(shot.from_s);
  if (!world) return tl::unexpected(world.error());
  viewpoint_ = viewpoint_at(shot, pivot, *world, {});
  return {};
}

Expected<void> Studio::draw(const FilmPlan& plan, const FilmFrame& film_frame) {
  const Shot& shot = plan.script.shots[film_frame.shot];
  const Pivot& pivot = pivots_[film_frame.shot];
  if (shot_ != film_frame.shot)
    if (auto begun = begin_shot(shot, pivot); !begun) return begun;
  shot_ = film_frame.shot;
  const auto world = instants_->at(film_frame.instant_s);
  if (!world) return tl::unexpected(world.error());
  viewpoint_ = viewpoint_at(shot, pivot, *world, viewpoint_);
  const Look& look = plan.paths[film_frame.shot][film_frame.number_in_shot];
  const auto views = views_at(shot, pivot, look, options_.width_px, options_.height_px);
  auto input = frame::client_frame(*world, views, viewpoint_, scene_);
  effects_.show(*world, instants_->history(), instants_->tick_s(), scene_);
  effects_.add_to(input);
  if (auto drawn = renderer_.draw(std::move(input)); !drawn) return drawn;
  auto picture = renderer_.read_back();
  if (!picture) return tl::unexpected(picture.error());
  return pictures_.write(options_.out / fmt::format("{:06}.png", film_frame.number), std::move(*picture));
}

/// The script of the options, or one for the whole session.
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

}  // namespace

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

Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on) {
  if (auto is_free = check_is_free(options.out); !is_free) return tl::unexpected(is_free.error());
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  const auto span_s = span_of(*session, options.session);
  if (!span_s) return tl::unexpected(span_s.error());
  auto script = choose_script(options, *session, *span_s);
  if (!script) return tl::unexpected(script.error());
  auto plan = plan_film(std::move(*script), options.frames_per_second, *span_s);
  if (!plan) return tl::unexpected(plan.error());
  std::erase_if(plan->frames, [&](const FilmFrame& frame) {
    return !(frame.instant_s >= options.from_s.value_or(frame.instant_s) - time_slack_s &&
             frame.instant_s <= options.to_s.value_or(frame.instant_s) + time_slack_s);
  });
  if (plan->frames.empty())
    return failure("the film shows nothing between them", "--from, --to", "choose them within the script's shots");

  auto pivots = find_pivots(*session, *plan);
  if (!pivots) return tl::unexpected(pivots.error());

  scene::Store store;
  if (auto restored = logging::restore_scene(*session, store); !restored) return tl::unexpected(restored.error());
  render::RendererOptions target;
  target.width = options.width_px;
  target.height = options.height_px;
  if (options.software) target.device = render::DevicePreference::software;
  auto renderer = render::Renderer::create(target);
  if (!renderer) return tl::unexpected(renderer.error());
  Studio studio(*session, options, std::move(*pivots), std::move(*renderer), scene::resolve(store));
  if (auto uploaded = studio.upload(); !uploaded) return tl::unexpected(uploaded.error());
  if (auto folder = make_folder(options.out); !folder) return tl::unexpected(folder.error());
  FilmMade made{0, plan->frames.size()};
  while (made.frames < made.planned && go_on(made)) {
    if (auto drawn = studio.draw(*plan, plan->frames[made.frames]); !drawn) return tl::unexpected(drawn.error());
    ++made.frames;
  }
  if (auto written = studio.finish(); !written) return tl::unexpected(written.error());
  return made;
}

}  // namespace septet::film
