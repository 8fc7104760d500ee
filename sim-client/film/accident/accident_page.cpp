#include "sim-client/film/accident/accident_page.hpp"

#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/document/chart.hpp"
#include "engine/document/markup.hpp"
#include "engine/math/speed_units.hpp"
#include "logging/study/report/report_style.hpp"
#include "sim-client/film/overlay/overlay_content.hpp"

namespace septet::film {
namespace {

using document::escaped;

std::string_view words_of(MovedBy moved_by) {
  switch (moved_by) {
    case MovedBy::person:
      return "a person's controls (measured), car computed";
    case MovedBy::simulated_driver:
      return "a simulated driver, car computed";
    case MovedBy::table:
      return "a table (given), car computed on its springs and after an impact";
    case MovedBy::scenario:
      return "the scenario (assumed) until an impact";
    case MovedBy::traffic:
      return "the traffic model (computed)";
    case MovedBy::editor:
      return "an editor of the scene (logged)";
  }
  return "";
}

std::string speed_chart(const AccidentFacts& facts, const AccidentPlan& plan) {
  document::LineChart chart{.title = "Speeds", .x_label = "simulated time, s", .y_label = "speed, km/h"};
  for (const Involved& one : facts.involved) {
    document::Series series{
        printable(name_of(one), 40), {}, chart.series.empty() ? document::Stroke::line : document::Stroke::dashed};
    for (const WayPoint& at : one.way) series.points.push_back({at.time_s, kmh_per_mps * at.speed_mps});
    chart.series.push_back(std::move(series));
  }
  if (plan.script.overlay.contact_s) chart.marks.push_back({*plan.script.overlay.contact_s, "✕", plan.title});
  return document::to_svg(chart);
}

std::string figure_rows(const AccidentFacts& facts, const AccidentPlan& plan) {
  std::string rows;
  for (const Figure& figure : plan.figures)
    rows += fmt::format("<tr><td>{}</td><td>{:.2f} {}</td><td>{}</td></tr>\n", escaped(figure.name), figure.value,
                        escaped(figure.unit), escaped(figure.origin));
  for (const Involved& one : facts.involved)
    rows += fmt::format("<tr><td>{} ({})</td><td></td><td>moved by {}</td></tr>\n",
                        escaped(printable(name_of(one), 40)), vehicle_models()[one.model].name, words_of(one.moved_by));
  return rows;
}

}  // namespace

std::string accident_page(const AccidentFacts& facts, const AccidentPlan& plan, const std::vector<Still>& stills,
                          const std::string& film, const std::string& version) {
  std::string body = fmt::format("<h1>{}</h1>\n", escaped(plan.title));
  body += "<table>\n<tr><th>figure</th><th>value</th><th>origin</th></tr>\n" + figure_rows(facts, plan) + "</table>\n";
  for (const std::string& note : plan.script.overlay.notes) body += fmt::format("<p>{}</p>\n", escaped(note));
  body += "<div class=\"stills\">\n";
  for (const Still& still : stills)
    body += fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{:.2f} s, {}. {}</figcaption></figure>\n",
                        escaped(still.file), escaped(plan.script.shots[still.shot].title), still.instant_s,
                        escaped(plan.script.shots[still.shot].title), escaped(plan.words[still.shot]));
  body += "</div>\n" + speed_chart(facts, plan);
  for (const std::string& why : plan.left_out) body += fmt::format("<p>Left out: {}.</p>\n", escaped(why));
  body += fmt::format(
      "<p>A simulation, not a recording. Film: <a href=\"{0}\">{0}</a>; inputs, hashes and versions: accident.json. "
      "Septet {1}.</p>\n",
      escaped(film), escaped(version));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{}</title>\n<style>{}.stills {{ display: grid; grid-template-columns: 1fr "
      "1fr; gap: 12px; }} figure {{ margin: 0; break-inside: avoid; }} figure img {{ width: 100%; }} table "
      "{{ break-inside: avoid; }} @page {{ size: A4; margin: 15mm; "
      "}}</style></head>\n<body><main>\n{}</main></body></html>\n",
      escaped(plan.title), logging::report_style, body);
}

}  // namespace septet::film
