#include "logging/study/report/summary.hpp"

#include <algorithm>
#include <cstddef>

#include <nlohmann/json.hpp>

#include "engine/document/text_file.hpp"
#include "logging/session/outcome_json.hpp"
#include "logging/study/measures/crashes.hpp"
#include "logging/study/measures/sample_steps.hpp"
#include "logging/study/report/measure_json.hpp"

namespace septet::logging {
namespace {

using document::Json, document::number;

Json optional_number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

void add_measures(const DriveMeasures& m, Json& json) {
  const LateralPositionStatistics& position = m.lateral_position;
  const bool kept_lane = position.samples > 0;
  const auto of_samples = [&](double value) { return m.samples > 0 ? number(value) : Json(nullptr); };
  json["distance_m"] = of_samples(m.distance_m);
  json["speed_mps"] = {{"mean", of_samples(m.speed_mean_mps)},
                       {"sd", of_samples(m.speed_sd_mps)},
                       {"largest", of_samples(m.speed_largest_mps)}};
  json["lateral_position_m"] = {{"mean", kept_lane ? number(position.mean_m) : Json(nullptr)},
                                {"sd", kept_lane ? number(position.sd_m) : Json(nullptr)},
                                {"samples", position.samples},
                                {"few_samples", position.samples < few_samples},
                                {"left_out_lane_change", position.excluded_lane_change},
                                {"left_out_off_lane", position.excluded_off_lane}};
  json["lateral_position_histogram"] = {{"counts", m.histogram.counts},
                                        {"right_of_lane", m.histogram.underflow},
                                        {"left_of_lane", m.histogram.overflow},
                                        {"off_every_lane", m.histogram.off_lane}};
  json["time_headway_s"] = {{"median", optional_number(m.following.headway.median_s)},
                            {"smallest", optional_number(m.following.headway.smallest_s)},
                            {"following_s", of_samples(sample_interval_s * static_cast<double>(m.following.samples))}};
  json["lane_changes"] = m.has_lanes() ? Json(m.lane_changes.size()) : Json(nullptr);
  json["mirror_glances"] = m.head_is_known ? Json(m.glances.size()) : Json(nullptr);
  json["measures"] = measures_json(m, {});
}

/// The words of a record as they stand in the log (FORMAT.md): numbers as numbers, the pulse as pairs.
Json crash_json(const CrashRecord& crash) {
  Json json = {{"first", crash.first}};
  CrashRecord in_words = crash;
  if (crash.second) in_words.stands.clear();  // A name may hold blanks.
  const std::string text = text_of(in_words);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size()), equals = text.find('=', at);
    const std::string key = text.substr(at, equals - at), value = text.substr(equals + 1, end - equals - 1);
    at = end + 1;
    if (key == "stands")
      json[key] = crash.stands;
    else if (key != "pulse_ns")
      json[key] = Json::parse(value);
  }
  if (crash.second && !crash.stands.empty()) json["what"] = crash.stands;
  for (const Vec2& push : crash.pulse_ns) json["pulse_ns"].push_back({number(push.x), number(push.y)});
  return json;
}

}  // namespace

Json answers_json(const std::vector<QuestionnaireRecord>& answers) {
  Json rows = Json::array();
  for (const QuestionnaireRecord& answer : answers)
    rows.push_back({{"item", answer.item},
                    {"answer", answer.answer ? Json(*answer.answer) : Json(nullptr)},
                    {"value", optional_number(answer.value)},
                    {"observed_s", number(answer.observed_s)},
                    {"censored", answer.censored},
                    {"reason", answer.reason}});
  return rows;
}

Expected<DriveSummary::FromLog> summarise_log(const SessionReader& reader) {
  const auto missing = reader.missing_ticks();
  if (!missing) return tl::unexpected(missing.error());
  const auto records = read_drive_records(reader);
  if (!records) return tl::unexpected(records.error());
  const auto answers = reader.questionnaire();
  if (!answers) return tl::unexpected(answers.error());
  DriveSummary::FromLog log{*missing, compute_drive_measures(*records), {}, *answers};
  leave_out_impossible(log.answers, log.measures.impossible);
  for (const Event& event : records->events) ++log.events[event.kind];
  log.crashes = find_crashes(records->events);
  return log;
}

std::string to_json(const DriveSummary& s) {
  Json json = {{"version", summary_version},
               {"scenario", s.scenario},
               {"rig", s.rig},
               {"vehicle", s.vehicle},
               {"participant", s.participant},
               {"subject", meta_of(s.subject)},
               {"seed", s.seed},
               {"parameters", Json(s.parameters)}};
  json.update(json_of(s.outcome));
  json["log"]["missing_ticks"] = s.log ? Json(s.log->missing_ticks) : Json(nullptr);
  if (s.log) {
    const ImpossibleNumbers& impossible = s.log->measures.impossible;
    json["log"]["impossible"] = impossible.any() ? Json(told(impossible)) : Json(nullptr);
    add_measures(s.log->measures, json);
    json["events"] = s.log->events;
    json["crashes"] = Json::array();
    for (const CrashRecord& crash : s.log->crashes) json["crashes"].push_back(crash_json(crash));
    json["answers"] = answers_json(s.log->answers);
  }
  return document::text_of(json);
}

Expected<void> write_summary(const std::filesystem::path& path, const DriveSummary& summary) {
  return document::write_text_file(path, to_json(summary));
}

}  // namespace septet::logging
