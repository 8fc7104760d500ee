#pragma once
/// Results beside a session, renewed when the session has changed.

#include <filesystem>
#include <functional>

#include "engine/core/expected.hpp"
#include "engine/document/json.hpp"

namespace septet::server {

/// Renews summary and report in `folder`, if they exist, from `session`, which may lie elsewhere; `change`: further
/// removals from the summary. Errors: files that cannot be read or written, or are not Septet's.
Expected<void> renew_results(const std::filesystem::path& folder, const std::filesystem::path& session,
                             const std::function<void(document::Json&)>& change = {});

}  // namespace septet::server
