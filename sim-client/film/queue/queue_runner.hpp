#pragma once
/// Program that makes the films of a queue, one after another.

#include "engine/core/expected.hpp"
#include "sim-client/film/queue/film_queue.hpp"

namespace septet::film {

/// Makes films until the queue is empty, or a stop signal comes: then the next call resumes the film. Does nothing
/// while another program makes them.
Expected<void> make_queued_films(const FilmQueue& queue);

/// Starts make_queued_films in a program of its own, which outlives this one and has no terminal.
Expected<void> start_making_films(const FilmQueue& queue);

}  // namespace septet::film
