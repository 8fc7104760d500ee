#pragma once
/// JSON of a session's meta rows, which are not trusted.

#include <optional>
#include <string>

#include "engine/document/json.hpp"

namespace septet::logging {

/// A JSON text no deeper than Septet's own; empty if it is not one.
std::optional<document::Json> shallow_json(const std::string& text);

}  // namespace septet::logging
