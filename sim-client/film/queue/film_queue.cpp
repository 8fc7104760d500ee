#include "sim-client/film/queue/film_queue.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/core/whole_file.hpp"
#include "engine/document/json.hpp"
#include "program/last_line.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_film_bytes = 1 << 20;
constexpr std::uint64_t most_films = 999'999;
constexpr std::array<std::string_view, 5> state_names{"waiting", "begun", "made", "failed", "cancelled"};

/// Number in "000012.json"; empty for another name.
std::optional<std::uint64_t> number_in(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (stem.size() != 6 || error != std::errc() || end != stem.data() + stem.size() || number == 0) return std::nullopt;
  return number;
}

fs::path named(const fs::path& folder, std::uint64_t number, std::string_view extension) {
  return folder / fmt::format("{:06}.{}", number, extension);
}

std::string text_of(const QueuedFilm& film) {
  document::Json json = document::Json::object();
  json["arguments"] = film.arguments;
  json["said_in"] = film.said_in.string();
  json["out"] = film.out.string();
  json["state"] = state_names[static_cast<std::size_t>(film.state)];
  json["last_word"] = film.last_word;
  json["took_s"] = film.took_s;
  return document::text_of(json);
}

std::optional<QueuedFilm> read_queued(const fs::path& file, std::uint64_t number) {
  const auto text = read_regular_file(file, longest_film_bytes);
  if (!text) return std::nullopt;
  const auto json = document::Json::parse(*text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto string = [&](const char* name) -> std::optional<std::string> {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? std::optional(found->get<std::string>()) : std::nullopt;
  };
  const auto arguments = json.find("arguments"), took_s = json.find("took_s");
  const auto said_in = string("said_in"), out = string("out"), state = string("state"), last_word = string("last_word");
  if (arguments == json.end() || !arguments->is_array() || took_s == json.end() || !took_s->is_number() || !said_in ||
      !out || !state || !last_word)
    return std::nullopt;
  QueuedFilm film{.number = number, .said_in = *said_in, .out = *out};
  for (const auto& argument : *arguments) {
    if (!argument.is_string()) return std::nullopt;
    film.arguments.push_back(argument.get<std::string>());
  }
  const auto* const known = std::find(state_names.begin(), state_names.end(), *state);
  if (known == state_names.end()) return std::nullopt;
  film.state = static_cast<FilmState>(known - state_names.begin());
  film.last_word = printable(*last_word);
  film.took_s = took_s->get<double>();
  return film;
}

Error about(const fs::path& path, int error) {
  return {std::strerror(error), path.string(), "choose a folder that can be written with --queue"};
}

}  // namespace

Expected<FilmQueue> FilmQueue::open(fs::path folder) {
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) return tl::unexpected(about(folder, error.value()));
  if (is_new) fs::permissions(folder, fs::perms::owner_all, error);
  return FilmQueue(std::move(folder));
}

std::vector<QueuedFilm> FilmQueue::films() const {
  std::vector<QueuedFilm> films;
  nonsense_ = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
    if (entry.path().extension() != ".json") continue;
    const auto number = number_in(entry.path());
    auto film = number ? read_queued(entry.path(), *number) : std::nullopt;
    if (!film)
      ++nonsense_;
    else
      films.push_back(std::move(*film));
  }
  std::sort(films.begin(), films.end(), [](const QueuedFilm& a, const QueuedFilm& b) { return a.number < b.number; });
  return films;
}

Expected<std::uint64_t> FilmQueue::add(const QueuedFilm& film) {
  std::uint64_t next = 1;
  std::error_code error;
  std::set<std::uint64_t> taken;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
    if (const auto number = number_in(entry.path())) taken.insert(*number);
  // Next number above all others, while there is one; then any free one.
  if (!taken.empty()) next = *taken.rbegin() + 1;
  if (next > most_films)
    for (next = 1; taken.contains(next);) ++next;
  // The file is whole before it gets its name, and the name is exclusive: creating a link fails if it exists.
  std::string part = (path_ / "new-XXXXXX").string();
  if (const int own = ::mkstemp(part.data()); own >= 0)
    ::close(own);
  else
    return tl::unexpected(about(path_, errno));
  const std::string text = text_of(film);
  if (auto written = write_whole_file(part, "film", std::as_bytes(std::span(text))); !written)
    return tl::unexpected(written.error());
  for (; next <= most_films; ++next) {
    if (::link(part.c_str(), named(path_, next, "json").c_str()) == 0) break;
    if (errno != EEXIST) {
      const int why = errno;
      fs::remove(part, error);
      return tl::unexpected(about(path_, why));
    }
  }
  fs::remove(part, error);
  if (next > most_films)
    return failure(fmt::format("the queue is full: it has a file for each number up to {}", most_films), path_.string(),
                   "remove the files of films that are made (NNNNNN.json) from it");
  return next;
}

Expected<void> FilmQueue::write(const QueuedFilm& film) const {
  const std::string text = text_of(film);
  return write_whole_file(named(path_, film.number, "json"), "film", std::as_bytes(std::span(text)));
}

Expected<void> FilmQueue::ask_to_cancel(std::uint64_t number) const {
  return write_whole_file(named(path_, number, "cancel"), "request", {});
}

bool FilmQueue::is_to_be_cancelled(std::uint64_t number) const {
  std::error_code error;
  return fs::exists(named(path_, number, "cancel"), error);
}

bool FilmQueue::is_to_be_made(const QueuedFilm& film) const {
  return (film.state == FilmState::waiting || film.state == FilmState::begun) && !is_to_be_cancelled(film.number);
}

fs::path FilmQueue::log(std::uint64_t number) const { return named(path_, number, "log"); }

FilmQueue::Lock::Lock(Lock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FilmQueue::Lock::~Lock() {
  if (file_ >= 0) ::close(file_);
}

std::optional<FilmQueue::Lock> FilmQueue::lock() const {
  const int file = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) return Lock(file);
  if (file >= 0) ::close(file);
  return std::nullopt;
}

fs::path usual_queue_folder() {
  const auto variable = [](const char* name) -> fs::path {
    const char* text = std::getenv(name);
    return text && *text == '/' ? text : "";
  };
  fs::path state = variable("XDG_STATE_HOME");
  if (state.empty()) state = variable("HOME") / ".local/state";
  return state / "septet/films";
}

std::string status_line(const FilmQueue& queue, const QueuedFilm& film, bool somebody_works) {
  const auto took = [&] {
    return film.took_s < 90.0 ? fmt::format("in {:.0f} s", film.took_s)
                              : fmt::format("in {:.0f} min", film.took_s / 60.0);
  };
  std::string state, more;
  switch (film.state) {
    case FilmState::waiting:
      state = queue.is_to_be_cancelled(film.number) ? "cancelled" : "waiting";
      break;
    case FilmState::begun:
      state = queue.is_to_be_cancelled(film.number) ? "cancelled" : somebody_works ? "being made" : "interrupted";
      more = program::last_line(queue.log(film.number));
      break;
    case FilmState::made:
      state = "made", more = took();
      break;
    case FilmState::failed:
      state = "failed", more = film.last_word;
      break;
    case FilmState::cancelled:
      state = "cancelled";
      break;
  }
  return fmt::format("{:3}  {:<11}  {}{}{}", film.number, state, printable(film.out.string()), more.empty() ? "" : "  ",
                     more);
}

}  // namespace septet::film
