#pragma once
/// Errors of people in a town's traffic (engine/world/people_errors.hpp), as state.
///
/// An impulse to err is drawn for each driver at the rates of the parameters, one of a kind at a time, and waits for its
/// occasion: to overlook, for somebody who alone keeps him from a junction and could still stop; to brake late, for a leader
/// who brakes; to pass at red, for a light that turns before him; the telephone rings at once. An impulse without an
/// occasion fades. A driver makes one error at a time.
///
///   overlook    he claims junctions and follows as if the other were not there, until the two have been near and parted,
///               or have touched;
///   late_brake  he takes his leader to go on at the speed that he had, for 1 to 2.5 s;
///   telephone   he takes his leader to go on likewise, claims no junction, gives no claim back and waits within one for
///               nobody for whom he did not wait before, for 2 to 6 s;
///   red         he takes amber, and the first 1 to 3 s of red, for green where he passes the line by then.
///
/// These times are choices: about those of a glance away from the road, and of a short exchange by telephone. All others
/// see what he does and react to it as they always do. Who has erred is remembered a little longer, as one who may run
/// into others of the traffic. Rates of 0 draw nothing: the same traffic as without errors.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/traffic/network/lane_graph.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::traffic {

struct DriverError {
  enum class Stage : std::uint8_t { waits, runs, over };

  ParticipantId who = 0;
  PeopleError kind = PeopleError::overlook;
  Stage stage = Stage::waits;
  std::optional<ParticipantId> whom;  ///< Overlooked, or his leader.
  double since_s = 0.0;               ///< Of its stage, in the town's time.
  double lasts_s = 0.0;               ///< But of an overlook; of `red`, seconds of red within which the line is passed.
  double nearest_m = std::numeric_limits<double>::infinity();  ///< Of an overlook: least distance of the outlines.
  /// The leader as he takes him to be.
  double leader_gap_m = std::numeric_limits<double>::infinity(), leader_mps = 0.0;
  bool waits_within = false;  ///< He did so when the telephone rang.
  WayIndex way = no_way;      ///< Of `red`: the way that ends at the light.
};

/// A wish that the next one who would have to give way overlooks somebody.
struct AwaitedOverlook {
  ParticipantId whom = 0;
  double since_s = 0.0;
};

struct TownErrors {
  std::vector<DriverError> drivers;      ///< Ascending `who`; of one driver in the order of his impulses.
  std::vector<AwaitedOverlook> awaited;  ///< For each other once.
  /// For how long each light has shown red, by road and direction; empty while no rate asks for it.
  std::vector<double> red_for_s;
  std::vector<ToldError> told;  ///< Since they were taken.

  bool any() const { return !drivers.empty() || !awaited.empty(); }
};

/// All errors of a driver.
std::span<DriverError> errors_of(ParticipantId who, TownErrors& errors);
/// The one that he makes; null: none.
DriverError* running_error(ParticipantId who, TownErrors& errors);
/// Adds one; pointers to others are then void.
DriverError& add_error(const DriverError& error, TownErrors& errors);

}  // namespace septet::traffic
