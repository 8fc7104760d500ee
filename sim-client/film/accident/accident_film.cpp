#include "sim-client/film/accident/accident_film.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/text_file.hpp"
#include "engine/film_script/script_text.hpp"
#include "engine/image/png.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/film/accident/accident_page.hpp"
#include "sim-client/film/accident/manifest.hpp"
#include "sim-client/film/accident/narration.hpp"
#include "sim-client/film/accident/read_plan.hpp"
#include "sim-client/film/accident/subtitles.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_program.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_storyboard_bytes = std::size_t{1} << 20;

std::string storyboard_text(const AccidentPlan& plan) {
  return fmt::format("# {}\n# septet film --shots films it; sim-client/film/FILM.md explains the keys.\n{}", plan.title,
                     text_of(plan.script));
}

/// The folder is free, or with `resume` holds the unfinished film of this storyboard.
Expected<void> check_folder(const fs::path& folder, const std::string& storyboard, bool resume) {
  std::error_code error;
  if (!fs::exists(folder, error) || (fs::is_directory(folder, error) && fs::is_empty(folder, error))) return {};
  if (!resume)
    return failure("it is there already and not an empty folder", folder.string(),
                   "choose a new folder with --out, or add --resume to go on with a film that was stopped");
  if (fs::exists(folder / manifest_name, error))
    return failure("the film there is whole already", folder.string(), "choose a new folder with --out");
  const auto begun = read_regular_file(folder / script_name, longest_storyboard_bytes);
  if (!begun) return tl::unexpected(begun.error());
  if (*begun == storyboard) return {};
  return failure("another film was begun there", (folder / script_name).string(),
                 "give the same session and options as then, or choose a new folder with --out");
}

/// Draws and encodes; false: a person stopped it.
Expected<bool> film_plan(const FilmOptions& options) {
  program::catch_stop_signals();
  program::ProgressLine progress;
  const double begun_s = program::monotonic_s();
  std::string noticed;
  const auto made = make_film(options, [&](const FilmMade& so_far) {
    if (so_far.notice != noticed) progress.message("septet: " + (noticed = so_far.notice));
    if (progress.is_due(program::monotonic_s())) progress.show(progress_text(so_far, program::monotonic_s() - begun_s));
    return !program::should_stop();
  });
  progress.close();
  if (!made) return tl::unexpected(made.error());
  return !made->stopped;
}

/// Frame of each shot that tells most: at the contact, else in its middle.
std::vector<FilmFrame> telling_frames(const FilmPlan& film) {
  std::vector<FilmFrame> frames;
  for (std::size_t n = 0; n < film.script.shots.size(); ++n) {
    const Shot& shot = film.script.shots[n];
    const double contact_s = film.script.overlay.contact_s.value_or(-1.0);
    const double told_s =
        contact_s >= shot.from_s && contact_s < shot.to_s ? contact_s : 0.5 * (shot.from_s + shot.to_s);
    const FilmFrame* best = nullptr;
    for (const FilmFrame& frame : film.frames)
      if (frame.shot == n && (!best || std::abs(frame.instant_s - told_s) < std::abs(best->instant_s - told_s)))
        best = &frame;
    if (best) frames.push_back(*best);
  }
  return frames;
}

std::vector<Spoken> spoken_words(const FilmPlan& film, const AccidentPlan& plan, double frames_per_second) {
  std::vector<Spoken> spoken;
  for (const FilmFrame& frame : film.frames) {
    const double at_s = static_cast<double>(frame.number - 1) / frames_per_second;
    if (frame.number_in_shot == 0) spoken.push_back({at_s, at_s, plan.words[frame.shot]});
    spoken.back().to_s = at_s + 1.0 / frames_per_second;
  }
  return spoken;
}

