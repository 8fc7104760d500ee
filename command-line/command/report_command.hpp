#pragma once
/// `septet report SESSION…`: report.html from a session file, or a page, a table and JSON from many.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct ReportOptions {
  std::vector<std::filesystem::path> places;  ///< Sessions, and folders with sessions anywhere below.
  std::filesystem::path out;  ///< For one session a file, for many a folder. Empty: beside the session; group-report.
  std::string title, brake_event;  ///< KIND or KIND:TEXT of the events to brake for.
};

Expected<int> run_report(const ReportOptions& options);

}  // namespace septet::server
