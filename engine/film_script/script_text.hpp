#pragma once
/// A film script as the TOML that read_script reads. Pure.

#include <string>

#include "engine/film_script/shot.hpp"

namespace septet::film {

/// Members that have their default are left out; `where` is not written. Angles are written in degrees with six
/// digits after the point, times and places to all digits.
std::string text_of(const Script& script);

}  // namespace septet::film
