#include "sim-client/film/queue/queue_runner.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_folder.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

using namespace std::chrono_literals;
/// A query for a running maker holds the lock for a moment.
constexpr double patience_for_lock_s = 2.0;
constexpr std::size_t films_remembered = 100;

std::optional<FilmQueue::Lock> wait_for_lock(const FilmQueue& queue) {
  const double until_s = program::monotonic_s() + patience_for_lock_s;
  while (true) {
    if (auto lock = queue.lock()) return lock;
    if (program::monotonic_s() > until_s || program::stop_signal()) return std::nullopt;
    std::this_thread::sleep_for(50ms);
  }
}

/// Reason of a failure: the last error in the film program's output, or its exit.
std::string why_failed(const fs::path& log, const program::ChildExit& exit) {
  std::ifstream stream(log, std::ios::binary);
  std::string word;
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("septet: ")) word = line.substr(8);
  if (!word.empty()) return printable(word);
  return exit.signal != 0 ? fmt::format("signal {} has ended its program", exit.signal)
                          : fmt::format("its program has ended with status {}", exit.code);
}

/// Makes one film; false if a stop signal interrupted it.
Expected<bool> make_one(const FilmQueue& queue, QueuedFilm film) {
  std::error_code ignored;
  const bool goes_on = film.state == FilmState::begun;
  if (!goes_on) fs::remove(queue.log(film.number), ignored);
  film.state = FilmState::begun;
  if (auto written = queue.write(film); !written) return tl::unexpected(written.error());
  std::vector<std::string> arguments = film.arguments;
  // The program that made it may still be at its last tile.
  if (const auto folder = pictures_folder(film.out); goes_on && folder) FilmFolder::wait_until_free(*folder);
  if (goes_on && std::find(arguments.begin(), arguments.end(), "--resume") == arguments.end())
    arguments.emplace_back("--resume");
  const double begun_s = program::monotonic_s();
  auto child = program::ChildProcess::start({.program = (program::own_folder() / "septet-film").string(),
                                             .arguments = std::move(arguments),
                                             .environment = {},
                                             .log = queue.log(film.number),
                                             .folder = film.said_in});
  if (!child) return tl::unexpected(child.error());
  std::optional<program::ChildExit> exit;
  bool cancelled = false, stopped = false;
  while (!exit && !cancelled && !stopped) {
    exit = child->poll();
    while (child->read_line(exit ? 0ms : 100ms)) {
    }
    cancelled = queue.is_to_be_cancelled(film.number);
    stopped = program::should_stop();
  }
  if (!exit) {
    // The film program finishes its present piece of work: a tile, a picture.
    child->send_signal(SIGTERM);
    const double until_s = program::monotonic_s() + 20.0;
    while (!(exit = child->poll()) && program::monotonic_s() < until_s) std::this_thread::sleep_for(50ms);
    if (!exit) child->stop();
  }
  film.took_s += program::monotonic_s() - begun_s;
  if (exit && exit->code == 0) {
    film.state = FilmState::made;
  } else if (cancelled) {
    film.state = FilmState::cancelled;
  } else if (!stopped) {
    film.state = FilmState::failed;
    film.last_word = why_failed(queue.log(film.number), exit.value_or(program::ChildExit{}));
  }
  if (auto written = queue.write(film); !written) return tl::unexpected(written.error());
  return !stopped;
}

/// Removes the records of the oldest finished films.
void forget_old(const FilmQueue& queue) {
  std::vector<QueuedFilm> films = queue.films();
  std::erase_if(
      films, [](const QueuedFilm& film) { return film.state == FilmState::waiting || film.state == FilmState::begun; });
  std::error_code ignored;
  for (std::size_t n = 0; n + films_remembered < films.size(); ++n)
    for (const char* extension : {"json", "log", "cancel"})
      fs::remove(queue.log(films[n].number).replace_extension(extension), ignored);
}

}  // namespace

Expected<void> make_queued_films(const FilmQueue& queue) {
  while (true) {
    {
      const auto lock = wait_for_lock(queue);
      if (!lock) return {};
      while (true) {
        std::optional<QueuedFilm> next;
        for (QueuedFilm& film : queue.films()) {
          if (film.state != FilmState::waiting && film.state != FilmState::begun) continue;
          if (!queue.is_to_be_cancelled(film.number)) {
            next = std::move(film);
            break;
          }
          film.state = FilmState::cancelled;
          if (auto written = queue.write(film); !written) return written;
        }
        if (!next) break;
        const auto goes_on = make_one(queue, std::move(*next));
        if (!goes_on) return tl::unexpected(goes_on.error());
        if (!*goes_on) return {};
      }
      forget_old(queue);
    }
    // A film added meanwhile found the lock held.
    const auto films = queue.films();
    if (std::none_of(films.begin(), films.end(), [&](const QueuedFilm& film) {
          return film.state == FilmState::waiting && !queue.is_to_be_cancelled(film.number);
        }))
      return {};
  }
}

Expected<void> start_making_films(const FilmQueue& queue) {
  // All allocations happen before fork.
  std::string program = (program::own_folder() / "septet-film").string(), word = "queue", option = "--queue",
              make = "--make", folder = queue.path().string(), log = (queue.path() / "queue.log").string();
  char* argv[] = {program.data(), word.data(), option.data(), folder.data(), make.data(), nullptr};
  const pid_t first = ::fork();
  if (first < 0) return failure(std::strerror(errno), program, "close other programs: the system starts no more");
  if (first == 0) {
    // Detached, in a session of its own: neither a terminal's end nor Ctrl-C reaches it.
    ::setsid();
    if (::fork() != 0) ::_exit(0);
    const int none = ::open("/dev/null", O_RDWR), file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(none, STDIN_FILENO), ::dup2(none, STDOUT_FILENO), ::dup2(file >= 0 ? file : none, STDERR_FILENO);
    ::execv(argv[0], argv);
    ::_exit(127);
  }
  int status = 0;
  while (::waitpid(first, &status, 0) < 0 && errno == EINTR) {
  }
  return {};
}

}  // namespace septet::film
