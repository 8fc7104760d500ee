#pragma once
/// People of a swarm on the walkways of a road network (walkways.hpp), around the driver.
///
///     PeopleState people = populate_people(parameters, graph, around, seed);
///     each tick:  advance_people(parameters, graph, around, dt_s, people);
///                 append_participants(people, participants);
///
/// Each wants to walk at a speed of his own (1.34 m/s, standard deviation 0.26: U. Weidmann, Transporttechnik der
/// Fussgänger, IVT 90, ETH Zürich, 1993) along a way that is drawn at each node. Ten times a second he looks where to
/// step: of several directions the one by which he comes nearest to his aim without touching anybody, at a speed at
/// which he could stop in half a second (M. Moussaïd, D. Helbing, G. Theraulaz, "How simple rules determine pedestrian
/// behavior and crowd disasters", PNAS 108 (2011), eqs. 1 to 3). He keeps to the right (to the left where traffic does), and
/// so do two or three who walk beside each other (shares of groups: M. Moussaïd et al., PLoS ONE 5 (2010) e10047).
/// Nobody steps nearer to another than `apart_m`, so that outlines never meet: each moves in turn, and one whose next place
/// is taken slides along the other or stands.
///
/// At a crossing people wait at the kerb for their light; at a crosswalk until those who come have a gap or can stop without
/// effort; elsewhere for the critical gap of HCM 2010 (chapter 19, eq. 19-69): the crossing's length by the walking speed, and 3 s.
///
/// They come and go where the driver does not see it: further than the eye tells, or behind walls.
///
/// Who is hit leaves these rails (`release`). World frame, metres. Same arguments: same people. One thread a state.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/sight/walls.hpp"
#include "engine/traffic/crossing.hpp"
#include "engine/traffic/people/walkways.hpp"
#include "engine/world/people.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/traffic_light.hpp"

namespace septet::traffic {

/// Least distance of two people's middles: the diagonal of an outline and 1 cm.
inline constexpr double apart_m = 0.79;

struct Person {
  ParticipantId id = 0;
  std::uint8_t paint = 0;
  double desired_mps = 1.34;  ///< A group's members have one.
  /// The first of his group, by index; a group's members follow each other in the list.
  std::uint32_t leader = 0;
  double beside_m =
      0.0;  ///< His place in the breadth of a ribbon: from the middle, to the left of his way, by half widths.
  std::uint64_t ways = 0;  ///< From it and `turns` his way follows; a group's members have one.

  bool outside = true;  ///< Waits for a place where he can come in; he is nowhere.
  WalkIndex walk = 0;
  bool forwards = true;  ///< From the walk's begin to its end.
  WalkIndex next_walk = no_walk;
  bool next_forwards = true;
  std::uint32_t turns = 0;  ///< Walks that he has entered.
  double at_m = 0.0;        ///< Along the walk, from its begin.
  double left_m = 0.0;      ///< From its middle, to the left of its direction.

  Vec2 position_m{0.0};  ///< Of his outline's middle.
  double height_m = 0.0;
  Vec2 velocity_mps{0.0};
  Vec2 wanted_mps{0.0};  ///< Until the next look.
  double heading_rad = 0.0, turns_radps = 0.0;
  double strides = 0.0;  ///< Phase of his step, in [0, 1).
  bool crosses = false;  ///< He has begun to cross, or may.
  bool asks = false;     ///< He stands at the kerb of a crosswalk and would go.
  double waits_s = 0.0;  ///< At a kerb.
  double stuck_s = 0.0;  ///< For which others have kept him from walking.
};

struct PeopleState {
  std::vector<Person> people;  ///< Ascending ids.
  double time_s = 0.0;
  std::uint64_t ticks = 0;
  Random random{1, 2};
};

/// Who else is there.
struct PeopleAround {
  Vec3 driver_eyes_m{0.0};
  bool keeps_left = false;
  std::span<const TrafficLight> lights;   ///< As they show, in the order of WalkwaySurroundings.
  std::span<const Participant> vehicles;  ///< Any that are no people of this swarm. Read at ticks of looks alone.
  const sight::Walls* walls = nullptr;    ///< May be null.
  std::span<const std::uint32_t> gone;    ///< Things whose walls do not stand.
};

PeopleState populate_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around,
                            std::uint64_t seed);

/// True where people look in the next call of `advance_people`: `around.vehicles` is read then.
bool look_next(const PeopleState& people);

void advance_people(const PeopleWish& wish, const WalkwayGraph& graph, const PeopleAround& around, double dt_s,
                    PeopleState& people);

/// Takes one off these rails. False: there is nobody of that number.
bool release(ParticipantId id, PeopleState& people);

/// Those on crossings and those who ask to be let pass, by crossing.
std::vector<PersonCrossing> people_crossing(const WalkwayGraph& graph, const PeopleState& people);

void append_participants(const PeopleState& people, std::vector<Participant>& participants);

}  // namespace septet::traffic
