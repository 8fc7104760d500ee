#include "sim-client/film/queue/queue_commands.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "program/console.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/queue/film_queue.hpp"
#include "sim-client/film/queue/queue_runner.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

Expected<FilmQueue> queue_of(const QueueArguments& arguments) {
  std::error_code error;
  return FilmQueue::open(fs::absolute(arguments.folder.empty() ? usual_queue_folder() : arguments.folder, error));
}

bool waits(const QueuedFilm& film) { return film.state == FilmState::waiting || film.state == FilmState::begun; }

}  // namespace

Expected<int> queue_film(const QueueArguments& arguments, const fs::path& out) {
  auto queue = queue_of(arguments);
  if (!queue) return tl::unexpected(queue.error());
  if (arguments.make) {
    program::catch_stop_signals();
    if (auto made = make_queued_films(*queue); !made) return tl::unexpected(made.error());
    return 0;
  }
  if (arguments.film.empty()) {
    if (std::ranges::none_of(queue->films(), waits)) {
      program::announce("no film waits; septet film queue SESSION … adds one");
      return 0;
    }
    if (auto started = start_making_films(*queue); !started) return tl::unexpected(started.error());
    program::announce("the films that wait are made; septet film status tells how far they are");
    return 0;
  }
  std::error_code error;
  const fs::path here = fs::current_path(error), whole_out = fs::weakly_canonical(fs::absolute(out, error), error);
  for (const QueuedFilm& other : queue->films())
    if (queue->is_to_be_made(other) && other.out == whole_out)
      return failure(fmt::format("film {} of the queue is to lie there", other.number), whole_out.string(),
                     "choose another name with --out");
  const auto number = queue->add({.arguments = arguments.film, .said_in = here, .out = whole_out});
  if (!number) return tl::unexpected(number.error());
  if (auto started = start_making_films(*queue); !started) return tl::unexpected(started.error());
  const auto films = queue->films();
  const auto before = std::ranges::count_if(
      films, [&](const QueuedFilm& film) { return film.number < *number && queue->is_to_be_made(film); });
  program::announce(
      fmt::format("film {}: {}, {}; septet film status tells how far it is", *number, whole_out.string(),
                  before == 0 ? "begun" : fmt::format("after {} other{}", before, before == 1 ? "" : "s")));
  return 0;
}

Expected<int> show_queue(const QueueArguments& arguments) {
  const auto queue = queue_of(arguments);
  if (!queue) return tl::unexpected(queue.error());
  const bool somebody_works = queue->is_locked();
  const auto films = queue->films();
  for (const QueuedFilm& film : films) program::announce(status_line(*queue, film, somebody_works));
  if (films.empty()) program::announce("no films; septet film queue SESSION … adds one");
  if (!somebody_works && std::ranges::any_of(films, [&](const QueuedFilm& film) { return queue->is_to_be_made(film); }))
    program::announce("nobody makes them now; septet film queue goes on");
  if (queue->nonsense() > 0)
    program::say(fmt::format("septet: {} files in {} are no films of a queue; they are left alone", queue->nonsense(),
                             queue->path().string()));
  return 0;
}

Expected<int> cancel_films(const QueueArguments& arguments) {
  auto queue = queue_of(arguments);
  if (!queue) return tl::unexpected(queue.error());
  const auto films = queue->films();
  // All or nothing: every number is checked first.
  for (const std::uint64_t number : arguments.numbers) {
    const auto film = std::ranges::find(films, number, &QueuedFilm::number);
    if (film == films.end())
      return failure(fmt::format("there is no film {}", number), queue->path().string(),
                     "septet film status lists those there are; none was cancelled");
    if (!waits(*film))
      return failure(fmt::format("film {} has ended already", number), film->out.string(),
                     "septet film status lists those that wait; none was cancelled");
  }
  for (const std::uint64_t number : arguments.numbers) {
    if (auto asked = queue->ask_to_cancel(number); !asked) return tl::unexpected(asked.error());
    const auto film = std::ranges::find(films, number, &QueuedFilm::number);
    const fs::path pictures = pictures_folder(film->out).value_or(film->out);
    program::announce(
        fmt::format("film {} is cancelled{}", number,
                    film->state == FilmState::begun ? "; what there is of it stays in " + pictures.string() : ""));
  }
  return 0;
}

}  // namespace septet::film
