#pragma once
/// The sentence that a debrief offers after a collision: what an earlier braking would have made of it.

#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::server {

/// "Half a second earlier on the brake, and you would have stopped 3.0 m before 3 parked (van)." Where that is not
/// enough, a second one for a whole second; where the brake was not pressed, for 80 % of it from one second before on.
/// Empty: no collision, or one in the first two seconds; nobody drove; a session that cannot be run again, since it holds samples
/// alone or another program moved its traffic. Error: it was altered, or is of another build. Takes some seconds.
Expected<std::optional<std::string>> braking_earlier(const logging::SessionReader& session);

}  // namespace septet::server
