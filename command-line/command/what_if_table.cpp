#include "command-line/command/what_if_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "engine/document/chart_page.hpp"
#include "engine/document/csv_cell.hpp"
#include "engine/math/speed_units.hpp"

namespace septet::server {
namespace {

std::string number_cell(const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : ""; }

std::string row(const std::string& variant, const RanVariant& ran) {
  const VariantOutcome& outcome = ran.outcome;
  const auto& met = outcome.collision;
  std::string text = fmt::format("{},{},{},{},", variant, document::csv_cell(ran.changes),
                                 ran.value ? fmt::format("{}", *ran.value) : "", met ? 1 : 0);
  if (met)
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},", document::csv_cell(met->with),
                        static_cast<double>(met->tick) / simulation::tick_rate_hz, met->closing_speed_mps,
                        met->delta_v_mps);
  else
    text += ",,,,";
  return text + fmt::format("{},{},{},{},{:016x}\n", number_cell(outcome.stopped_s), number_cell(outcome.least_gap_m),
                            number_cell(outcome.before_place_m), outcome.last_tick, outcome.state_hash);
}

bool collides(const RanVariant& ran) { return ran.outcome.collision.has_value(); }

}  // namespace

std::string variants_csv(const WhatIf& what_if, std::span<const RanVariant> variants) {
  std::string text =
      "variant,change,value,collides,with,collision_s,closing_speed_mps,delta_v_mps,stopped_s,least_gap_m,"
      "before_place_m,last_tick,state_hash\n";
  text += row("logged", {.changes = "", .value = {}, .outcome = what_if.as_logged});
  for (std::size_t i = 0; i < variants.size(); ++i) text += row(std::to_string(i + 1), variants[i]);
  return text;
}

std::string share_sentence(std::span<const RanVariant> variants) {
  const auto hits = std::ranges::count_if(variants, collides);
  return fmt::format("{} of {} variants collide ({:.1f} %)", hits, variants.size(),
                     100.0 * static_cast<double>(hits) / static_cast<double>(variants.size()));
}

std::string range_sentence(std::span<const RanVariant> variants) {
  const std::string text = share_sentence(variants);
  const auto hits = static_cast<std::size_t>(std::ranges::count_if(variants, collides));
  if (hits == 0 || hits == variants.size()) return text;
  // One end of the range is free of collisions, or none is.
  const auto first_free = std::ranges::find_if_not(variants, collides);
  const auto after_free = std::find_if(first_free, variants.end(), collides);
  if (first_free == variants.begin()) {
    const auto last = std::prev(after_free);
    return text + fmt::format("; none from {} to {}", variants.front().changes, last->changes);
  }
  if (after_free == variants.end())
    return text + fmt::format("; none from {} to {}", first_free->changes, variants.back().changes);
  return text + "; those without lie between others";
}

std::string range_plot(const WhatIf& what_if, const ChangeRange& range, std::span<const RanVariant> variants) {
  const char* const unit = range.first.kind == ChangeKind::shift   ? "shift, s"
                           : range.first.kind == ChangeKind::scale ? "factor"
                                                                   : "value";
  const std::string x_label = fmt::format("{}: {}", range.first.input->name, unit);
  document::Series speeds{.name = "", .points = {}}, gaps{.name = "", .points = {}};
  for (const RanVariant& ran : variants) {
    const double x = ran.value.value_or(0.0), none = std::numeric_limits<double>::quiet_NaN();
    const auto& met = ran.outcome.collision;
    speeds.points.push_back({x, met ? kmh_per_mps * met->closing_speed_mps : 0.0});
    gaps.points.push_back({x, met ? 0.0 : ran.outcome.least_gap_m.value_or(none)});
  }
  document::ChartPage page{.title = "What if", .lines = {range_sentence(variants)}, .charts = {}, .notes = {}};
  if (what_if.logged) page.lines.push_back("As logged: " + collision_text(what_if.logged->met));
  page.charts.push_back(
      {.title = "Closing speed of the collision; 0: none", .x_label = x_label, .y_label = "km/h", .series = {speeds}});
  if (what_if.logged && what_if.logged->met.other)
    page.charts.push_back({.title = fmt::format("Least gap to {}", what_if.logged->met.with),
                           .x_label = x_label,
                           .y_label = "m",
                           .series = {gaps}});
  return document::to_svg(page);
}

}  // namespace septet::server
