#pragma once
/// Which shots a film has: read from a file (sim-client/film/FILM.md), or a film of a whole session without one. Pure.

#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/film_script/shot.hpp"

namespace septet::film {

inline constexpr std::size_t most_shots = 1000, most_turns = 1000;  ///< Of a script, and of a shot.

/// Parses the text of a script; `name` is used in messages. Unknown keys are errors, so that a misspelt one is noticed.
Expected<Script> read_script(std::string_view toml, std::string_view name);

/// Through the driver's eyes, round the driver's car with a gentle start and end, and through the eyes of whoever is nearest then.
/// What is too short for that is seen through the driver's eyes alone.
Script default_script(double from_s, double to_s, double frames_per_second);

}  // namespace septet::film
