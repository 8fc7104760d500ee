#pragma once
/// Values of parameters and variables: texts with a type of the standard, and their comparison (OpenSCENARIO XML 1.3,
/// "ParameterType", "Rule").

#include <string_view>

#include "engine/scenario/model/condition.hpp"

namespace septet::scenario {

/// True where the text is a value of this type: "integer", "int", "unsignedInt", "unsignedShort", "double", "boolean",
/// "dateTime", "string". An unknown type accepts every text.
bool is_of_type(std::string_view value, std::string_view type);

/// Compares as numbers where both are numbers, else as texts, whose order serves dates and times.
bool compare_values(Rule rule, std::string_view left, std::string_view right);

}  // namespace septet::scenario
