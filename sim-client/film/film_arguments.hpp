#pragma once
/// Command line of `septet-film`, as options and back: a film that waits in a queue is kept as its words.

#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/traced/ranks.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace septet::film {

/// Parsed command line. The parser holds pointers into it, so it must not move.
struct FilmArguments {
  FilmOptions film;
  RanksOptions ranks;
  bool by_ranks = false;      ///< Programs are to be started: `ranks` holds their number.
  bool one_of_ranks = false;  ///< Set by film_by_ranks alone.
  double within_s = 0.0;      ///< Time limit that the number of samples is chosen for; 0: `samples` as given.
  std::string renderer = "raster", exr = "none", filter = "quadratic", schedule = "ours";
};

/// "traced" or "raster".
FilmRenderer renderer_named(const std::string& name);

/// Declares all options of a film to the parser.
void add_film_options(CLI::App& app, FilmArguments& arguments);

/// After parsing: converts words to options. Error: words that are not a film's.
Expected<void> settle(const CLI::App& app, FilmArguments& arguments);

}  // namespace septet::film
