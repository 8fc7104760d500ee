#pragma once
/// Films that wait to be made, one after another, each with all the machines that it names: a folder that outlives every program.
///
/// A film is a file, NNNNNN.json: the words of its command line, the folder in which they were said, and how far it has come. Only
/// the program that makes films changes it, which holds a lock (flock) on the folder; NNNNNN.cancel beside it asks that one to leave
/// the film, and NNNNNN.log is what the film's program says. A program that is killed leaves a film that is begun: the next goes on
/// with it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

enum class FilmState : std::uint8_t { waiting, begun, made, failed, cancelled };

struct QueuedFilm {
  std::uint64_t number = 0;            ///< From 1; as it is called in the folder.
  std::vector<std::string> arguments;  ///< Of septet-film.
  std::filesystem::path said_in;       ///< What their relative paths are relative to.
  std::filesystem::path out;
  FilmState state = FilmState::waiting;
  std::string last_word;  ///< Why it has failed.
  double took_s = 0.0;    ///< So far, without the start that is going on.
};

class FilmQueue {
 public:
  /// Makes the folder, for this user alone.
  static Expected<FilmQueue> open(std::filesystem::path folder);

  const std::filesystem::path& path() const { return path_; }
  /// All films, by number. What is no film of a queue is left out and counted.
  std::vector<QueuedFilm> films() const;
  std::size_t nonsense() const { return nonsense_; }
  /// The film gets the next number, whoever adds one beside it.
  Expected<std::uint64_t> add(const QueuedFilm& film);
  Expected<void> write(const QueuedFilm& film) const;
  Expected<void> ask_to_cancel(std::uint64_t number) const;
  bool is_to_be_cancelled(std::uint64_t number) const;
  /// It waits or is begun, and nobody has asked to cancel it.
  bool is_to_be_made(const QueuedFilm& film) const;
  std::filesystem::path log(std::uint64_t number) const;

  /// Held by the program that makes films, until it ends. Nothing: another holds it.
  class Lock {
   public:
    explicit Lock(int file) : file_(file) {}
    Lock(Lock&& other) noexcept;
    Lock& operator=(Lock&&) = delete;
    ~Lock();

   private:
    int file_;
  };
  std::optional<Lock> lock() const;
  bool is_locked() const { return !lock().has_value(); }

 private:
  explicit FilmQueue(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  mutable std::size_t nonsense_ = 0;
};

/// Where a user's queue lies if nothing else is said: septet/films below XDG_STATE_HOME, or below ~/.local/state.
std::filesystem::path usual_queue_folder();

/// What is said of a film in a line: "2  being made  out/chase.mp4  12 of 100 frames, 5 min left".
std::string status_line(const FilmQueue& queue, const QueuedFilm& film, bool somebody_works);

}  // namespace septet::film
