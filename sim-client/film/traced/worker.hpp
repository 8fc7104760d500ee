#pragma once
/// A worker of a traced film: traces the runs of tiles that a master deals it, on its share of the machine's processors, until the
/// master says end.

#include <optional>

#include "program/machines.hpp"
#include "program/process_mark.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// With the session and its frames at hand. Error: the session cannot be read, or the master is gone: silent for a minute, or
/// `master_process` has ended where that can be seen.
Expected<void> trace_for_master(Machines& machines, FilmFrames& frames, const FilmOptions& options, unsigned threads,
                                const program::ProcessMark& master_process);

/// What share of a processor this program may use, where a test or a benchmark plays machines of other speeds: SEPTET_FILM_PACES is
/// a list, "0.1,0.9", of which the n-th is program n's. Nothing: all that there is.
std::optional<double> pace_of_test();

/// The whole of a program that mpirun has started and that is not the master, from whom it gets film and session. The exit
/// status. Says nothing: the master does.
int serve_master(Machines& machines);

}  // namespace septet::film
