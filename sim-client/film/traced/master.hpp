#pragma once
/// Master of a traced film: deals tiles to workers, one of them a thread of its own program, keeps results, and writes
/// the pictures.
///
/// The master itself traces nothing: it sleeps until a message comes. The worker in its program uses the same
/// processors, so no processor idles for the master.

#include "program/machines.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// Traces all missing frames, until they are done or `go_on`, called as in make_film, returns false. `others`: the
/// programs that mpirun has started; null: none.
Expected<void> trace_film(const FilmOptions& options, FilmFrames& frames, const FilmFolder& folder, Machines* others,
                          FilmMade& made, const std::function<bool(const FilmMade&)>& go_on);

}  // namespace septet::film