/// Everything beside the film: subtitles, stills, page, manifest.
Expected<void> write_beside(const FilmOptions& film_options, const std::string& voice, const fs::path& folder,
                            const logging::SessionReader& session, const PlannedAccident& planned) {
  const auto span_s = session.shown_span_s();
  if (!span_s) return tl::unexpected(span_s.error());
  const auto film = plan_film(planned.plan.script, film_options.frames_per_second, *span_s);
  if (!film) return tl::unexpected(film.error());
  const auto pictures_in = pictures_folder(film_options.out);
  if (!pictures_in) return tl::unexpected(pictures_in.error());
  const auto picture = [&](const FilmFrame& frame) { return *pictures_in / fmt::format("{:06}.png", frame.number); };
  std::vector<std::string> files{film_name, script_name, subtitles_name, page_name}, pictures;
  std::vector<Still> stills;
  for (const FilmFrame& frame : telling_frames(*film)) {
    stills.push_back({fmt::format("still-{}.png", frame.shot + 1), frame.instant_s, frame.shot});
    std::error_code error;
    fs::copy_file(picture(frame), folder / stills.back().file, fs::copy_options::overwrite_existing, error);
    if (error) return failure(error.message(), (folder / stills.back().file).string(), "make room on the disk");
    files.push_back(stills.back().file);
  }
  for (const FilmFrame& frame : film->frames) {
    const auto read = image::read_png(picture(frame));
    if (!read) return tl::unexpected(read.error());
    pictures.push_back(hash_text(*read));
  }
  const auto spoken = spoken_words(*film, planned.plan, film_options.frames_per_second);
  const std::string srt = subtitles(spoken);
  if (!voice.empty())
    if (auto narrated = narrate(film_options.out, film_options.sound, spoken, voice); !narrated) return narrated;
  const std::string page = accident_page(planned.facts, planned.plan, stills, film_name, version_text());
  for (const auto& [name, text] : {std::pair{subtitles_name, &srt}, std::pair{page_name, &page}})
    if (auto written = document::write_text_file(folder / name, *text); !written) return written;
  const auto json =
      manifest({film_options, session, planned.facts, planned.plan, folder, std::move(files), std::move(pictures)});
  if (!json) return tl::unexpected(json.error());
  if (auto written = document::write_text_file(folder / manifest_name, document::text_of(*json)); !written)
    return written;
  std::error_code ignored;
  fs::remove_all(*pictures_in, ignored);
  return {};
}

Expected<int> make_accident_film(const AccidentOptions& options) {
  const auto session = logging::SessionReader::open(options.film.session);
  if (!session) return tl::unexpected(session.error());
  const auto planned =
      read_plan(*session, options.event, static_cast<double>(options.film.width_px) / options.film.height_px);
  if (!planned) return tl::unexpected(planned.error());
  program::announce(planned->plan.title);
  if (planned->facts.contacts.size() > 1)
    program::announce(fmt::format("contact {} of {}; --event chooses another", *planned->facts.chosen + 1,
                                  planned->facts.contacts.size()));
  for (const std::string& why : planned->plan.left_out) program::say("septet: left out: " + why);
  const std::string storyboard = storyboard_text(planned->plan);
  if (!options.plan.empty()) {
    if (auto written = document::write_text_file(options.plan, storyboard); !written)
      return tl::unexpected(written.error());
    program::announce(fmt::format("{}: {} shots", options.plan.string(), planned->plan.script.shots.size()));
    return 0;
  }
  const fs::path folder = options.film.out.empty() ? options.film.session.parent_path() / "accident" : options.film.out;
  if (auto free = check_folder(folder, storyboard, options.film.resume); !free) return tl::unexpected(free.error());
  if (const auto ffmpeg = find_ffmpeg(); !ffmpeg) return tl::unexpected(ffmpeg.error());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(error.message(), folder.string(), "choose a folder that can be written with --out");
  FilmOptions film = options.film;
  film.out = folder / film_name;
  film.shots = folder / script_name;
  film.keep_pictures = true;
  if (auto written = document::write_text_file(film.shots, storyboard); !written)
    return tl::unexpected(written.error());
  fs::remove(film.out, error);  // Encoded once more of a resumed one's pictures: its narrator may have been added.
  const auto whole = film_plan(film);
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) {
    program::say(fmt::format("septet: stopped; add --resume to go on with {}", folder.string()));
    return program::failed_status;
  }
  if (auto written = write_beside(film, options.voice, folder, *session, *planned); !written)
    return tl::unexpected(written.error());
  program::announce(fmt::format("{}: the film; beside it {}, {}, {}, {} and stills", film.out.string(), page_name,
                                subtitles_name, script_name, manifest_name));
  return 0;
}

}  // namespace

Expected<int> run_accident(const AccidentOptions& options) {
  if (options.check.empty()) {
    if (options.film.session.empty())
      return failure("it is not said which session", "septet accident", "give the session file of a drive");
    return make_accident_film(options);
  }
  const auto checked = check_accident(options.check, options.film.session);
  if (!checked) return tl::unexpected(checked.error());
  for (const std::string& difference : checked->differences) program::announce(difference);
  std::string frames;
  for (const std::uint64_t number : checked->drawn_again) frames += fmt::format(" {}", number);
  program::announce(fmt::format("{}; frames drawn again:{}",
                                checked->differences.empty() ? "as it was made" : "not as it was made",
                                frames.empty() ? " none" : frames));
  return checked->differences.empty() ? 0 : program::failed_status;
}

}  // namespace septet::film
