#include "command-line/command/renewed_results.hpp"

#include <system_error>

#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/report/report.hpp"
#include "logging/study/report/summary.hpp"

namespace septet::server {
namespace fs = std::filesystem;

Expected<void> renew_results(const fs::path& folder, const fs::path& session,
                             const std::function<void(document::Json&)>& change) {
  std::error_code ignored;
  const fs::path summary = folder / "summary.json", report = folder / "report.html";
  if (!fs::exists(summary, ignored) && !fs::exists(report, ignored)) return {};
  const auto reader = logging::SessionReader::open(session);
  if (!reader) return tl::unexpected(reader.error());
  if (fs::exists(summary, ignored)) {
    const auto text = read_regular_file(summary);
    auto json = text ? document::Json::parse(*text, nullptr, false) : document::Json();
    if (!json.is_object()) return failure("it is no summary", summary.string(), "remove it");
    const auto answers = reader->questionnaire();
    if (!answers) return tl::unexpected(answers.error());
    json["answers"] = logging::answers_json(*answers);
    if (change) change(json);
    if (auto written = document::write_text_file(summary, document::text_of(json)); !written) return written;
  }
  if (fs::exists(report, ignored)) return logging::write_report(*reader, report);
  return {};
}

}  // namespace septet::server
