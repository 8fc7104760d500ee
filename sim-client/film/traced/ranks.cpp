#include "sim-client/film/traced/ranks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/hosts_file.hpp"
#include "program/machines.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_folder.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

using namespace std::chrono_literals;

constexpr std::size_t most_words_bytes = 600;
constexpr int most_fruitless_starts = 3;

/// True if a program was ended by a signal, which mpirun reports in its own status as shells do.
bool is_of_signal(const program::ChildExit& end) { return end.signal != 0 || (end.code > 128 && end.code < 128 + 65); }

/// Standard error of mpirun: the output of the programs and its own.
class Said {
 public:
  explicit Said(fs::path file) : file_(std::move(file)) {}

  /// Prints the new part.
  void show(program::ProgressLine& progress) {
    std::ifstream stream(file_, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(read_));
    std::string line;
    while (std::getline(stream, line) && !stream.eof()) {
      read_ += line.size() + 1;
      if (line.ends_with('\r')) line.pop_back();
      line = printable(line);
      if (line.starts_with("septet: "))
        progress.message(line);
      else if (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front())) && line.find(" of ") < 12)
        progress.show(line);
      else if (words_of_mpirun_.size() < most_words_bytes && line.find_first_not_of("- ") != std::string::npos)
        words_of_mpirun_ += (words_of_mpirun_.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
      says_why_ |= line.starts_with("septet: ");
    }
  }
  /// Clears the output for the next start.
  void begin_anew() { words_of_mpirun_.clear(), says_why_ = false; }
  const std::string& words_of_mpirun() const { return words_of_mpirun_; }
  bool says_why() const { return says_why_; }

 private:
  fs::path file_;
  std::uint64_t read_ = 0;
  std::string words_of_mpirun_;
  bool says_why_ = false;
};

/// Time of the latest write in a film's folder.
std::optional<fs::file_time_type> newest_in(const fs::path& folder) {
  std::optional<fs::file_time_type> newest;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".png" && entry.path().extension() != ".tiles") continue;
    const auto time = entry.last_write_time(error);
    if (!error && (!newest || time > *newest)) newest = time;
  }
  return newest;
}

struct StartEnd {
  std::optional<int> status;  ///< Status of the film's first program; empty: it was lost.
  program::ChildExit of_mpirun;
  bool hosts_changed = false;
};

Expected<StartEnd> start_once(const fs::path& mpirun, const RanksOptions& options, std::vector<std::string> arguments,
                              const fs::path& log, Said& said, program::ProgressLine& progress) {
  std::error_code ignored;
  const auto hosts_time = fs::last_write_time(options.hosts, ignored);
  auto child = program::ChildProcess::start({mpirun.string(), std::move(arguments), {}, log});
  if (!child) return tl::unexpected(child.error());
  StartEnd end;
  const auto hear = [&](std::chrono::milliseconds wait) {
    while (const auto line = child->read_line(wait)) {
      const std::string_view text = *line, words = last_words;
      int status = 0;
      if (!text.starts_with(words)) {
        if (!options.quiet) program::announce(text);
      } else if (std::from_chars(text.data() + words.size(), text.data() + text.size(), status).ec == std::errc()) {
        end.status = status;
      }
    }
  };
  while (true) {
    const auto exit = child->poll();
    hear(exit ? 0ms : 100ms);
    said.show(progress);
    if (exit) {
      end.of_mpirun = *exit;
      return end;
    }
    std::this_thread::sleep_for(20ms);
    if (program::should_stop()) break;
    if (options.hosts.empty() || end.status) continue;
    const auto time = fs::last_write_time(options.hosts, ignored);
    if (!ignored && time != hosts_time) {
      end.hosts_changed = true;
      break;
    }
  }
  child->stop();
  hear(0ms);
  said.show(progress);
  return end;
}

}  // namespace

Expected<int> film_by_ranks(const RanksOptions& options, std::vector<std::string> arguments) {
  const auto mpirun = program::find_mpirun("--ranks");
  if (!mpirun) return tl::unexpected(mpirun.error());
  if (!options.hosts.empty())
    if (auto checked = program::check_hosts_file(options.hosts); !checked) return tl::unexpected(checked.error());
  const auto folder = pictures_folder(options.out);
  if (!folder) return tl::unexpected(folder.error());
  const auto notes = program::TemporaryFolder::make("septet-ranks");
  if (!notes) return tl::unexpected(notes.error());
  const fs::path log = notes->path() / "mpirun.txt";
  std::vector<std::string> all = program::mpirun_arguments(options.ranks, options.hosts);
  all.push_back((program::own_folder() / "septet-film").string());
  all.insert(all.end(), std::make_move_iterator(arguments.begin()), std::make_move_iterator(arguments.end()));
  all.push_back("--one-of-ranks");
  program::catch_stop_signals();
  program::ProgressLine progress;
  Said said(log);
  int fruitless = 0;  // Consecutive starts without progress.
  for (bool first = true;; first = false) {
    const auto before = newest_in(*folder);
    said.begin_anew();
    const auto end = start_once(*mpirun, options, all, log, said, progress);
    if (!end) return tl::unexpected(end.error());
    if (end->status && !end->hosts_changed) return *end->status;
    FilmFolder::wait_until_free(*folder);
    if (program::should_stop()) {
      progress.message(fmt::format("septet: stopped; add --resume to go on with {}", options.out.string()));
      return program::failed_status;
    }
    const bool came = newest_in(*folder) > before;
    fruitless = came || end->hosts_changed ? 0 : fruitless + 1;
    if (end->hosts_changed) {
      progress.message(fmt::format("septet: {} has changed; the film goes on with it", options.hosts.string()));
    } else if (came || (is_of_signal(end->of_mpirun) && fruitless < most_fruitless_starts)) {
      progress.message(
          "septet: the film's first program or mpirun was lost; what is finished is kept and the rest goes on");
    } else {
      progress.close();
      if (end->of_mpirun.code != 0 && said.says_why()) return program::failed_status;
      return failure(
          fmt::format("mpirun has ended {}: {}",
                      end->of_mpirun.signal ? fmt::format("by signal {}", end->of_mpirun.signal)
                                            : fmt::format("with status {}", end->of_mpirun.code),
                      said.words_of_mpirun().empty() ? "it does not say why" : said.words_of_mpirun()),
          options.hosts.empty() ? "--ranks" : options.hosts.string(),
          first ? "try the same command after mpirun on its own" : "add --resume to go on: what is finished is kept");
    }
    if (fs::exists(*folder / "film.json") && !options.resume && std::ranges::find(all, "--resume") == all.end())
      all.push_back("--resume");
  }
}

}  // namespace septet::film
