#pragma once
/// Parameters and expressions in attribute values (OpenSCENARIO XML 1.3, "Parameters", "Expressions").

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::scenario {

using Parameters = std::map<std::string, std::string, std::less<>>;

/// The value of an attribute: a `$name` is replaced, `${…}` is evaluated, anything else stays. Expressions hold
/// numbers, true, false and pi (of 1.4, but used by files of all revisions), $names, ( ), + − * / %, and or not, and
/// the functions round floor ceil sqrt pow abs sign min max sin cos tan asin acos atan. Error: the fault, without
/// `where`.
Expected<std::string> substitute(std::string_view text, const Parameters& parameters);

/// The number of the whole text, or an error.
Expected<double> parse_number(std::string_view text);

}  // namespace septet::scenario
