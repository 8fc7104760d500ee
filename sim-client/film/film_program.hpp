#pragma once
/// Execution of the command line of `septet-film`.

#include <functional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/film_arguments.hpp"

namespace septet::film {

/// Parses "1280x720" into the options. Returns the fault, or an empty string.
std::string read_size(const std::string& text, FilmOptions& options);

/// "3 of 25 frames and 40 % of the next, 12 min left".
std::string progress_text(const FilmMade& so_far, double elapsed_s);

/// Makes the film of the command line, in this program or by several that mpirun starts; prints progress and at the end
/// the place. Returns the exit status; 1 if a person stopped it. `words`: the same command line, for the other
/// programs; `others`: as in make_film.
Expected<int> run_film(FilmArguments arguments, std::vector<std::string> words, Machines* others);

/// Runs the program and returns its exit status. `work` is called in one program only: under mpirun in the first, with
/// the machines of the others, which help it and print nothing.
int run_alone_or_by_mpirun(const std::function<int(Machines*)>& work);

}  // namespace septet::film
