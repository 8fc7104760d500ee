#pragma once
/// A page for each drive of a group, and its address from the group's page.

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/study/report/pool.hpp"

namespace septet::logging {

/// Session → address of its page, from a page in `folder`. A report beside its session is that page; if it is missing,
/// or lacks the event that the group brakes for, one is written: drives/NUMBER.html in `folder`, by the order of the
/// subjects.
Expected<std::map<std::filesystem::path, std::string>> write_drive_pages(std::span<const PooledSubject> subjects,
                                                                         const MeasureSettings& settings,
                                                                         const std::filesystem::path& folder);

}  // namespace septet::logging
