#pragma once
/// What `septet-film` does with its command line.

#include <functional>
#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Puts "1280x720" into the options. What is wrong with it, or nothing.
std::string read_size(const std::string& text, FilmOptions& options);

/// "3 of 25 frames and 40 % of the next, 12 min left".
std::string progress_text(const FilmMade& so_far, double elapsed_s);

/// Makes the film, tells how far it is and at the end where it lies. The exit status: 1 where somebody stopped it.
/// `others`: as make_film takes them.
Expected<int> run_film(FilmOptions options, Machines* others);

/// The program's exit status. `work` is done by one program alone: where mpirun has started several, by the first, whom the others help
/// and whom they leave the talking; then it is given them all.
int run_alone_or_by_mpirun(const std::function<int(Machines*)>& work);

}  // namespace septet::film
