#pragma once
/// An outcome as a JSON value, for the two texts that hold it.

#include "engine/document/json.hpp"
#include "logging/session/outcome.hpp"

namespace septet::logging {

document::Json json_of(const DriveOutcome& outcome);

}  // namespace septet::logging
