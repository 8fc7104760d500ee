#pragma once
/// The master of a traced film: deals tiles to workers, of which one is a thread of its own program, keeps what comes, and writes the
/// pictures.
///
/// The master itself traces nothing: it sleeps until something comes. The worker in its program uses the same processors, so none
/// is idle for the master's sake.

#include "program/machines.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// All frames that are not there yet, until all are or `go_on` says no, which hears of it as make_film says. `others`: the
/// programs that mpirun has started; null: none.
Expected<void> trace_film(const FilmOptions& options, FilmFrames& frames, const FilmFolder& folder, Machines* others,
                          FilmMade& made, const std::function<bool(const FilmMade&)>& go_on);

}  // namespace septet::film
