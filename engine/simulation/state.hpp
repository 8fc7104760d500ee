#pragma once
/// Everything that changes during a drive, and a step's events for the log besides its snapshot.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "engine/simulation/bodies/bodies_state.hpp"
#include "engine/simulation/car_faults.hpp"
#include "engine/simulation/car_impact_state.hpp"
#include "engine/simulation/effects/effects_state.hpp"
#include "engine/simulation/examiner_state.hpp"
#include "engine/simulation/game_state.hpp"
#include "engine/simulation/guidance_state.hpp"
#include "engine/simulation/model.hpp"
#include "engine/simulation/open_crash.hpp"
#include "engine/simulation/people_state.hpp"
#include "engine/simulation/solid_motion.hpp"
#include "engine/simulation/thrown_state.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/limited_sight.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// A wheel's touch of a kerb's edge, as it began.
struct KerbTouch {
  double height_m = 0.0;
  double closing_speed_mps = 0.0;  ///< Speed of the wheel's centre towards the edge.
};

/// A wheel being damaged: logged once the strike is over.
struct WheelStrike {
  std::optional<KerbTouch> kerb;
  double squeeze_m = 0.0;  ///< Largest squeeze of the tyre.
};

/// A car that goes by a table.
struct MotionState {
  double start_x_m = 0.0, start_y_m = 0.0, start_heading_rad = 0.0;  ///< Where the table's own plan begins, and along.
  bool is_over = false;  ///< The table has ended, or the car has touched something: it is free.
};

/// Somebody within the distance in which the driver looks for others.
struct Sighting {
  ParticipantId id = 0;
  bool seen = false;      ///< At the last look.
  bool was_seen = false;  ///< At any since he came near.
  Tick since = 0;         ///< When he was last seen, or came near if he never was.
};

/// Whom the driver's eyes have before them (driver_eyes.hpp).
struct Sightings {
  std::vector<Sighting> near;  ///< Ascending.
  Tick changed = 0;            ///< The look that last changed who is seen.
};

struct State {
  Tick tick = 0;
  vehicle::VehicleState car;
  CarFaults faults;  ///< Hashed where there is one.
  vehicle::HullState hull;
  /// With those that are no bodies of their own, running, in the order of their touches. Hashed where there is one.
  std::vector<CarImpact> impacts;
  BodiesState bodies;              ///< Hashed where there is one.
  std::vector<ThrownBody> thrown;  ///< People and machines that were thrown, ascending id. Hashed where there is one.
  std::vector<OpenCrash> open_crashes;  ///< Being recorded for the log, in the order of their touches.
  /// Each wheel's last position, where the next search begins.
  std::array<road::RoadPosition, vehicle::wheel_count> wheel_roads{};
  std::array<std::optional<KerbTouch>, vehicle::wheel_count> kerbs;      ///< One event a touch.
  std::array<std::optional<WheelStrike>, vehicle::wheel_count> strikes;  ///< One event a strike.
  std::optional<road::RoadPosition> car_road;
  std::uint32_t off_road_ticks = 0;  ///< Time since the car was last on a road or right beside it.
  scenario::ScenarioState scenario;
  std::unique_ptr<traffic::TrafficEngine> traffic;
  PeopleOfDrive people;  ///< Hashed where there is one.
  EffectsState effects;
  /// Things beside the roads that are hidden (standing.hpp), by Obstacle::thing, ascending. Hashed where there is one.
  std::vector<std::uint32_t> gone;
  std::vector<SolidMotion> solid_motions;  ///< In the order in which they were stood. Hashed where there is one.
  std::vector<LimitedSight> sights;        ///< Of the last look, ascending. Hashed where there is one.
  Sightings sightings;                     ///< For the simulated driver, the snapshot and the log; no stage acts on it.
  std::optional<MotionState> motion;       ///< Present where the car goes by a table (given_motion.hpp).
  std::optional<GameState> game;           ///< Present where the scenario is played as a game.
  std::optional<ExaminerState> examiner;  ///< Present where the roads have lines at which others may have right of way.
  std::optional<GuidanceState> guidance;  ///< Present where the driver is guided to a goal.
  DriverInput input;                      ///< Input of the last step.
  Diagnostics diagnostics;
  /// Participants that overlapped the car last tick, ascending: one collision counts once.
  std::vector<ParticipantId> touching;

  double time_s() const { return static_cast<double>(tick) / tick_rate_hz; }
};

/// An event of a step, for the log.
struct Event {
  std::string
      /// "scenario", "collision", "crash_of_others", "crash", "game", "kerb", "wheel_damage", "off_road", "bad_number",
      /// "traffic", "right_of_way", ….
      kind;
  std::optional<ParticipantId> participant;
  std::string detail;
};

/// Counts numbers that have become NaN or infinite and were reset in place, and logs them. `reset` names what was
/// reset.
void note_bad_numbers(std::uint32_t count, std::optional<ParticipantId> participant, const char* reset, State& state,
                      std::vector<Event>& events);

/// The same model, seed and inputs give the same value at every tick, with any compiler.
std::uint64_t hash_state(const State& state);

}  // namespace septet::simulation
