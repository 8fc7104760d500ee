#include "logging/study/report/drive_pages.hpp"

#include <system_error>

#include <fmt/core.h>

#include "engine/document/text_file.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/report/page_link.hpp"
#include "logging/study/report/report.hpp"

namespace septet::logging {
namespace fs = std::filesystem;

Expected<std::map<fs::path, std::string>> write_drive_pages(std::span<const PooledSubject> subjects,
                                                            const MeasureSettings& settings, const fs::path& folder) {
  std::map<fs::path, std::string> pages;
  int number = 0;
  for (const PooledSubject& subject : subjects)
    for (const PooledDrive& drive : subject.drives)
      for (const fs::path& session : drive.sessions) {
        ++number;
        std::error_code error;
        const fs::path beside = session.parent_path() / "report.html";
        const bool is_the_groups = fs::equivalent(session.parent_path() / ".", folder, error);
        if (!settings.braking_event && !is_the_groups && fs::is_regular_file(beside, error)) {
          pages[session] = page_link(beside, folder);
          continue;
        }
        const fs::path page = folder / "drives" / fmt::format("{}.html", number);
        fs::create_directories(page.parent_path(), error);
        const auto reader = SessionReader::open(session);
        if (!reader) return tl::unexpected(reader.error());
        auto data = read_report_data(*reader);
        if (!data) return tl::unexpected(data.error());
        data->settings = settings;
        data->pictures = find_drive_pictures(data->info, data->events, session.parent_path(), page.parent_path());
        if (auto written = document::write_text_file(page, to_html(*data)); !written)
          return tl::unexpected(written.error());
        pages[session] = page_link(page, folder);
      }
  return pages;
}

}  // namespace septet::logging
