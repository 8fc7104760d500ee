#pragma once
/// A film by several programs that mpirun starts, which is started anew where it ends before the film is whole.
///
/// Open MPI is told to go on where a program dies (--enable-recovery): a worker that dies costs what it had in its hands. Where the
/// master or mpirun itself dies, all are started again with --resume, which costs the tiles in all hands: while starts bring
/// something, and twice more in a row where a signal has ended one that brought nothing. The same is done when the file of hosts is
/// written anew: so machines join a film that is being made, or leave it.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::film {

struct RanksOptions {
  unsigned ranks = 0;           ///< Programs; 0: one for each host.
  std::filesystem::path hosts;  ///< In Open MPI's words, a machine a line; empty: this machine alone.
  std::filesystem::path out;    ///< As FilmOptions.
  bool resume = false;
  bool quiet = false;  ///< Nothing is said at the end: the film is a trial.
};

/// The film by `arguments` of septet-film, without those of this file. The exit status of the program that made it.
Expected<int> film_by_ranks(const RanksOptions& options, std::vector<std::string> arguments);

/// What the first of these programs says last on its standard output, before its exit status.
inline constexpr const char* last_words = "septet-film has ended with status ";

}  // namespace septet::film
