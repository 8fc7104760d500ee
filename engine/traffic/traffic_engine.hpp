#pragma once
/// Interface to a drive's traffic: Septet's own models, or another simulator.
///
///     engine.see_walls(walls)                    once, before all else, where there are any
///     engine.see_crossings(places)               once, where people walk
///     engine.start(parameters, foreign)          when the scenario requests a swarm
///     engine.show_lights(lights)                 each tick, where the roads have lights
///     engine.show_people(people)                 each tick, where there are any
///     engine.advance(foreign, tick_s)            each tick
///     engine.append_participants(participants)   each snapshot
///
/// An engine is bound to the network with which it was made. Same network, seed and calls: same traffic; no engine
/// reads a clock. One thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/core/hash.hpp"
#include "engine/sight/air.hpp"
#include "engine/sight/walls.hpp"
#include "engine/traffic/crossing.hpp"
#include "engine/traffic/traffic.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/traffic_light.hpp"

namespace septet {
class StateReader;
class StateWriter;
}  // namespace septet

namespace septet::traffic {

/// What limits drivers' sight in the next tick.
struct SightNow {
  std::span<const LimitedSight> limited;  ///< How much of the road ahead is seen: they stop within it.
  sight::OpticalDepth air;                ///< Valid for that tick.
  std::span<const std::uint32_t> gone;    ///< Things whose walls do not stand, ascending.
};

class TrafficEngine {
 public:
  virtual ~TrafficEngine() = default;
  /// Walls past which drivers do not see; they outlive the engine. An engine without this ability, or without junctions, ignores them.
  virtual void see_walls(const sight::Walls& /*walls*/) {}
  /// Crossings on foot, once. An engine whose drivers look at no people ignores them.
  virtual void see_crossings(std::span<const CrossingPlace> /*places*/) {}
  /// Starts a swarm around the first foreign vehicle; an earlier one is removed.
  virtual void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) = 0;
  /// Removes all vehicles.
  virtual void stop() = 0;
  /// Lights as they show in the next tick. An engine that lives where no lights hang ignores them.
  virtual void show_lights(std::span<const TrafficLight> /*lights*/) {}
  /// People on crossings, and those who are to be let pass there, by crossing, in the next tick. An engine without this
  /// ability ignores them.
  virtual void show_people(std::span<const PersonCrossing> /*people*/) {}
  /// Advances by one tick. `foreign` has the same vehicles in the same order each time;
  /// new ones come last.
  virtual void advance(std::span<const ForeignVehicle> foreign, double dt_s) = 0;
  /// Before each tick's `advance`. An engine without this ability ignores it.
  virtual void limit_sight(const SightNow& /*now*/) {}
  /// Gives a vehicle up: from now on others move it, and it comes back as a foreign one, the last in their order.
  /// False: it has none of that number, or keeps it.
  virtual bool release(ParticipantId /*id*/) { return false; }
  /// Adds vehicles on the driver's side, and worsens all drivers' manners by a step (traffic.hpp). An engine without
  /// this ability ignores it.
  virtual void worsen(std::uint32_t /*more_vehicles*/) {}
  /// Rates at which drivers err from now on, in later swarms too. Error: the drivers of this traffic never err.
  virtual Expected<void> set_errors(const PeopleErrorRates& rates);
  /// A driver overlooks another participant for one encounter: `who` from now on, or, where that is empty, the next one
  /// who would have to give way to `whom`. Error: the drivers of this traffic never err, or cannot do so now.
  virtual Expected<void> overlook(std::optional<ParticipantId> who, ParticipantId whom);
  /// Errors that began or ended in the last step.
  virtual std::vector<ToldError> take_errors() { return {}; }
  /// Those whose drivers err now, ascending: they may run into others of the engine.
  virtual std::vector<ParticipantId> erring() const { return {}; }
  virtual void append_participants(std::vector<Participant>& participants) const = 0;
  /// Adds all state that determines the traffic's future.
  virtual void add_to_hash(StateHash& hash) const = 0;
  /// True where that state is all here, so that `save` and `restore` may be called (engine/core/archive.hpp).
  virtual bool can_be_saved() const { return false; }
  virtual void save(StateWriter&) const {}
  /// Restores an engine made with the same network. `reader` fails on other data than `save` wrote.
  virtual void restore(StateReader&) {}
  /// Number of non-finite values that were reset since the last call.
  virtual std::uint32_t take_bad_numbers() { return 0; }
  /// Remark on the swarm once its first second is over, as key=value pairs: `asked` and `on_road`, where fewer than 95
  /// % or more than 105 % of the requested vehicles are there. Returned once; by Septet's own traffic again, each ten
  /// seconds at most, where a further tenth is gone: at the ends of a road shorter than the swarm's radius.
  virtual std::optional<std::string> take_remark() { return std::nullopt; }
  /// Drivers who in the last step came to see a junction that had been hidden from them.
  virtual std::vector<ViewOpening> take_openings() { return {}; }
  /// Failure outside of Septet, once. From then on the engine stands still; the drive is to end.
  virtual std::optional<Error> take_error() { return std::nullopt; }
};

/// The remark on a swarm of this size: empty within 5 % of the requested number.
std::optional<std::string> swarm_remark(std::size_t asked, std::size_t on_road);
/// Time of the first remark, and the least time between two.
inline constexpr double swarm_remark_s = 1.0, swarm_remark_again_s = 10.0;

/// Septet's own traffic: on a network whose ways cross, on all of its lanes (network/town.hpp); on any other, motorways
/// with their ramps above all, on the corridors of the driver's road (traffic.hpp). `network` outlives it.
std::unique_ptr<TrafficEngine> own_traffic(const road::RoadNetwork& network, std::uint64_t seed);

}  // namespace septet::traffic
