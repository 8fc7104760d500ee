#include "engine/simulation/crash_recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace septet::simulation {
namespace {

constexpr Tick quiet_ticks = 6;  ///< 50 ms without a push: the impact is over.
constexpr Tick longest_ticks = 120;
static_assert(longest_ticks < most_pulse_ticks);
/// 0.25 s without a push: the two have parted. Pushes of a car that shoves a wreck come 42 ms apart at most, and one
/// thrown back at 0.25 m/s that drives on by 2 m/s² is there again after this time; more would join a second blow, and
/// delay what is told.
constexpr auto parted_ticks = static_cast<Tick>(parted_s * tick_rate_hz);
static_assert(parted_ticks > quiet_ticks);
constexpr auto told_within_ticks = static_cast<Tick>(told_within_s * tick_rate_hz);
static_assert(told_within_ticks > longest_ticks + parted_ticks);
/// A record of less is not told: bodies that lean on each other.
constexpr double least_mps = 0.5;
/// A car that shoves another comes on again by less.
constexpr double blow_mps = 1.0;

double kinetic_j(const impact::Body& body) {
  impact::Body at_rest = body;
  at_rest.velocity_mps = Vec2(0.0);
  at_rest.yaw_rate_radps = 0.0;
  return impact::kinetic_loss_j(body, at_rest);
}

void note_body(const impact::Body& body, double ahead_m, CrashedBody& told) {
  if (std::isfinite(body.mass_kg)) {
    told.mass_kg = body.mass_kg;
    told.yaw_inertia_kgm2 = body.yaw_inertia_kgm2;
  }
  told.mass_centre_ahead_m = ahead_m;
  told.before_mps = body.velocity_mps;
  told.yaw_rate_before_radps = body.yaw_rate_radps;
}

void tell_change(const impact::Body& before, const impact::Body& after, CrashedBody& told) {
  told.delta_v_mps = after.velocity_mps - before.velocity_mps;
  told.delta_yaw_rate_radps = after.yaw_rate_radps - before.yaw_rate_radps;
  if (*told.delta_v_mps == Vec2(0.0)) return;
  const Vec2 whence = turned(-*told.delta_v_mps, -before.heading_rad);
  told.principal_direction_rad = std::atan2(whence.y, whence.x);
}

/// Without a push no change was measured.
bool was_pushed(const OpenCrash& crash) {
  return crash.last_push > crash.record.tick || !crash.record.pulse_ns.empty();
}

CrashRecord finished(const OpenCrash& crash) {
  CrashRecord record = crash.record;
  record.ticks = static_cast<std::uint32_t>(crash.last_push - record.tick);
  if (!was_pushed(crash)) return record;
  record.contact_s = static_cast<double>(crash.last_in_contact - record.tick) * tick_s;
  if (crash.first_moves) tell_change(crash.first_at, crash.first, record.of_first);
  if (crash.second_moves) tell_change(crash.second_at, crash.second, record.of_second);
  if (!crash.has_ledger) return record;
  CrashLedger& ledger = record.ledger.emplace();
  ledger.kinetic_before_j = kinetic_j(crash.first_at) + kinetic_j(crash.second_at);
  ledger.kinetic_after_j = kinetic_j(crash.first) + kinetic_j(crash.second);
  // Friction gives nothing: where the force across the normal pushed on, the metal that had caught did.
  ledger.crush_j = crash.of_contact.crush_j + std::min(0.0, crash.of_contact.friction_j);
  ledger.friction_j = std::max(0.0, crash.of_contact.friction_j);
  ledger.debris_j = crash.debris_j;
  ledger.wheels_j = crash.wheels_j;
  return record;
}

bool ends_its_impact(const OpenCrash& crash, Tick now) {
  return now > crash.last_push + quiet_ticks || now >= crash.record.tick + longest_ticks;
}

bool is_worth_telling(const CrashRecord& record) {
  const auto speed = [](const CrashedBody& body) { return glm::length(body.delta_v_mps.value_or(Vec2(0.0))); };
  return std::max({record.closing_speed_mps, speed(record.of_first), speed(record.of_second)}) >= least_mps;
}

/// Nothing more is to come of it. A contact that nobody is told of is not waited for: what follows may be told.
bool is_over(const OpenCrash& crash, Tick now) {
  if (!crash.is_impact_over) return false;
  return now > crash.last_in_contact + parted_ticks || !is_worth_telling(finished(crash));
}

/// Whether it is told now: they have parted, or are not waited for any longer.
bool is_due(const OpenCrash& crash, Tick now) {
  return !crash.is_told && (is_over(crash, now) || now >= crash.record.tick + told_within_ticks);
}

void tell(const CrashRecord& record, std::vector<Event>& events) {
  if (is_worth_telling(record)) events.push_back({std::string(crash_event), record.first, text_of(record)});
}

template <class Is>
OpenCrash* latest(std::vector<OpenCrash>& crashes, const Is& is) {
  const auto found = std::ranges::find_if(crashes.rbegin(), crashes.rend(), is);
  return found == crashes.rend() ? nullptr : &*found;
}

/// By how much cuts have taken an outline back along a way that turns with it.
double crush_m(const impact::Side& side, const impact::Cuts& cuts, const impact::Body& at_touch, const Vec2& way) {
  return impact::crushed_off_m(side.outline, cuts, turned(way, side.body.heading_rad - at_touch.heading_rad));
}

}  // namespace

OpenCrash& open_crash(const CrashTouch& touch, State& state) {
  OpenCrash& crash = state.open_crashes.emplace_back();
  crash.record.tick = crash.last_push = crash.last_in_contact = state.tick;
  crash.record.first = touch.first;
  crash.record.second = touch.second;
  crash.record.point_m = Vec3(touch.place.point_m, touch.height_m);
  crash.record.normal_rad = std::atan2(touch.place.normal.y, touch.place.normal.x);
  crash.record.closing_speed_mps = touch.closing_mps;
  return crash;
}

