#include "logging/study/lesson/debrief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/document/markup.hpp"
#include "engine/document/text_file.hpp"
#include "logging/study/report/impossible_numbers.hpp"
#include "logging/study/report/report_style.hpp"
#include "logging/study/report/route_chart.hpp"

namespace septet::logging {
namespace {

using document::escaped;

/// A lesson that was driven for too short a time has no mark for any task.
std::string mark_text(const std::optional<double>& mark, bool taken) {
  if (!taken) return "–";
  return mark ? fmt::format("{:.1f}", *mark) : "not seen";
}

/// Reason for a missing mark.
std::string why_none(const LessonTask& task, const LessonMarks& marks) {
  return is_of_glances(task.measure) && !marks.head_is_known ? "not known: nothing told where the head pointed"
                                                             : "no occasion";
}

std::string value_text(const LessonTask& task, double value) {
  return task.measure == LessonMeasure::collision ? fmt::format("{:.0f}", value)
                                                  : fmt::format("{:.1f} {}", value, unit_of(task.measure));
}

/// The worst first; not more than a person takes home.
std::vector<std::size_t> worst_tasks(const Lesson& lesson, const LessonMarks& marks) {
  constexpr std::size_t most = 3;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < lesson.tasks.size(); ++i)
    if (marks.tasks[i].severity != Severity::none) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    return std::pair(-static_cast<int>(marks.tasks[i].severity), *marks.tasks[i].mark);
  });
  order.resize(std::min(order.size(), most));
  return order;
}

/// The route from above with a number where each task went worst.
std::string route(const LessonMarks& marks, std::span<const Sample> samples) {
  std::map<double, std::string> numbers;  // Marks of one moment share a dot.
  for (std::size_t i = 0; i < marks.tasks.size(); ++i)
    if (marks.tasks[i].severity != Severity::none)
      numbers[marks.tasks[i].worst_s] +=
          fmt::format("{}{}", numbers[marks.tasks[i].worst_s].empty() ? "" : ", ", i + 1);
  std::vector<RouteMark> moments;
  moments.reserve(numbers.size());
  for (const auto& [time_s, text] : numbers)
    moments.push_back({time_s, text, fmt::format("{:.1f} s: task {}", time_s, text)});
  const std::string svg = route_svg(samples, moments, "Your way from above");
  if (svg.empty()) return "";
  return "<figure>" + svg +
         "<figcaption>The numbers are the tasks, where each went worst; the colour is your "
         "speed.</figcaption></figure>\n";
}

/// The last kept picture of the screen ahead before that moment; before the first one, the first.
std::string picture(double time_s, const DebriefPlace& place) {
  if (place.picture_ticks.empty() || !(time_s >= 0.0 && time_s < 1e7)) return "";
  const auto moment = static_cast<std::int64_t>(std::llround(time_s * place.ticks_per_second));
  const auto after = std::ranges::upper_bound(place.picture_ticks, moment);
  const std::int64_t tick = after == place.picture_ticks.begin() ? *after : *std::prev(after);
  return fmt::format("<img src=\"{}/{}.png\" alt=\"The screen ahead {:.0f} s after the start\" style=\"width:100%\"/>",
                     escaped(place.picture_folder), tick, static_cast<double>(tick) / place.ticks_per_second);
}

/// Number of occasions, or duration: a measure of each sample has no occasions.
std::string how_often(const LessonTask& task, const TaskMark& mark) {
  if (mark.faults == 0) return "kept";
  if (is_of_each_sample(task.measure))
    return fmt::format("not kept for {:.0f} % of the time",
                       std::ceil(100.0 * static_cast<double>(mark.faults) / static_cast<double>(mark.occasions)));
  return fmt::format("not kept {} of {} times", mark.faults, mark.occasions);
}

std::string why(const LessonTask& task, const TaskMark& mark) {
  if (task.measure == LessonMeasure::collision)
    return mark.faults == 0 ? std::string("nobody touched")
                            : fmt::format("{:.0f} touched, the last at {:.1f} s{}{}", mark.worst, mark.worst_s,
                                          mark.worst_at.empty() ? "" : "; ", mark.worst_at);
  return fmt::format("{}{}{} at {:.1f} s; asked: {} {}; {}", value_text(task, mark.worst),
                     mark.worst_at.empty() ? "" : " ", mark.worst_at, mark.worst_s,
                     is_at_most(task.measure) ? "at most" : "at least", value_text(task, task.bound),
                     how_often(task, mark));
}

}  // namespace

