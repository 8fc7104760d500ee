#pragma once
/// The command line of `septet-film`, as options and back: a film that waits in a queue is kept as its words.

#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/traced/ranks.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace septet::film {

/// What the command line says. The parser writes it, so it must stay where it is.
struct FilmArguments {
  FilmOptions film;
  RanksOptions ranks;
  bool by_ranks = false;      ///< Programs are to be started: `ranks` says which.
  bool one_of_ranks = false;  ///< Said by film_by_ranks alone.
  double within_s = 0.0;      ///< As many samples as there is time for; 0: as many as are asked for.
  std::string renderer = "raster", exr = "none", filter = "quadratic", schedule = "ours";
};

/// Tells the parser of all options of a film.
void add_film_options(CLI::App& app, FilmArguments& arguments);

/// After the parser: what it has read as words becomes options. Error: words that are no film's.
Expected<void> settle(const CLI::App& app, FilmArguments& arguments);

}  // namespace septet::film
