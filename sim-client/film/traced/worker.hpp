#pragma once
/// Worker of a traced film: traces the runs of tiles that it gets, on its share of the machine's processors, until the
/// master's end.

#include <optional>

#include "program/machines.hpp"
#include "program/process_mark.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// Traces for the master, in a program that has session and frames. Error: the session cannot be read, or the master is
/// gone: silent for a minute, or `master_process` has ended where that can be seen.
Expected<void> trace_for_master(Machines& machines, FilmFrames& frames, const FilmOptions& options, unsigned threads,
                                const program::ProcessMark& master_process);

/// Share of a processor that this program may use, for tests and benchmarks that emulate slower machines:
/// SEPTET_FILM_PACES is a list, "0.1,0.9", whose n-th entry is program n's. Empty: no limit.
std::optional<double> pace_of_test();

/// Serves the master: whole run of a program that mpirun has started and that is not the master; film and session come
/// from the master. Returns the exit status. Prints nothing: the master does.
int serve_master(Machines& machines);

}  // namespace septet::film
