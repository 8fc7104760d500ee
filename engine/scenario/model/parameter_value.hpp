#pragma once
/// Values of parameters and variables: texts that are of a type of the standard, and how they compare
/// (OpenSCENARIO XML 1.3, "ParameterType", "Rule").

#include <string_view>

#include "engine/scenario/model/condition.hpp"

namespace septet::scenario {

/// Whether the text is a value of this type: "integer", "int", "unsignedInt", "unsignedShort", "double",
/// "boolean", "dateTime", "string". Of an unknown type everything is.
bool is_of_type(std::string_view value, std::string_view type);

/// As numbers where both are numbers, else as texts, of which dates and times are the reason for an
/// order.
bool compare_values(Rule rule, std::string_view left, std::string_view right);

}  // namespace septet::scenario
