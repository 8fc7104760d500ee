#include "sim-client/film/accident/accident_plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/printable.hpp"
#include "engine/math/speed_units.hpp"
#include "sim-client/film/overlay/overlay_content.hpp"

namespace septet::film {
namespace {

constexpr double per_degree = std::numbers::pi / 180.0;
constexpr double from_above_deg = 50.0;  ///< Field of view of a camera that looks down.
constexpr double eyes_deg = 75.0;        ///< Across the picture, through somebody's eyes.
constexpr double half_eyes_deg = 60.0;   ///< The same across half of it.
constexpr double shortest_shot_s = 0.2;  ///< Of simulated time.
constexpr double margin_m = 6.0;         ///< Around the ways in a picture from above.
constexpr double lowest_above_m = 12.0;  ///< Of a camera that looks down.
/// Parts of a picture that the overlay covers, from its middle as shares of its width and height: the clock lies to the
/// left of the first and above the second, notes below the third.
constexpr double clock_until_share = -0.15, clock_from_share = 0.22, notes_until_share = -0.35;
constexpr std::size_t longest_name = 24;  ///< In words over pictures.
constexpr std::size_t longest_changes = 60;

double to_centimetres(double value_m) { return std::round(100.0 * value_m) / 100.0; }

std::string short_name(const Involved& one) { return printable(name_of(one), longest_name); }

/// Name of a participant in a script: their own where it cannot be taken for something else.
std::string reference(const Involved& one) {
  const std::string& name = one.name;
  return name.empty() || name == "driver" || name == "nearest" || name != printable(name, longest_name)
             ? std::to_string(one.number)
             : name;
}

const WayPoint& way_at(const Involved& one, double time_s) {
  const auto found = std::ranges::lower_bound(one.way, time_s - 1e-6, {}, &WayPoint::time_s);
  return found == one.way.end() ? one.way.back() : *found;
}

bool sees(const Involved& one) { return vehicle_models()[one.model].kind != ParticipantKind::object; }

/// Everything that the planner of one film holds.
struct Planner {
  const AccidentFacts& facts;
  const Solids& solids;
  double width_over_height, contact_s;
  AccidentPlan plan{};

  double window_from(double before_s) const { return std::max(facts.window_s.first, contact_s - before_s); }
  double window_to(double after_s) const { return std::min(facts.window_s.second, contact_s + after_s); }

