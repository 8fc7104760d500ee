#pragma once
/// What was told of a session beside it, told again when the session has changed.

#include <filesystem>
#include <functional>

#include "engine/core/expected.hpp"
#include "engine/document/json.hpp"

namespace septet::server {

/// Summary and report in `folder`, where they are there, tell again what `session` tells now, which may lie elsewhere; `change`: what else the
/// summary is to lose. Errors: files that cannot be read or written, or are none of ours.
Expected<void> renew_results(const std::filesystem::path& folder, const std::filesystem::path& session,
                             const std::function<void(document::Json&)>& change = {});

}  // namespace septet::server
