#include "logging/study/report/crash_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/document/chart.hpp"
#include "engine/document/markup.hpp"
#include "engine/math/gravity.hpp"
#include "engine/math/speed_units.hpp"
#include "logging/study/measures/crashes.hpp"

namespace septet::logging {
namespace {

using document::escaped;

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// A number with a minus sign instead of a hyphen.
std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  return value < 0.0 && text.find_first_not_of("0.") != std::string::npos ? "−" + text : text;
}

/// A cell of a number that may be missing.
std::string cell(const std::optional<double>& value, double unit, int decimals) {
  return fmt::format("<td class=\"value\">{}</td>", value ? number_text(unit * *value, decimals) : "–");
}

/// What stands and a solid have their name in the record.
std::string called_second(const CrashRecord& crash, const ParticipantNames& names) {
  return crash.second && crash.stands.empty() ? called(names, *crash.second) : crash.stands;
}

std::string row(const std::string& who, const CrashedBody& body) {
  const auto speed = [](const std::optional<Vec2>& v) { return v ? std::optional(glm::length(*v)) : std::nullopt; };
  return fmt::format("<tr><td class=\"name\">{}</td>{}{}{}<td>{}</td>{}{}{}</tr>\n", escaped(who),
                     cell(body.mass_kg, 1.0, 0), cell(speed(body.before_mps), kmh_per_mps, 1),
                     cell(speed(body.delta_v_mps), kmh_per_mps, 1),
                     body.principal_direction_rad ? whence(*body.principal_direction_rad) : "–",
                     cell(body.principal_direction_rad, degrees_per_radian, 0),
                     cell(body.delta_yaw_rate_radps, degrees_per_radian, 0), cell(body.crush_m, 1.0, 2));
}

std::string energies(const CrashRecord& crash) {
  if (!crash.ledger) return "<p>The energies were not measured.</p>\n";
  const CrashLedger& l = *crash.ledger;
  const auto kilo = [](double energy_j) { return cell(energy_j, 1e-3, 2); };
  return fmt::format(
      "<table><tr><th>Kinetic energy before, kJ</th><th>after</th><th>lost</th><th>of it crush</th><th>friction</th>"
      "<th>debris</th><th>wheels, other contacts</th><th>missing, %</th></tr>\n<tr>{}{}{}{}{}{}{}{}</tr></table>\n",
      kilo(l.kinetic_before_j), kilo(l.kinetic_after_j), kilo(l.kinetic_before_j - l.kinetic_after_j), kilo(l.crush_j),
      kilo(l.friction_j), kilo(l.debris_j), kilo(l.wheels_j), cell(share_missing(l), 100.0, 3));
}

std::string pulse_chart(const CrashRecord& crash, double ticks_per_second, const ParticipantNames& names) {
  document::LineChart chart;
  chart.title = "Pulse";
  chart.x_label = "since the touch, ms";
  chart.y_label = "acceleration by the contact, g";
  const auto add = [&](const std::string& who, const CrashedBody& body, document::Stroke stroke) {
    if (!body.mass_kg || !(*body.mass_kg > 0.0)) return;
    document::Series line{who, {}, stroke};
    for (std::size_t i = 0; i < crash.pulse_ns.size(); ++i)
      line.points.push_back({1e3 * (static_cast<double>(i) + 0.5) / ticks_per_second,
                             glm::length(crash.pulse_ns[i]) * ticks_per_second / *body.mass_kg / gravity_mps2});
    chart.series.push_back(std::move(line));
  };
  add(called(names, crash.first), crash.of_first, document::Stroke::line);
  if (crash.second) add(called_second(crash, names), crash.of_second, document::Stroke::dashed);
  if (crash.pulse_ns.size() < 2 || chart.series.empty()) return "";
  return fmt::format("<figure>{}<figcaption>Means of each tick. Wheels are not in it.</figcaption></figure>\n",
                     document::to_svg(chart));
}

std::string told(const CrashRecord& crash, double ticks_per_second, const ParticipantNames& names) {
  const std::string first = called(names, crash.first), other = called_second(crash, names);
  std::string html = fmt::format("<h3>{:.2f} s: {} and {}</h3>\n<p>The surfaces met at {:.1f} km/h along their normal",
                                 static_cast<double>(crash.tick) / ticks_per_second, escaped(first), escaped(other),
                                 kmh_per_mps * crash.closing_speed_mps);
  if (crash.overlap_m && crash.overlap_share)
    html += fmt::format(", overlapping by {:.2f} m, {:.0f} % of the narrower one", *crash.overlap_m,
                        100.0 * *crash.overlap_share);
  if (crash.depth_m) html += fmt::format(", and their outlines came {:.2f} m into each other", *crash.depth_m);
  html += fmt::format("; the last push came {:.0f} ms later{}.</p>\n",
                      1e3 * static_cast<double>(crash.ticks) / ticks_per_second,
                      crash.is_unfinished ? ", when the drive ended: what it came to is not whole" : "");
  if (crash.contact_s && *crash.contact_s >= lasting_contact_s)
    html += fmt::format("<p>That is the impact; they stayed in contact for {}.</p>\n", contact_text(*crash.contact_s));
  html +=
      "<table><tr><th>Who</th><th>Mass, kg</th><th>Before, km/h</th><th>ΔV, km/h</th><th>Whence</th><th>Principal "
      "direction, °</th><th>Change of yaw rate, °/s</th><th>Crush, m</th></tr>\n";
  html += row(first, crash.of_first);
  if (crash.second) html += row(other, crash.of_second);
  return html + "</table>\n" + energies(crash) + pulse_chart(crash, ticks_per_second, names);
}

}  // namespace

std::string crash_section(std::span<const CrashRecord> crashes, double ticks_per_second,
                          const ParticipantNames& names) {
  if (crashes.empty()) return "";
  std::string html =
      "<h2>Crashes</h2>\n<p class=\"soft\">ΔV is the change of the mass centre's velocity from the touch to the last "
      "push, wheels included, but of a vehicle that met a person or a two-wheeler. The principal direction is whence "
      "the blow came: 0 from straight ahead, 90 from the "
      "left. What both lose of their kinetic energy is told by parts, each reckoned by itself. A dash: not "
      "measured.</p>\n";
  for (const CrashRecord& crash : crashes.first(std::min(crashes.size(), most_shown_crashes)))
    html += told(crash, ticks_per_second, names);
  if (crashes.size() > most_shown_crashes)
    html += fmt::format("<p>And {} more.</p>\n", crashes.size() - most_shown_crashes);
  return html;
}

}  // namespace septet::logging
