#pragma once
/// The stages of people's tick and their shared data. Used by engine/traffic/people only.

#include <cstdint>
#include <vector>

#include "engine/traffic/people/people.hpp"

namespace septet::traffic {

/// Ticks between two looks.
inline constexpr std::uint64_t look_ticks = 12;
/// Half of the width of a person, and the least that he leaves between himself and what stands.
inline constexpr double half_person_m = 0.3;

/// People by the x of their places: indices of those who are there.
struct Neighbourhood {
  std::vector<std::uint32_t> by_x;
  std::vector<std::uint32_t> rank;  ///< Of a person, in `by_x`.
};
Neighbourhood neighbourhood_of(const PeopleState& people);

/// Calls `visit` with the index of everybody else within `reach_m` of a place along x, unless it returns false.
template <class Visit>
bool for_near(const PeopleState& people, const Neighbourhood& near, std::uint32_t self, const Vec2& at_m,
              double reach_m, const Visit& visit) {
  const std::uint32_t rank = near.rank[self];
  for (std::uint32_t k = rank; k-- > 0;) {
    if (people.people[near.by_x[k]].position_m.x < at_m.x - reach_m) break;
    if (!visit(near.by_x[k])) return false;
  }
  for (std::uint32_t k = rank + 1; k < near.by_x.size(); ++k) {
    if (people.people[near.by_x[k]].position_m.x > at_m.x + reach_m) break;
    if (!visit(near.by_x[k])) return false;
  }
  return true;
}

/// A vehicle as people see it.
struct SeenVehicle {
  Vec2 middle_m{0.0}, velocity_mps{0.0}, heading{1.0, 0.0};
  double half_length_m = 0.0, half_width_m = 0.0, height_m = 0.0;
};
std::vector<SeenVehicle> seen_vehicles(const PeopleAround& around);

/// Whether somebody at the kerb of a crossing may go now, from its left or its right end.
bool may_cross(const WalkwayGraph& graph, const Crossing& crossing, bool from_left, const PeopleAround& around,
               const std::vector<SeenVehicle>& vehicles, const Person& person);

/// What one aims at.
struct Aim {
  Vec2 at_m{0.0};
  double most_mps = 0.0;
  bool stands = false;  ///< At his place before a kerb.
  Vec2 faces{1.0, 0.0};
};
/// Goes on to the next walk at an end, chooses the one after it, and decides at kerbs.
Aim aim_of(const WalkwayGraph& graph, const PeopleAround& around, const std::vector<SeenVehicle>& vehicles,
           double since_s, std::uint32_t index, PeopleState& people);

/// Chooses where one goes on at the end of his walk.
void choose_next(const WalkwayGraph& graph, Person& person);
void turn_back(Person& person);

/// The velocity with which one goes to his aim past others.
Vec2 step_to(const WalkwayGraph& graph, const std::vector<SeenVehicle>& vehicles, const Neighbourhood& near,
             std::uint32_t index, const Aim& aim, double side, const PeopleState& people);

/// People who are far leave, and come in where the driver does not see it.
void recycle_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around, PeopleState& people);

/// Half widths that a person's middle may be from the middle of a ribbon.
inline double usable_half_m(double half_m) { return half_m - half_person_m > 0.42 ? half_m - half_person_m : 0.42; }

}  // namespace septet::traffic
