#pragma once
/// A page for each drive of a group, and where the group's page finds it.

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/report/pool.hpp"

namespace septet::logging {

/// Session → address of its page, from a page in `folder`. A report that lies beside its session is that page; where there is none, or
/// where it would not know the event that the group brakes for, one is written: drives/NUMBER.html in `folder`, by the order of the subjects.
Expected<std::map<std::filesystem::path, std::string>> write_drive_pages(std::span<const PooledSubject> subjects,
                                                                         const MeasureSettings& settings,
                                                                         const std::filesystem::path& folder);

}  // namespace septet::logging
