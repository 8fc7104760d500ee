#pragma once
/// An outcome as a JSON value, for the two texts that hold it, and a hash as both have it.

#include <cstdint>
#include <string>

#include "engine/document/json.hpp"
#include "logging/session/outcome.hpp"

namespace septet::logging {

document::Json json_of(const DriveOutcome& outcome);

/// Sixteen hexadecimal digits: a number of JSON holds 53 bits.
std::string hash_digits(std::uint64_t hash);

}  // namespace septet::logging
