#include "command-line/command/report_command.hpp"

#include <utility>

#include <fmt/core.h>

#include "command-line/command/session_command.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/report/group_report.hpp"
#include "logging/study/report/report.hpp"
#include "program/console.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

Expected<int> report_group(const ReportOptions& options, const std::vector<fs::path>& sessions,
                           const logging::MeasureSettings& settings) {
  auto subjects = logging::pool_sessions(sessions, settings);
  if (!subjects) return tl::unexpected(subjects.error());
  logging::GroupReport report{.title = options.title.empty() ? "A group of drives" : options.title,
                              .note = {},
                              .subjects = std::move(*subjects),
                              .settings = settings};
  const fs::path folder = options.out.empty() ? fs::path("group-report") : options.out;
  const std::size_t drivers = report.subjects.size();
  if (auto written = logging::write_group_report(std::move(report), folder); !written)
    return tl::unexpected(written.error());
  program::announce(fmt::format(
      "{}: {} drivers of {} sessions, with a link to the page of each; beside it subjects.csv and subjects.json",
      (folder / "report.html").string(), drivers, sessions.size()));
  return 0;
}

}  // namespace

Expected<int> run_report(const ReportOptions& options) {
  logging::MeasureSettings settings;
  if (!options.brake_event.empty()) settings.braking_event = logging::parse_named_event(options.brake_event);
  const auto sessions = find_sessions(options.places);
  if (!sessions) return tl::unexpected(sessions.error());
  if (sessions->empty())
    return failure("there is no session.sqlite below", options.places.front().string(), "name a folder of drives");
  std::error_code ignored;
  if (sessions->size() > 1 || fs::is_directory(options.places.front(), ignored))
    return report_group(options, *sessions, settings);
  const fs::path& session = sessions->front();
  const fs::path path = options.out.empty() ? session.parent_path() / "report.html" : options.out;
  const auto written =
      logging::SessionReader::open(session).and_then([&](const logging::SessionReader& reader) -> Expected<void> {
        auto data = logging::read_report_data(reader);
        if (!data) return tl::unexpected(data.error());
        data->settings = settings;
        data->pictures =
            logging::find_drive_pictures(data->info, data->events, session.parent_path(), path.parent_path());
        return document::write_text_file(path, logging::to_html(*data));
      });
  if (!written) return tl::unexpected(written.error());
  fmt::print("{}\n", path.string());
  return 0;
}

}  // namespace septet::server
