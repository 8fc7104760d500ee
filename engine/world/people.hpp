#pragma once
/// People of a swarm, on foot: their numbers as participants, and how many a scenario asks for, as a text:
///
///     count=120 radius_m=250       both words may be missing; `count=0` ends them
///
/// A person of a swarm has one lamp, which shines on nobody: signal_green while he crosses a road or stands before a
/// crosswalk and would, as his look and step tell every driver.
///
/// Pure functions.

#include <cstdint>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

/// Numbers of people: from here on, below those of riders (rider.hpp).
inline constexpr ParticipantId first_person_participant = 7000;
inline constexpr std::uint32_t most_people = 1000;

constexpr bool is_person_of_swarm(ParticipantId id) {
  return id >= first_person_participant && id - first_person_participant < most_people;
}

/// What a scenario asks for.
struct PeopleWish {
  std::uint32_t count = 120;
  double radius_m = 250.0;  ///< Around the driver's car, within which they walk.

  bool operator==(const PeopleWish&) const = default;
};
inline constexpr double least_people_radius_m = 50.0, most_people_radius_m = 2000.0;

/// Error: another form, or a number out of its range.
Expected<PeopleWish> read_people_wish(std::string_view text);

}  // namespace septet
