#pragma once
/// What `septet-film` does with its command line.

#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Puts "1280x720" into the options. What is wrong with it, or nothing.
std::string read_size(const std::string& text, FilmOptions& options);

/// "3 of 25 frames and 40 % of the next, 12 min left".
std::string progress_text(const FilmMade& so_far, double elapsed_s);

/// Makes the film, tells how far it is and at the end where it lies. The exit status: 1 where somebody stopped it.
Expected<int> run_film(FilmOptions options);

}  // namespace septet::film
