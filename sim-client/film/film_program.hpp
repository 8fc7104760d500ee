#pragma once
/// What `septet-film` does with its command line.

#include <functional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/film_arguments.hpp"

namespace septet::film {

/// Puts "1280x720" into the options. What is wrong with it, or nothing.
std::string read_size(const std::string& text, FilmOptions& options);

/// "3 of 25 frames and 40 % of the next, 12 min left".
std::string progress_text(const FilmMade& so_far, double elapsed_s);

/// Makes the film that the command line says, in this program or, where it says so, by several that mpirun starts; tells how far it is and
/// at the end where it lies. The exit status: 1 where somebody stopped it. `words`: the same command line, for those others; `others`: as
/// make_film takes them.
Expected<int> run_film(FilmArguments arguments, std::vector<std::string> words, Machines* others);

/// The program's exit status. `work` is done by one program alone: where mpirun has started several, by the first, whom the others help
/// and whom they leave the talking; then it is given them all.
int run_alone_or_by_mpirun(const std::function<int(Machines*)>& work);

}  // namespace septet::film
