#pragma once
/// `septet accident`: plans the film of an accident from a session, makes it with subtitles, stills, a page and a
/// manifest, and checks one.

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

struct AccidentOptions {
  /// Session, size, rate, renderer; `out` is the folder of everything, new or empty, with `resume` that of the same film.
  FilmOptions film;
  std::optional<std::size_t> event;  ///< Number of the contact, from 1; empty: the first.
  std::filesystem::path plan;        ///< Write the storyboard there and stop; empty: make the film.
  std::filesystem::path check;       ///< Check the film of this folder, or of this file in it; empty: make one.
  std::string voice;                 ///< Command of a narrator (narration.hpp); empty: none.
};

/// Prints progress and results. Returns the exit status: 1 where a check has found something, or a person stopped it.
Expected<int> run_accident(const AccidentOptions& options);

/// All differences between a film and its record, one line each; empty: none were found. `drawn_again`: numbers of the
/// frames that were compared with the session anew.
struct AccidentCheck {
  std::vector<std::string> differences;
  std::vector<std::uint64_t> drawn_again;
};
/// `session`: where it lies now; empty: where the manifest says. Error: there is no manifest, or it is not one.
Expected<AccidentCheck> check_accident(const std::filesystem::path& film, const std::filesystem::path& session);

}  // namespace septet::film
