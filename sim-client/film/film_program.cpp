#include "sim-client/film/film_program.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/film/time_limit.hpp"
#include "sim-client/film/traced/messages.hpp"
#include "sim-client/film/traced/worker.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

/// Below this, a time limit gives noisy pictures, and denoising is on.
constexpr std::uint32_t few_samples = 256;

}  // namespace

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
  if (so_far.bad_samples > 0) text += fmt::format(", {} samples with NaN or infinite light", so_far.bad_samples);
  if (so_far.workers > 1) text += fmt::format(" by {} programs", so_far.workers);
  const double drawn = done - static_cast<double>(so_far.kept) - so_far.kept_of_next;
  if (!(drawn > 1e-3)) return text;  // Rounding error is no basis for a time.
  const double left_s = elapsed_s * (static_cast<double>(so_far.planned) - done) / drawn;
  return text +
         (left_s < 90.0 ? fmt::format(", {:.0f} s left", left_s) : fmt::format(", {:.0f} min left", left_s / 60.0));
}

namespace {

Expected<int> film_here(const FilmOptions& options, Machines* others) {
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
    program::say(fmt::format("septet: the light of {} samples was NaN or infinite; they are black", made->bad_samples));
  std::string text =
      fmt::format("{}: {} pictures, {} a second", options.out.string(), made->frames, options.frames_per_second);
  if (made->kept > 0) text += fmt::format(", {} of them drawn before", made->kept);
  if (made->samples >= 2.0)
    text += fmt::format(", {}an error of {:.2g} by {:.0f} samples a pixel", made->kept > 0 ? "the others with " : "",
                        made->error, made->samples);
  if (!made->encoding) text += "; as one film: --out film.mp4";
  program::announce(text);
  return 0;
}

/// Returns `words` without these options, each of which has a value, after it or after "=".
std::vector<std::string> without(const std::vector<std::string>& words,
                                 std::initializer_list<std::string_view> options) {
  std::vector<std::string> rest;
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string_view name = std::string_view(words[n]).substr(0, words[n].find('='));
    if (std::ranges::find(options, name) == options.end())
      rest.push_back(words[n]);
    else if (name.size() == words[n].size())
      ++n;
  }
  return rest;
}

/// Number of samples for the time limit, on the machines that will make the film; a resumed film keeps its number.
Expected<void> settle_samples(FilmArguments& arguments, std::vector<std::string>& words) {
  FilmOptions& film = arguments.film;
  const auto pictures = pictures_folder(film.out);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto begun = film.resume ? begun_in(*pictures) : std::nullopt;
  if (begun && begun->contains("samples") && begun->contains("denoise")) {
    const std::string& samples = begun->at("samples");
    std::from_chars(samples.data(), samples.data() + samples.size(), film.samples);
    film.denoise = begun->at("denoise") == "yes";
  } else {
    const auto frames = FilmFrames::open(film);
    if (!frames) return tl::unexpected(frames.error());
    const auto folder = program::TemporaryFolder::make("septet-trial");
    if (!folder) return tl::unexpected(folder.error());
    int trial = 0;
    const auto try_frames = [&](std::size_t every, std::uint32_t samples) -> Expected<double> {
      const fs::path out = folder->path() / fmt::format("{}", ++trial);
      const double begun_s = program::monotonic_s();
      FilmOptions few = film;
      few.every = film.every * static_cast<std::uint32_t>(every), few.samples = samples, few.error = 0.0;
      few.denoise = few.resume = false, few.out = out, few.statistics.clear();
      if (arguments.by_ranks) {
        RanksOptions ranks = arguments.ranks;
        ranks.out = out, ranks.resume = false, ranks.quiet = true;
        std::vector<std::string> of_trial =
            without(words, {"--within", "--samples", "--error", "--every", "--out", "--statistics"});
        std::erase_if(of_trial, [](const std::string& word) { return word == "--denoise" || word == "--resume"; });
        of_trial.insert(of_trial.end(), {"--every", fmt::format("{}", few.every), "--samples",
                                         fmt::format("{}", samples), "--out", out.string()});
        const auto status = film_by_ranks(ranks, std::move(of_trial));
        if (!status) return tl::unexpected(status.error());
        if (*status != 0)
          return failure("the frames that were tried are not made", "--within", "see what is said above");
      } else {
        const auto made = make_film(few, [&](const FilmMade&) {
          return !program::should_stop() && program::monotonic_s() < begun_s + arguments.within_s;
        });
        if (!made) return tl::unexpected(made.error());
        if (made->stopped && program::stop_signal())
          return failure("stopped while frames were tried", "--within", "start it again");
        if (made->stopped)
          return failure("a few frames of few samples take longer", "--within",
                         "allow more time, or draw smaller frames (--size)");
      }
      return program::monotonic_s() - begun_s;
    };
    const auto choice = choose_samples(frames->plan().frames.size(), arguments.within_s, film.samples, try_frames);
    if (!choice) return tl::unexpected(choice.error());
    film.samples = choice->samples;
    film.denoise |= film.samples >= 2 && film.samples < few_samples;
    program::say(fmt::format("septet: tried for {:.0f} s; {} samples a pixel{}, which should take {:.0f} s",
                             choice->tried_s, film.samples, film.denoise ? ", and the noise taken out" : "",
                             choice->foretold_s));
  }
  words = without(words, {"--within", "--samples"});
  std::erase(words, "--denoise");
  words.insert(words.end(), {"--samples", fmt::format("{}", film.samples)});
  if (film.denoise) words.emplace_back("--denoise");
  return {};
}

}  // namespace

Expected<int> run_film(FilmArguments arguments, std::vector<std::string> words, Machines* others) {
  if (others && arguments.by_ranks)
    return failure("mpirun has started these programs, and they are to start it", "--ranks, --hosts",
                   "leave mpirun or these options out");
  if (arguments.within_s > 0.0) {
    if (others)
      return failure("what there is time for is found by starting programs several times", "--within",
                     "use --ranks instead of mpirun");
    program::catch_stop_signals();
    if (auto settled = settle_samples(arguments, words); !settled) return tl::unexpected(settled.error());
  }
  return arguments.by_ranks ? film_by_ranks(arguments.ranks, std::move(words)) : film_here(arguments.film, others);
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
