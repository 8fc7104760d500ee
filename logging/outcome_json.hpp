#pragma once
/// An outcome as a JSON value, for the two texts that hold it.

#include <nlohmann/json_fwd.hpp>

#include "logging/outcome.hpp"

namespace septet::logging {

using Json = nlohmann::ordered_json;

Json json_of(const DriveOutcome& outcome);

/// Numbers that are not finite become null.
Json number(double value);

/// The text of a value, and a line's end. Bytes that are no UTF-8 are replaced.
std::string text_of(const Json& json);

}  // namespace septet::logging
