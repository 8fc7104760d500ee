#pragma once
/// Crashes as they are recorded: from the touch until their impact is over, one record for all
/// (engine/world/crash_record.hpp), told as the event `crash`.
///
/// Those who push bodies (collisions, the car's hull, thrown people, pieces that break off) tell it of each push; it
/// changes nothing of the drive. The impact is over when nothing has pushed for 50 ms, and after a second at the latest:
/// what touches longer slides, leans or pushes. Then the record changes no more but for how long the contact lasts, and
/// it is told when both have parted, which is when neither has pushed the other for a quarter of a second, and two
/// seconds after the touch at the latest. Until they part a push of ten seconds is one crash; a blow of 1 m/s or more
/// after the impact begins a record of its own. What came to less than 0.5 m/s is neither told nor waited for.

#include <optional>
#include <vector>

#include "engine/physics/impact/meet.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Two sides at their touch, and where it is.
struct CrashTouch {
  ParticipantId first = 0;
  std::optional<ParticipantId> second;
  impact::Place place;
  double height_m = 0.0;  ///< Of the point.
  double closing_mps = 0.0;
};

/// Begins a record; the bodies' numbers, and what the outlines tell, are for the caller to add.
OpenCrash& open_crash(const CrashTouch& touch, State& state);

/// The latest record of these two, who are in contact; null where there is none.
OpenCrash* find_open_crash(State& state, ParticipantId first, ParticipantId second);
/// Likewise of one and what stands, of whom each touch has its own: the latest.
OpenCrash* find_open_crash_with_run(State& state, ParticipantId first, std::uint32_t run);

/// True where a touch of two, of whom this is the open record, begins one: they have none, or its impact is over and it
/// is a blow rather than a push.
bool begins_record(const OpenCrash* known, double closing_mps);

/// Notes a side at the touch. `ahead_m`: of its mass centre from the vehicle's origin; `is_pushed`: its pushes will be
/// noted, and so its motion is known from now on.
void note_first(const impact::Body& body, double ahead_m, bool is_pushed, OpenCrash& crash);
void note_second(const impact::Body& body, double ahead_m, bool is_pushed, OpenCrash& crash);
/// Notes how wide both meet, seen along their approach.
void note_overlap(const impact::Side& first, const impact::Side& second, OpenCrash& crash);

/// A push of this contact, or of pieces that it broke off: as it has left both, with what it gave the second.
struct CrashPush {
  impact::Body first, second;
  std::optional<Vec2> on_second_ns;
  impact::Ledger work;
  double debris_j = 0.0;
};
void note_push(Tick now, const CrashPush& push, OpenCrash& crash);

/// How far the engagement has crushed both along the record's normal, which turns with each.
void note_crush(const impact::Engagement& engagement, const impact::Side& first, const impact::Side& second,
                OpenCrash& crash);

/// A side whom broken-off pieces have pushed.
struct PushedByPieces {
  impact::Body before, after;
};
/// Notes what broke off of a running crash. Empty: who is no body that can be pushed.
void note_broken_off(const BrokenOff& broken, const std::optional<PushedByPieces>& first,
                     const std::optional<PushedByPieces>& second, State& state);

/// Tells of the crashes that are due, and drops those whose two have parted.
void close_crashes(State& state, std::vector<Event>& events);
/// True while an impact is being recorded.
bool is_impact_running(const State& state);
/// The records of a drive that ends now, as far as they are, marked where the impact is not over; the state keeps them.
std::vector<Event> unfinished_crashes(const State& state);

}  // namespace septet::simulation
