#include "sim-client/film/film_program.hpp"

#include <charconv>

#include <fmt/core.h>

#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/film/traced/messages.hpp"
#include "sim-client/film/traced/worker.hpp"

namespace septet::film {

std::string read_size(const std::string& text, FilmOptions& options) {
  const char *begin = text.data(), *end = begin + text.size();
  const auto width = std::from_chars(begin, end, options.width_px);
  const bool crossed = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = crossed ? std::from_chars(width.ptr + 1, end, options.height_px) : width;
  const auto good = [](std::uint32_t pixels) { return pixels >= 16 && pixels <= 16384; };
  if (crossed && height.ec == std::errc() && height.ptr == end && good(options.width_px) && good(options.height_px))
    return {};
  return "\"" + text + "\" is no size; write WIDTHxHEIGHT in pixels, 16 to 16384 each";
}

std::string progress_text(const FilmMade& so_far, double elapsed_s) {
  if (so_far.encoding) return fmt::format("all {} pictures are drawn; ffmpeg makes the film of them", so_far.frames);
  const double done = static_cast<double>(so_far.frames) + so_far.share_of_next;
  std::string text = fmt::format("{} of {} frames", so_far.frames, so_far.planned);
  if (so_far.share_of_next > 1.0)
    text += fmt::format(" and {:.1f} in parts", so_far.share_of_next);
  else if (so_far.share_of_next > 0.0)
    text += fmt::format(" and {:.0f} % of the next", 100.0 * so_far.share_of_next);
  if (so_far.bad_samples > 0) text += fmt::format(", {} samples without light that is a number", so_far.bad_samples);
  if (so_far.workers > 1) text += fmt::format(" by {} programs", so_far.workers);
  const double drawn = done - static_cast<double>(so_far.kept);
  if (!(drawn > 0.0)) return text;
  const double left_s = elapsed_s * (static_cast<double>(so_far.planned) - done) / drawn;
  return text +
         (left_s < 90.0 ? fmt::format(", {:.0f} s left", left_s) : fmt::format(", {:.0f} min left", left_s / 60.0));
}

Expected<int> run_film(FilmOptions options, Machines* others) {
  if (options.out.empty()) options.out = options.session.parent_path() / "film";
  program::catch_stop_signals();
  program::ProgressLine progress;
  const double begun_s = program::monotonic_s();
  std::string noticed;
  const auto goes_on = [&](const FilmMade& so_far) {
    if (so_far.notice != noticed) progress.message("septet: " + (noticed = so_far.notice));
    if (progress.is_due(program::monotonic_s())) progress.show(progress_text(so_far, program::monotonic_s() - begun_s));
    return !program::should_stop();
  };
  const auto made = make_film(options, goes_on, others);
  progress.close();
  if (!made) return tl::unexpected(made.error());
  if (made->stopped) {
    program::say(fmt::format("septet: stopped; {} of {} pictures are drawn; add --resume to go on with {}",
                             made->frames, made->planned, options.out.string()));
    return program::failed_status;
  }
  if (made->bad_samples > 0)
    program::say(fmt::format("septet: {} samples had no light that is a number; they are black", made->bad_samples));
  std::string text =
      fmt::format("{}: {} pictures, {} a second", options.out.string(), made->frames, options.frames_per_second);
  if (made->samples >= 2.0)
    text += fmt::format(", an error of {:.2g} by {:.0f} samples a pixel", made->error, made->samples);
  if (made->kept > 0) text += fmt::format(", {} of them drawn before", made->kept);
  if (!made->encoding) text += "; as one film: --out film.mp4";
  program::announce(text);
  return 0;
}

int run_alone_or_by_mpirun(const std::function<int(Machines*)>& work) {
  const auto number = program::number_by_mpirun();
  if (!number) return work(nullptr);
  auto machines = program::start_machines();
  if (!machines) {
    if (*number == 0) program::say("septet: " + describe(machines.error()));
    return program::failed_status;
  }
  const int status = *number > 0 ? serve_master(**machines) : work(machines->get());
  (*machines)->will_end_with(status);
  if (*number > 0) return status;
  for (int other = 1; other < (*machines)->count(); ++other) {
    Bytes end = message(Word::end);
    ByteWriter(end).put(static_cast<std::uint8_t>((*machines)->has_losses()));
    (*machines)->send(other, std::move(end));
  }
  return status;
}

}  // namespace septet::film
