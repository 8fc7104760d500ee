#pragma once
/// Film by several programs that mpirun starts, restarted if it ends before the film is whole.
///
/// Open MPI is told to go on when a program dies (--enable-recovery): a dead worker costs the tiles that it was
/// tracing. If the master or mpirun itself dies, all are started again with --resume, which costs the tiles of all
/// workers: as long as starts make progress, and twice more in a row after a signal has ended one without progress. A
/// rewritten host file restarts all likewise: so machines join or leave a film that is being made.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

struct RanksOptions {
  unsigned ranks = 0;           ///< Programs; 0: one per host.
  std::filesystem::path hosts;  ///< Host file of Open MPI, a machine a line; empty: this machine alone.
  std::filesystem::path out;    ///< Value for FilmOptions.
  bool resume = false;
  bool quiet = false;  ///< No summary at the end: the film is a trial.
};

/// Makes the film by `arguments` of septet-film, without those of this file. Returns the exit status of the program
/// that made it.
Expected<int> film_by_ranks(const RanksOptions& options, std::vector<std::string> arguments);

/// Last line of the first of these programs on standard output, before its exit status.
inline constexpr const char* last_words = "septet-film has ended with status ";

}  // namespace septet::film