  void add(Shot shot, const std::string& words);
  void add_clear(const Shot& shot, const std::string& words);
  Shot through_eyes(const Involved& one, double before_s, double after_s, double speed) const;
  Shot from_above(double before_s, double after_s, double speed) const;
};

void Planner::add(Shot shot, const std::string& words) {
  shot.overlay = true;
  if (!(shot.to_s - shot.from_s >= shortest_shot_s)) return;
  plan.script.shots.push_back(std::move(shot));
  plan.words.push_back(words);
}

void Planner::add_clear(const Shot& shot, const std::string& words) {
  if (!(shot.to_s - shot.from_s >= shortest_shot_s)) return;
  if (auto clear = cleared(shot, facts, solids))
    add(std::move(*clear), words);
  else
    plan.left_out.push_back(fmt::format("{}: no camera stands clear of solids and sees it", shot.title));
}

Shot Planner::through_eyes(const Involved& one, double before_s, double after_s, double speed) const {
  Shot shot{.from_s = std::max(window_from(before_s), one.way.front().time_s),
            .to_s = std::min(window_to(after_s), one.way.back().time_s),
            .speed = speed,
            .participant = reference(one)};
  // The driver's head is logged; others look straight on, and the title says so.
  const bool logged = one.moved_by == MovedBy::person || one.moved_by == MovedBy::simulated_driver;
  shot.bearings = logged ? Bearings::gaze : Bearings::vehicle;
  shot.field_of_view_rad = eyes_deg * per_degree;
  shot.interior = true;
  shot.title = short_name(one) + (logged ? ": eyes, gaze as logged" : ": eyes, gaze assumed straight on");
  return shot;
}

/// A picture of the ways from as near as they fit, turned so that the overlay hides few of their places.
Shot Planner::from_above(double before_s, double after_s, double speed) const {
  Shot shot{.from_s = window_from(before_s), .to_s = window_to(after_s), .speed = speed};
  shot.pitch_rad = -90.0 * per_degree;
  shot.bearings = Bearings::world;
  shot.field_of_view_rad = from_above_deg * per_degree;
  shot.title = "from above";
  shot.paths = true;
  std::vector<Vec3> places_m;
  for (const Involved& one : facts.involved)
    for (const WayPoint& at : one.way)
      if (at.time_s >= shot.from_s - 1e-6 && at.time_s <= shot.to_s + 1e-6) places_m.push_back(at.position_m);
  if (places_m.empty()) places_m.push_back(facts.involved.front().way.front().position_m);
  const double slope = std::tan(0.5 * shot.field_of_view_rad);
  double least_score_m = 1e300;
  for (int turned_deg = 0; turned_deg < 360; turned_deg += 15) {
    // With this heading the picture's upper edge points there, and its right one a quarter turn clockwise of it.
    const double heading = turned_deg * per_degree;
    const Vec2 up(std::cos(heading), std::sin(heading)), right(up.y, -up.x);
    Vec2 low(1e300), high(-1e300);
    double ground_m = -1e300;
    for (const Vec3& place_m : places_m) {
      const Vec2 p(glm::dot(Vec2(place_m), right), glm::dot(Vec2(place_m), up));
      low = glm::min(low, p), high = glm::max(high, p), ground_m = std::max(ground_m, place_m.z);
    }
    const Vec2 size = high - low + Vec2(2.0 * margin_m), middle = 0.5 * (low + high);
    const double height_m = std::max(lowest_above_m, std::max(size.x, size.y * width_over_height) / (2.0 * slope));
    const double width_m = 2.0 * slope * height_m;
    const auto hidden = std::ranges::count_if(places_m, [&](const Vec3& place_m) {
      const double x = (glm::dot(Vec2(place_m), right) - middle.x) / width_m,
                   y = (glm::dot(Vec2(place_m), up) - middle.y) / width_m * width_over_height;
      return (x < clock_until_share && y > clock_from_share) || y < notes_until_share;
    });
    const double score_m = height_m * (1.0 + static_cast<double>(hidden) / static_cast<double>(places_m.size()));
    if (score_m >= least_score_m - 1e-6) continue;
    least_score_m = score_m;
    shot.heading_rad = heading;
    const Vec2 centre = middle.x * right + middle.y * up;
    shot.place_m = Vec3(to_centimetres(centre.x), to_centimetres(centre.y), to_centimetres(ground_m + height_m));
  }
  return shot;
}

std::string speeds_of(const AccidentFacts& facts, double time_s) {
  std::string text;
  for (const Involved& one : facts.involved)
    text += fmt::format("{}{} {:.0f} km/h", text.empty() ? "" : ", ", short_name(one),
                        kmh_per_mps * way_at(one, time_s).speed_mps);
  return text;
}

/// "ego and crosser meet", "ego meets a guard rail", "ego comes nearest to crosser", "ego alone".
std::string what_happens(const AccidentFacts& facts) {
  const std::string first = short_name(facts.involved.front());
  const bool two = facts.involved.size() > 1;
  if (facts.chosen) {
    const Contact& contact = facts.contacts[*facts.chosen];
    if (two) return first + " and " + short_name(facts.involved[1]) + " meet";
    return fmt::format("{} meets {}", first,
                       contact.second ? "somebody who is not in the log" : printable(contact.stands, longest_name));
  }
  if (two)
    return fmt::format("no contact: {} and {} come within {:.2f} m", first, short_name(facts.involved[1]),
                       facts.nearest_m);
  return "no contact: " + first + " alone";
}

/// Of the first: as the record of the crash has it, else as its touch foresaw it.
std::optional<double> delta_v_of(const Contact& contact) {
  if (contact.crash && contact.crash->of_first.delta_v_mps) return glm::length(*contact.crash->of_first.delta_v_mps);
  return contact.delta_v_mps;
}

/// Figures of the crash's record that were measured.
void add_crash_figures(const AccidentFacts& facts, const CrashRecord& crash, std::vector<Figure>& figures) {
  const auto add = [&](const std::string& name, const char* unit, const std::optional<double>& value, double times) {
    if (value) figures.push_back({name, unit, times * *value, "logged record of the crash, computed"});
  };
  add("overlap, of the narrower one", "%", crash.overlap_share, 100.0);
  add("depth to which the outlines came into each other", "m", crash.depth_m, 1.0);
  add("contact, from the touch to the last push", "s", crash.contact_s, 1.0);
  const CrashedBody* bodies[] = {&crash.of_first, &crash.of_second};
  for (std::size_t i = 0; i < std::min(facts.involved.size(), std::size(bodies)); ++i) {
    const CrashedBody& body = *bodies[i];
    const std::string name = short_name(facts.involved[i]);
    const auto delta_v_mps = body.delta_v_mps ? std::optional(glm::length(*body.delta_v_mps)) : std::nullopt;
    add(name + ", change of velocity in the crash (ΔV)", "km/h", delta_v_mps, kmh_per_mps);
    add(name + ", principal direction: whence the blow came, 0 ahead, 90 left", "°", body.principal_direction_rad,
        1.0 / per_degree);
    add(name + ", change of yaw rate", "°/s", body.delta_yaw_rate_radps, 1.0 / per_degree);
    add(name + ", crush", "m", body.crush_m, 1.0);
  }
  if (!crash.ledger) return;
  const CrashLedger& ledger = *crash.ledger;
  constexpr double kilo = 1e-3;
  add("kinetic energy before", "kJ", ledger.kinetic_before_j, kilo);
  add("kinetic energy after", "kJ", ledger.kinetic_after_j, kilo);
  add("energy of the crush", "kJ", ledger.crush_j, kilo);
  add("energy of friction", "kJ", ledger.friction_j, kilo);
  add("energy to debris, below zero: from it", "kJ", ledger.debris_j, kilo);
  add("energy to wheels and other contacts", "kJ", ledger.wheels_j, kilo);
}

void add_figures(const AccidentFacts& facts, AccidentPlan& plan, double contact_s) {
  const auto add = [&](const std::string& name, const char* unit, double value, const char* origin) {
    plan.figures.push_back({name, unit, value, origin});
  };
  if (facts.chosen) {
    const Contact& contact = facts.contacts[*facts.chosen];
    add("instant of the contact", "s", contact.time_s, "logged event");
    if (contact.closing_mps) add("closing speed", "km/h", kmh_per_mps * *contact.closing_mps, "logged event, computed");
    if (contact.crash) add_crash_figures(facts, *contact.crash, plan.figures);
    if (contact.delta_v_mps && !(contact.crash && contact.crash->of_first.delta_v_mps))
      add(short_name(facts.involved.front()) + ", change of velocity by the contact (ΔV)", "km/h",
          kmh_per_mps * *contact.delta_v_mps, "logged event, computed");
  } else if (facts.nearest_s) {
    add("instant of the nearest approach", "s", *facts.nearest_s, "logged, ten times a second");
    add("distance of the two outlines then", "m", facts.nearest_m, "logged, ten times a second");
  }
  for (const Involved& one : facts.involved) {
    const std::string name = short_name(one);
    add(name + ", speed at the film's beginning", "km/h", kmh_per_mps * one.way.front().speed_mps, "logged tick");
    add(name + ", speed at that instant", "km/h", kmh_per_mps * way_at(one, contact_s).speed_mps, "logged tick");
    add(name + ", speed at the film's end", "km/h", kmh_per_mps * one.way.back().speed_mps, "logged tick");
  }
}

}  // namespace

std::vector<std::string> origins(const AccidentFacts& facts) {
  std::string scripted, traffic, assumed = "assumed: weather, light, masses";
  for (const Involved& one : facts.involved) {
    if (one.moved_by == MovedBy::scenario) scripted += (scripted.empty() ? "" : ", ") + short_name(one);
    if (one.moved_by == MovedBy::traffic) traffic += (traffic.empty() ? "" : ", ") + short_name(one);
  }
  const bool has_person =
      std::ranges::any_of(facts.involved, [](const Involved& one) { return one.moved_by == MovedBy::person; });
  const bool has_driver = has_person || std::ranges::any_of(facts.involved, [](const Involved& one) {
                            return one.moved_by == MovedBy::simulated_driver;
                          });
  std::string computed;
  const auto add_computed = [&](const std::string& what) {
    computed += (computed.empty() ? "computed: " : ", ") + what;
  };
  if (has_driver && !has_person) add_computed(fmt::format("driver ({})", printable(facts.driver, longest_name)));
  if (has_driver) add_computed("the car's motion");
  std::string given = has_person ? "measured: the driver's controls and head" : "measured: nothing";
  if (!facts.table.empty()) given = fmt::format("given: the car's way, by {}", printable(facts.table, longest_name));
  if (!facts.changes.empty()) given += fmt::format("; changed: {}", printable(facts.changes, longest_changes));
  if (!traffic.empty()) add_computed(fmt::format("traffic ({})", traffic));
  if (facts.chosen) add_computed("the impact");
  if (!scripted.empty()) assumed += "; way and speed of " + scripted + " (scenario)";
  return {"simulation from a log; " + given, assumed, computed.empty() ? "computed: nothing" : computed};
}

AccidentPlan plan_accident(const AccidentFacts& facts, const Solids& solids, double width_over_height) {
  const double contact_s = facts.chosen      ? facts.contacts[*facts.chosen].time_s
                           : facts.nearest_s ? *facts.nearest_s
                                             : 0.5 * (facts.window_s.first + facts.window_s.second);
  Planner planner{facts, solids, width_over_height, contact_s};
  AccidentPlan& plan = planner.plan;
  const Involved& first = facts.involved.front();
  const Involved* second = facts.involved.size() > 1 ? &facts.involved[1] : nullptr;
  const std::string event = facts.chosen ? "the contact" : facts.nearest_s ? "the nearest approach" : "the middle";
  plan.title = fmt::format("{}, {:.2f} s", what_happens(facts), contact_s);
  plan.script.overlay.notes = origins(facts);
  if (facts.chosen || facts.nearest_s) plan.script.overlay.contact_s = contact_s;
  if (!facts.chosen && facts.nearest_s) plan.script.overlay.contact = event;
  if (facts.chosen && facts.contacts[*facts.chosen].crash)
    plan.script.overlay.contact_m = facts.contacts[*facts.chosen].crash->point_m;
  for (const Involved& one : facts.involved) plan.script.overlay.participants.push_back(reference(one));

  const Shot above = planner.from_above(before_contact_s, after_contact_s, 1.0);
  planner.add_clear(
      above, fmt::format("{:.1f} s before {}: {}.", contact_s - above.from_s, event, speeds_of(facts, above.from_s)));
  for (const Involved& one : facts.involved)
    if (sees(one))
      planner.add(planner.through_eyes(one, 3.0, 0.5, 1.0), fmt::format("What {} has before them.", short_name(one)));
  if (second && sees(first) && sees(*second)) {
    Shot both = planner.through_eyes(first, 2.0, 1.0, 0.5);
    const Shot other = planner.through_eyes(*second, 2.0, 1.0, 0.5);
    both.from_s = std::max(both.from_s, other.from_s), both.to_s = std::min(both.to_s, other.to_s);
    both.field_of_view_rad = half_eyes_deg * per_degree;
    both.beside = SecondCamera{.participant = other.participant,
                               .bearings = other.bearings,
                               .field_of_view_rad = half_eyes_deg * per_degree,
                               .interior = true,
                               .title = other.title};
    planner.add(both, "Both at once, on one clock, at half speed.");
  } else if (sees(first)) {
    Shot both = planner.through_eyes(first, 2.0, 1.0, 0.5);
    const Shot top = planner.from_above(2.0, 1.0, 0.5);
    both.paths = true;
    both.beside = SecondCamera{.participant = {},
                               .place_m = top.place_m,
                               .bearings = top.bearings,
                               .heading_rad = top.heading_rad,
                               .pitch_rad = top.pitch_rad,
                               .field_of_view_rad = top.field_of_view_rad,
                               .title = top.title};
    if (is_clear(top, facts, solids))
      planner.add(both, "The eyes and the view from above, on one clock, at half speed.");
  }
  Shot slow = planner.from_above(0.5, 1.0, 0.25);
  slow.title = "from above, slow";
  const Contact* contact = facts.chosen ? &facts.contacts[*facts.chosen] : nullptr;
  std::string told = facts.chosen ? "The contact" : "The nearest approach";
  if (contact && contact->closing_mps)
    told += fmt::format(": closing at {:.0f} km/h", kmh_per_mps * *contact->closing_mps);
  if (const auto delta_v_mps = contact ? delta_v_of(*contact) : std::nullopt)
    told += fmt::format(", velocity of {} changed by {:.0f} km/h", short_name(first), kmh_per_mps * *delta_v_mps);
  if (!facts.chosen && facts.nearest_s) told += fmt::format(": {:.2f} m between their outlines", facts.nearest_m);
  planner.add_clear(slow, told + ".");
  Shot beside{.from_s = planner.window_from(0.5),
              .to_s = planner.window_to(1.0),
              .speed = 0.25,
              .participant = reference(first),
              .distance_m = 11.0,
              .heading_rad = 125.0 * per_degree,
              .pitch_rad = -16.0 * per_degree,
              .title = "beside " + short_name(first) + ", slow"};
  beside.to_s = std::min(beside.to_s, first.way.back().time_s);
  beside.from_s = std::max(beside.from_s, first.way.front().time_s);
  planner.add_clear(beside, fmt::format("After it: {}.", speeds_of(facts, beside.to_s)));
  add_figures(facts, plan, contact_s);
  return std::move(plan);
}

}  // namespace septet::film
