#include "sim-client/film/film.hpp"

#include <optional>
#include <vector>

#include <fmt/core.h>

#include "engine/render/renderer.hpp"
#include "sim-client/film/drawn_frame.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/film/traced/master.hpp"
#include "sim-client/frame/picture_writer.hpp"
#include "sim-client/soundtrack/cut_track.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

/// Draws the frames that are missing, until all are there or `go_on` returns false.
Expected<void> rasterise(const FilmOptions& options, FilmFrames& frames, render::Renderer& rasteriser,
                         const FilmFolder& folder, FilmMade& made, const std::function<bool(const FilmMade&)>& go_on) {
  frame::PictureWriter pictures;
  for (const FilmFrame& frame : frames.plan().frames) {
    if (!go_on(made)) break;
    if (options.resume && folder.has(frame.number, options)) {
      ++made.frames, ++made.kept;
      continue;
    }
    auto picture = draw_frame(frames, frame, rasteriser);
    if (!picture) return tl::unexpected(picture.error());
    if (auto queued = pictures.write(folder.picture(frame.number), std::move(*picture)); !queued) return queued;
    ++made.frames;
  }
  return pictures.finish();
}

/// Makes the film's sound: for each shot, the stretch of the session's sound that belongs to its frames.
Expected<bool> make_sound(const FilmOptions& options, const FilmPlan& plan, const fs::path& file,
                          const std::function<bool()>& go_on) {
  std::vector<sound::Cut> cuts;
  std::optional<std::size_t> shot;
  for (const FilmFrame& frame : plan.frames) {
    if (shot != frame.shot)
      cuts.push_back({.from_s = frame.instant_s, .speed = plan.script.shots[frame.shot].speed, .frames = 0});
    shot = frame.shot;
    ++cuts.back().frames;
  }
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  std::error_code ignored;
  fs::remove(file, ignored);  // File of a stopped film.
  auto heard = sound::write_cut_track(*session, cuts, options.frames_per_second / options.every, file, go_on);
  if (!heard) heard.error().remedy += "; or make it without: --no-sound";
  return heard;
}

}  // namespace

Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on,
                             Machines* others) {
  const bool traced = options.renderer == FilmRenderer::traced;
  if (others && !traced)
    return failure("mpirun shares out what is traced alone", "--renderer raster",
                   "add --renderer traced, or leave mpirun out");
  if (others && !options.ghosts.empty())
    return failure("a film with ghosts is traced by one program", "--ghost", "leave mpirun, --ranks and --hosts out");
  if (!traced && options.exr != ExrNumbers::none)
    return failure("only what is traced has OpenEXR pictures", "--exr", "add --renderer traced, or leave --exr out");
  if (options.exr == ExrNumbers::none && !options.layers.empty())
    return failure("layers lie in OpenEXR pictures alone", "--layers", "add --exr half, or leave --layers out");
  if (!traced && options.error > 0.0)
    return failure("only what is traced has an error", "--error", "add --renderer traced, or leave --error out");
  if (options.denoise && !traced)
    return failure("only what is traced has noise", "--denoise", "add --renderer traced, or leave --denoise out");
  if (options.denoise && options.samples < 2)
    return failure("one sample does not tell its noise", "--denoise",
                   "take two samples a pixel or more with --samples");
  const auto is_file = is_film_file(options.out);
  if (!is_file) return tl::unexpected(is_file.error());
  const auto found_in = pictures_folder(options.out);
  if (!found_in) return tl::unexpected(found_in.error());
  const fs::path& pictures_in = *found_in;
  fs::path ffmpeg;
  if (*is_file) {
    std::error_code error;
    if (fs::exists(options.out, error))
      return failure("it is there already", options.out.string(), "choose another name with --out");
    const auto found = find_ffmpeg();
    if (!found) return tl::unexpected(found.error());
    ffmpeg = *found;
  }
  if (auto is_free = FilmFolder::check_is_free(pictures_in, options.resume); !is_free)
    return tl::unexpected(is_free.error());
  auto frames = FilmFrames::open(options);
  if (!frames) return tl::unexpected(frames.error());
  const auto record = film_record(options, frames->session());
  if (!record) return tl::unexpected(record.error());
  std::optional<render::Renderer> rasteriser;
  if (!traced) {
    auto created = make_rasteriser(options, frames->scene());
    if (!created) return tl::unexpected(created.error());
    rasteriser.emplace(std::move(*created));
  }
  const auto folder = FilmFolder::open(pictures_in, *record, options.resume);
  if (!folder) return tl::unexpected(folder.error());
  FilmMade made{.planned = frames->plan().frames.size()};
  if (frames->scene().prototypes.empty())
    made.notice = fmt::format(
        "{}: it keeps no scene, so the pictures show no road and nobody; take a session that "
        "septet drive recorded",
        options.session.string());
  const auto drawn = traced ? trace_film(options, *frames, *folder, others, made, go_on)
                            : rasterise(options, *frames, *rasteriser, *folder, made, go_on);
  if (!drawn) return tl::unexpected(drawn.error());
  made.stopped = made.frames < made.planned;
  if (!*is_file || made.stopped) return made;
  std::vector<fs::path> pictures;
  for (const FilmFrame& frame : frames->plan().frames) pictures.push_back(folder->picture(frame.number));
  made.encoding = true;
  fs::path sound;
  if (options.sound) {
    sound = pictures_in / "sound.wav";
    const auto heard = make_sound(options, frames->plan(), sound, [&] { return go_on(made); });
    if (!heard) return tl::unexpected(heard.error());
    if ((made.stopped = !*heard)) return made;
  }
  const auto whole = encode_film(ffmpeg, pictures, sound, options.frames_per_second / options.every, options.out,
                                 [&] { return go_on(made); });
  if (!whole) return tl::unexpected(whole.error());
  made.stopped = !*whole;
  std::error_code ignored;
  if (*whole && options.exr == ExrNumbers::none && !options.keep_pictures) fs::remove_all(pictures_in, ignored);
  return made;
}

}  // namespace septet::film
