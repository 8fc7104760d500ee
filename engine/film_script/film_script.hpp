#pragma once
/// Shots of a film: read from a file (sim-client/film/FILM.md), or by default of a whole session. Pure.

#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/film_script/shot.hpp"

namespace septet::film {

inline constexpr std::size_t most_shots = 1000, most_turns = 1000;  ///< Limits of a script, and of a shot.
inline constexpr std::size_t most_overlay_texts = 12;  ///< Limit of an overlay's participants, and of its notes.

/// Parses the text of a script; `name` is used in messages. Unknown keys are errors, so that a misspelt one is noticed.
Expected<Script> read_script(std::string_view toml, std::string_view name);

/// Default film: through the driver's eyes, round the driver's car with a gentle start and end, and through the eyes of
/// the nearest participant then. A session too short for that is seen through the driver's eyes alone.
Script default_script(double from_s, double to_s, double frames_per_second);

}  // namespace septet::film
