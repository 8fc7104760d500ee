#pragma once
/// The program that makes the films of a queue, one after another.

#include "engine/core/expected.hpp"
#include "sim-client/film/queue/film_queue.hpp"

namespace septet::film {

/// Makes films until none waits, or a stop signal comes: then the film goes on when this is called again. Does nothing where
/// another program makes them.
Expected<void> make_queued_films(const FilmQueue& queue);

/// Starts that in a program of its own, which goes on after this one, without a terminal.
Expected<void> start_making_films(const FilmQueue& queue);

}  // namespace septet::film
