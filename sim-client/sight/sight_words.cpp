#include "sim-client/sight/sight_words.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/document/chart_page.hpp"

namespace septet::sight {
namespace {

/// Less light than this is worth a word.
constexpr double clear_from = 0.95;
/// Gaps shorter than this are not told: nobody forgets within it.
constexpr double short_gap_s = 0.5;

std::vector<const SightRow*> rows_of(const SessionSight& sight, std::size_t pair) {
  std::vector<const SightRow*> rows;
  for (const SightRow& row : sight.rows)
    if (row.pair == pair) rows.push_back(&row);
  return rows;
}

const SightRow& row_at(const std::vector<const SightRow*>& rows, Tick tick) {
  return **std::ranges::find(rows, tick, &SightRow::tick);
}

/// Stretches with all gaps but those of `least_gap` ticks or more closed.
std::vector<Stretch> without_short_gaps(const std::vector<Stretch>& stretches, Tick least_gap) {
  std::vector<Stretch> merged;
  for (const Stretch& stretch : stretches)
    if (!merged.empty() && stretch.first - merged.back().last <= least_gap)
      merged.back().last = stretch.last;
    else
      merged.push_back(stretch);
  return merged;
}

/// End of what a sentence tells: the contact, or the instant at which the two were nearest. Later sights play no part in
/// either.
double end_s_of(const std::vector<const SightRow*>& rows, const SessionSight& sight, const Looking& looking) {
  const SightRow& nearest = **std::ranges::min_element(rows, {}, &SightRow::distance_m);
  return looking.contact_s.value_or(static_cast<double>(nearest.tick) * sight.tick_s);
}

/// Stretches that a sentence tells, the last of them the one that led to the end; with that alone if all are later.
std::vector<Stretch> told_stretches(const SessionSight& sight, std::size_t pair, double end_s) {
  auto stretches = without_short_gaps(sight.stretches[pair], static_cast<Tick>(short_gap_s / sight.tick_s));
  while (stretches.size() > 1 && static_cast<double>(stretches.back().first) * sight.tick_s > end_s)
    stretches.pop_back();
  return stretches;
}

/// Name for a chart, where room is scarce.
std::string short_name(const logging::Stay& stay) {
  return stay.name.empty() ? logging::called(stay) : fmt::format("{} {}", stay.number, printable(stay.name, 30));
}

std::string mirrors_in_words(const std::vector<const SightRow*>& rows, const SessionSight& sight,
                             const Threshold& threshold, double until_s) {
  std::map<std::string, Tick> first;
  for (const SightRow* row : rows)
    for (const MirrorSight& mirror : row->mirrors)
      if (static_cast<double>(row->tick) * sight.tick_s <= until_s && threshold.holds(mirror.sight))
        first.try_emplace(mirror.mirror, row->tick);
  std::string text;
  for (const auto& [mirror, tick] : first)
    text += fmt::format("{}in the {} from {:.2f} s", text.empty() ? "; " : ", ", mirror,
                        static_cast<double>(tick) * sight.tick_s);
  return text;
}

/// Word for riders who leave their machines, of whom the rest of the table tells.
std::string leaving_in_words(const std::vector<const SightRow*>& rows, const SessionSight& sight,
                             const Looking& looking) {
  std::string text;
  const auto add = [&](bool SightRow::*has_left, const logging::Stay& machine) {
    const auto first = std::ranges::find_if(rows, [&](const SightRow* row) { return row->*has_left; });
    if (first != rows.end())
      text += fmt::format("; from {:.2f} s on {} is the rider, off the machine",
                          static_cast<double>((*first)->tick) * sight.tick_s, short_name(machine));
  };
  add(&SightRow::target_left, looking.target);
  add(&SightRow::observer_left, looking.observer);
  return text;
}

}  // namespace

std::vector<Looking> lookings_of(const std::vector<ChosenPair>& pairs) {
  std::vector<Looking> lookings;
  for (const ChosenPair& pair : pairs) {
    if (has_eyes(pair.first)) lookings.push_back({pair.first, pair.second, pair.contact_s});
    if (has_eyes(pair.second)) lookings.push_back({pair.second, pair.first, pair.contact_s});
  }
  return lookings;
}

std::vector<DirectedPair> directed(const std::vector<Looking>& lookings) {
  std::vector<DirectedPair> pairs;
  pairs.reserve(lookings.size());
  for (const Looking& looking : lookings) pairs.push_back({looking.observer.number, looking.target.number});
  return pairs;
}

std::vector<std::string> sentences(const SessionSight& sight, const std::vector<Looking>& lookings,
                                   const Threshold& threshold) {
  std::vector<std::string> all;
  for (std::size_t pair = 0; pair < lookings.size(); ++pair) {
    const Looking& looking = lookings[pair];
    const auto rows = rows_of(sight, pair);
    const std::string target = logging::called(looking.target), observer = logging::called(looking.observer);
    if (rows.empty()) {
      all.push_back(fmt::format("{} and {} are never there at the same time.", target, observer));
      continue;
    }
    const auto time_s = [&](Tick tick) { return static_cast<double>(tick) * sight.tick_s; };
    const SightRow& nearest = **std::ranges::min_element(rows, {}, &SightRow::distance_m);
    const double end_s = end_s_of(rows, sight, looking);
    const std::vector<Stretch> stretches = told_stretches(sight, pair, end_s);
    const std::string mirrors =
        mirrors_in_words(rows, sight, threshold, end_s) + leaving_in_words(rows, sight, looking);
    if (stretches.empty()) {
      all.push_back(fmt::format("{} was at no time unobstructed for {} from {:.2f} to {:.2f} s{}.", target, observer,
                                time_s(rows.front()->tick), time_s(rows.back()->tick), mirrors));
      continue;
    }
    const SightRow& first = row_at(rows, stretches.back().first);
    const double first_s = time_s(first.tick);
    std::string text = fmt::format("{} was unobstructed for {} from {}{:.2f} s on, {:.1f} m away", target, observer,
                                   &first == rows.front() ? "the beginning, " : "", first_s, first.distance_m);
    if (first.straight.transmittance < clear_from)
      text += fmt::format(" with {:.0f} % of the light", 100.0 * first.straight.transmittance);
    if (looking.contact_s && end_s >= first_s)
      text += fmt::format(", {:.2f} s before the contact at {:.2f} s", end_s - first_s, end_s);
    else if (looking.contact_s)
      text += fmt::format(", after the contact at {:.2f} s", end_s);
    else if (nearest.tick > first.tick)
      text += fmt::format(", {:.2f} s before they were nearest, {:.1f} m, at {:.2f} s", end_s - first_s,
                          nearest.distance_m, end_s);
    if (stretches.back().last < rows.back()->tick && time_s(stretches.back().last) < end_s)
      text += fmt::format(", until {:.2f} s", time_s(stretches.back().last));
    if (stretches.size() > 1) {
      const Stretch& before = stretches[stretches.size() - 2];
      text += fmt::format("; earlier {}from {:.2f} to {:.2f} s",
                          stretches.size() > 2 ? fmt::format("{} times, last ", stretches.size() - 1) : std::string(),
                          time_s(before.first), time_s(before.last));
    }
    all.push_back(text + mirrors + ".");
  }
  return all;
}

std::string table(const SessionSight& sight, const std::vector<Looking>& lookings) {
  constexpr double square_degrees = 180.0 * 180.0 / (std::numbers::pi * std::numbers::pi);
  std::string text = "time_s,tick,observer,target,mirror,distance_m,share,transmittance,size_deg2\n";
  for (const SightRow& row : sight.rows) {
    const Looking& looking = lookings[row.pair];
    const auto add = [&](const std::string& mirror, const Sight& each) {
      text +=
          fmt::format("{:.4f},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.5f}\n", static_cast<double>(row.tick) * sight.tick_s,
                      row.tick, looking.observer.number, looking.target.number, mirror, row.distance_m, each.share(),
                      each.transmittance, each.solid_angle_sr * square_degrees);
    };
    add("", row.straight);
    for (const MirrorSight& mirror : row.mirrors) add(mirror.mirror, mirror.sight);
  }
  return text;
}

std::string chart(const SessionSight& sight, const std::vector<Looking>& lookings, const Threshold& threshold,
                  const std::string& title) {
  document::ChartPage page;
  page.title = title;
  page.lines = {
      "Share of the silhouette without anything opaque before it, in %; dashed: light that passes there, in %.",
      fmt::format(
          "Unobstructed: from {:g} % of the silhouette's light on. ▸ marks the beginning that is told, × a contact.",
          100.0 * threshold.light)};
  for (std::size_t pair = 0; pair < lookings.size(); ++pair) {
    const Looking& looking = lookings[pair];
    document::LineChart chart;
    chart.title = fmt::format("{} for {}", short_name(looking.target), short_name(looking.observer));
    chart.x_label = "s";
    chart.y_label = "%";
    chart.y = document::Range{0.0, 100.0};
    document::Series share{"share", {}}, light{"light", {}, document::Stroke::dashed};
    bool is_dimmed = false;
    const auto rows = rows_of(sight, pair);
    for (const SightRow* row : rows) {
      const double time_s = static_cast<double>(row->tick) * sight.tick_s;
      share.points.push_back({time_s, 100.0 * row->straight.share()});
      const bool is_seen = row->straight.unobstructed > 0;
      is_dimmed |= is_seen && row->straight.transmittance < clear_from;
      light.points.push_back(
          {time_s, is_seen ? 100.0 * row->straight.transmittance : std::numeric_limits<double>::quiet_NaN()});
    }
    if (share.points.empty()) continue;
    chart.series.push_back(std::move(share));
    if (is_dimmed) chart.series.push_back(std::move(light));
    if (const auto stretches = told_stretches(sight, pair, end_s_of(rows, sight, looking)); !stretches.empty()) {
      const double first_s = static_cast<double>(stretches.back().first) * sight.tick_s;
      chart.marks.push_back({first_s, "▸", fmt::format("unobstructed from {:.3f} s on", first_s)});
    }
    if (looking.contact_s)
      chart.marks.push_back({*looking.contact_s, "×", fmt::format("contact at {:.3f} s", *looking.contact_s)});
    page.charts.push_back(std::move(chart));
  }
  return to_svg(page);
}

}  // namespace septet::sight