Expected<std::optional<std::string>> write_debrief(const SessionReader& session, const std::filesystem::path& folder,
                                                   const std::string& picture_folder, const std::string& what_if) {
  const auto& files = session.info().files;
  const auto source = std::ranges::find(files, lesson_role, &SourceFile::role);
  if (source == files.end()) return std::optional<std::string>();
  const auto lesson = read_lesson(source->content, source->name);
  if (!lesson) return tl::unexpected(lesson.error());
  auto samples = session.samples();
  if (!samples) return tl::unexpected(samples.error());
  std::vector<InputRecord> no_inputs;
  leave_out_impossible(*samples, no_inputs);
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  const LessonMarks marks = mark_lesson(*lesson, *samples, *events);
  const auto page = debrief_page(
      *lesson, marks, *samples,
      {picture_folder, picture_folder.empty() ? std::vector<std::int64_t>() : picture_ticks_in(folder / picture_folder),
       session.info().ticks_per_second, what_if});
  if (auto written = document::write_text_file(folder / "debrief.html", page); !written)
    return tl::unexpected(written.error());
  return std::optional(marks_in_a_line(*lesson, marks));
}

std::string marks_in_a_line(const Lesson& lesson, const LessonMarks& marks) {
  std::string text = marks.mark     ? fmt::format("mark {:.1f} of 10, {}", *marks.mark, outcome_of(marks))
                     : !marks.taken ? std::string(outcome_of(marks))
                                    : std::string("nothing that the lesson marks was seen");
  if (const auto worst = worst_tasks(lesson, marks); !worst.empty())
    text += fmt::format("; worst: {} ({})", lesson.tasks[worst[0]].says,
                        why(lesson.tasks[worst[0]], marks.tasks[worst[0]]));
  return text;
}

std::string debrief_page(const Lesson& lesson, const LessonMarks& marks, std::span<const Sample> samples,
                         const DebriefPlace& place) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">";
  html += fmt::format("<title>{}</title><style>{}</style></head><body><main>\n", escaped(lesson.title), report_style);
  html += fmt::format("<h1>{}</h1>\n", escaped(lesson.title));
  html += fmt::format("<p>{}</p>\n", escaped(lesson.aim));
  html +=
      "<p class=\"warning\">Before you read on: which mark would you give yourself, and why?</p>\n"
      "<details><summary>My own mark is said: show what the lesson marks</summary>\n";
  html += "<div class=\"tiles\">\n";
  html += fmt::format("<div class=\"tile\"><b>{} <small>of 10</small></b><span>mark</span></div>\n",
                      mark_text(marks.mark, marks.taken));
  html += fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", outcome_of(marks),
                      marks.taken ? fmt::format("{:.1f} is needed, and nothing dangerous", lesson.pass_mark)
                                  : fmt::format("{:g} s are needed", lesson.shortest_s));
  html += "</div>\n<h2>To take home</h2>\n";
  const auto worst = worst_tasks(lesson, marks);
  if (worst.empty()) html += "<p>Nothing was beyond its bound.</p>\n";
  for (const std::size_t i : worst)
    html += fmt::format(
        "<figure>{}<figcaption><b>{}. {}</b> {}: {}. Show it again: <code style=\"white-space: nowrap\">septet replay "
        "session.sqlite --from "
        "{:.0f}</code></figcaption></figure>\n",
        picture(marks.tasks[i].worst_s, place), i + 1, escaped(lesson.tasks[i].says), name_of(marks.tasks[i].severity),
        why(lesson.tasks[i], marks.tasks[i]), std::max(0.0, std::floor(marks.tasks[i].worst_s - 3.0)));
  if (!place.what_if.empty())
    html += fmt::format(
        "<h2>What if</h2>\n<p>{} See it: <code style=\"white-space: nowrap\">septet what-if session.sqlite --change "
        "brake:-0.5s</code></p>\n",
        escaped(place.what_if));
  html += route(marks, samples);
  html += "<h2>All tasks</h2>\n<table><tr><th></th><th>Task</th><th>Mark</th><th>Fault</th><th>Worst</th></tr>\n";
  for (std::size_t i = 0; i < lesson.tasks.size(); ++i) {
    const LessonTask& task = lesson.tasks[i];
    const TaskMark& mark = marks.tasks[i];
    html += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"value\">{}</td><td>{}</td><td>{}</td></tr>\n", i + 1,
                        escaped(task.says), mark_text(mark.mark, marks.taken), name_of(mark.severity),
                        mark.mark ? why(task, mark) : why_none(task, marks));
  }
  html +=
      "</table>\n<p class=\"soft\">10 for what was asked, less the farther from it, 0 from the lesson's tolerance on; "
      "the mark is the "
      "weighted mean of what was seen. Glances are known by the head's direction alone; where no head tracker told it, "
      "they are not seen.</p>\n";
  return html + "</details>\n</main></body></html>\n";
}

}  // namespace septet::logging
