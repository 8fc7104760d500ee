#pragma once
/// Films waiting to be made, one after another, each with all the machines that it names: a folder that outlives every
/// program.
///
/// A film is a file, NNNNNN.json: the words of its command line, its working folder, and its progress. Only the program
/// that makes films changes it, which holds a lock (flock) on the folder; NNNNNN.cancel beside it asks that program to
/// leave the film, and NNNNNN.log is the film program's output. A killed program leaves an unfinished film: the next
/// one resumes it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

enum class FilmState : std::uint8_t { waiting, begun, made, failed, cancelled };

struct QueuedFilm {
  std::uint64_t number = 0;            ///< Counted from 1; its name in the folder.
  std::vector<std::string> arguments;  ///< Arguments of septet-film.
  std::filesystem::path said_in;       ///< Base of their relative paths.
  std::filesystem::path out;
  FilmState state = FilmState::waiting;
  std::string last_word;  ///< Reason of a failure.
  double took_s = 0.0;    ///< Time so far, without the present start.
};

class FilmQueue {
 public:
  /// Makes the folder, for this user alone.
  static Expected<FilmQueue> open(std::filesystem::path folder);

  const std::filesystem::path& path() const { return path_; }
  /// All films, by number. Files that are not films of a queue are skipped and counted.
  std::vector<QueuedFilm> films() const;
  std::size_t nonsense() const { return nonsense_; }
  /// Adds the film under the next number, also beside concurrent callers.
  Expected<std::uint64_t> add(const QueuedFilm& film);
  Expected<void> write(const QueuedFilm& film) const;
  Expected<void> ask_to_cancel(std::uint64_t number) const;
  bool is_to_be_cancelled(std::uint64_t number) const;
  /// True while it waits or is being made, without a request to cancel it.
  bool is_to_be_made(const QueuedFilm& film) const;
  std::filesystem::path log(std::uint64_t number) const;

  /// Lock held by the program that makes films, until it ends. Empty: another holds it.
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

/// Default folder of a user's queue: septet/films below XDG_STATE_HOME, or below ~/.local/state.
std::filesystem::path usual_queue_folder();

/// Status of a film in a line: "2  being made  out/chase.mp4  12 of 100 frames, 5 min left".
std::string status_line(const FilmQueue& queue, const QueuedFilm& film, bool somebody_works);

}  // namespace septet::film
