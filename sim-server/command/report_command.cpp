#include "sim-server/command/report_command.hpp"

#include <fmt/core.h>

#include "logging/report/report.hpp"
#include "logging/session_reader.hpp"

namespace septet::server {

Expected<int> run_report(const std::string& session, const std::filesystem::path& out) {
  const auto path = out.empty() ? std::filesystem::path(session).parent_path() / "report.html" : out;
  const auto written = logging::SessionReader::open(session).and_then(
      [&](const logging::SessionReader& reader) { return logging::write_report(reader, path); });
  if (!written) return tl::unexpected(written.error());
  fmt::print("{}\n", path.string());
  return 0;
}

}  // namespace septet::server