OpenCrash* find_open_crash(State& state, ParticipantId first, ParticipantId second) {
  return latest(state.open_crashes,
                [&](const OpenCrash& crash) { return crash.record.first == first && crash.record.second == second; });
}

OpenCrash* find_open_crash_with_run(State& state, ParticipantId first, std::uint32_t run) {
  return latest(state.open_crashes, [&](const OpenCrash& crash) {
    return crash.record.first == first && !crash.record.second && crash.run == run;
  });
}

bool begins_record(const OpenCrash* known, double closing_mps) {
  return !known || (known->is_impact_over && closing_mps >= blow_mps);
}

void note_first(const impact::Body& body, double ahead_m, bool is_pushed, OpenCrash& crash) {
  crash.first = crash.first_at = body;
  crash.first_moves = is_pushed;
  note_body(body, ahead_m, crash.record.of_first);
}

void note_second(const impact::Body& body, double ahead_m, bool is_pushed, OpenCrash& crash) {
  crash.second = crash.second_at = body;
  crash.second_moves = is_pushed;
  note_body(body, ahead_m, crash.record.of_second);
}

void note_overlap(const impact::Side& first, const impact::Side& second, OpenCrash& crash) {
  const Vec2 approach_mps = impact::relative_velocity_at(first.body, second.body, Vec2(crash.record.point_m));
  const impact::Passing past = impact::passing(first.outline, second.outline, approach_mps);
  if (!(past.narrower_m > 0.0)) return;
  crash.record.overlap_m = std::min(past.aside_m, past.narrower_m);
  crash.record.overlap_share = *crash.record.overlap_m / past.narrower_m;
}

void note_push(Tick now, const CrashPush& push, OpenCrash& crash) {
  crash.last_in_contact = now;
  if (crash.is_impact_over) return;
  crash.wheels_j += impact::kinetic_loss_j(crash.first, push.first) +
                    impact::kinetic_loss_j(crash.second, push.second) - push.work.kinetic_j - push.debris_j;
  crash.first = push.first;
  crash.second = push.second;
  crash.of_contact.kinetic_j += push.work.kinetic_j;
  crash.of_contact.crush_j += push.work.crush_j;
  crash.of_contact.friction_j += push.work.friction_j;
  crash.debris_j += push.debris_j;
  crash.last_push = now;
  if (!push.on_second_ns) return;
  std::vector<Vec2>& pulse_ns = crash.record.pulse_ns;
  pulse_ns.resize(std::max<std::size_t>(pulse_ns.size(), now - crash.record.tick + 1), Vec2(0.0));
  pulse_ns[now - crash.record.tick] += *push.on_second_ns;
}

void note_broken_off(const BrokenOff& broken, const std::optional<PushedByPieces>& first,
                     const std::optional<PushedByPieces>& second, State& state) {
  OpenCrash* crash = broken.second ? find_open_crash(state, broken.first, *broken.second)
                                   : find_open_crash_with_run(state, broken.first, broken.run);
  if (!crash || crash->is_impact_over) return;
  crash->record.pieces_kinetic_j = crash->record.pieces_kinetic_j.value_or(0.0) + broken.kinetic_j;
  CrashPush push{.first = crash->first, .second = crash->second};
  bool is_pushed = false;
  const auto add = [&](const std::optional<PushedByPieces>& side, bool moves, const Vec3& given_ns,
                       impact::Body& left) {
    if (!side || !moves) return;
    is_pushed = true;
    left.velocity_mps += side->after.velocity_mps - side->before.velocity_mps;
    left.yaw_rate_radps += side->after.yaw_rate_radps - side->before.yaw_rate_radps;
    push.debris_j -= 0.5 * glm::dot(Vec2(given_ns), side->before.velocity_mps + side->after.velocity_mps);
  };
  add(first, crash->first_moves, broken.on_first_ns, push.first);
  add(second, crash->second_moves, broken.on_second_ns, push.second);
  if (is_pushed) note_push(state.tick, push, *crash);
}

void note_crush(const impact::Engagement& engagement, const impact::Side& first, const impact::Side& second,
                OpenCrash& crash) {
  if (crash.is_impact_over) return;
  const Vec2 normal(std::cos(crash.record.normal_rad), std::sin(crash.record.normal_rad));
  if (crash.first_moves) crash.record.of_first.crush_m = crush_m(first, engagement.first, crash.first_at, normal);
  if (crash.second_moves) crash.record.of_second.crush_m = crush_m(second, engagement.second, crash.second_at, -normal);
}

void close_crashes(State& state, std::vector<Event>& events) {
  for (OpenCrash& crash : state.open_crashes) {
    crash.is_impact_over = crash.is_impact_over || ends_its_impact(crash, state.tick);
    if (!is_due(crash, state.tick)) continue;
    tell(finished(crash), events);
    crash.is_told = true;
  }
  std::erase_if(state.open_crashes, [&](const OpenCrash& crash) { return is_over(crash, state.tick); });
}

bool is_impact_running(const State& state) {
  return !std::ranges::all_of(state.open_crashes, &OpenCrash::is_impact_over);
}

std::vector<Event> unfinished_crashes(const State& state) {
  std::vector<Event> events;
  for (const OpenCrash& crash : state.open_crashes) {
    if (crash.is_told) continue;
    CrashRecord record = finished(crash);
    record.is_unfinished = !crash.is_impact_over;
    tell(record, events);
  }
  return events;
}

}  // namespace septet::simulation
