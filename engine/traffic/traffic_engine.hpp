#pragma once
/// Whoever moves a drive's traffic: Septet's own models, or another simulator that is asked to.
///
///     engine.start(parameters, foreign)          when the scenario asks for a swarm
///     engine.advance(foreign, tick_s)            each tick
///     engine.append_participants(participants)   each snapshot
///
/// An engine answers for the network it was made with. Same network, seed and calls: same traffic;
/// no engine looks at a clock. One thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/core/hash.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet {
class StateReader;
class StateWriter;
}  // namespace septet

namespace septet::traffic {

class TrafficEngine {
 public:
  virtual ~TrafficEngine() = default;
  /// A swarm around the first foreign vehicle; one that was there before is gone.
  virtual void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) = 0;
  /// Nobody is on the road any more.
  virtual void stop() = 0;
  /// One tick on. `foreign` has the same vehicles in the same order each time.
  virtual void advance(std::span<const ForeignVehicle> foreign, double dt_s) = 0;
  /// More vehicles on the driver's side, and everybody's manners worse by a step (traffic.hpp). Who cannot do that does nothing.
  virtual void worsen(std::uint32_t /*more_vehicles*/) {}
  virtual void append_participants(std::vector<Participant>& participants) const = 0;
  /// Everything that decides how the traffic goes on.
  virtual void add_to_hash(StateHash& hash) const = 0;
  /// Whether all that decides how the traffic goes on is in here, so that `save` and `restore` (engine/core/archive.hpp) may be called.
  virtual bool can_be_saved() const { return false; }
  virtual void save(StateWriter&) const {}
  /// Of an engine made with the same network. `reader` fails where that is not what was saved.
  virtual void restore(StateReader&) {}
  /// How many numbers have gone bad and were reset since the last call.
  virtual std::uint32_t take_bad_numbers() { return 0; }
  /// What there is to say of the swarm once its first second is over, as key=value pairs: `asked` and `on_road`, where fewer than 95 % or more
  /// than 105 % of the vehicles that were asked for are there. Septet's own traffic says it again, each ten seconds at most, where a further
  /// tenth has gone: at the ends of a road that is shorter than the swarm's radius nobody comes back.
  virtual std::optional<std::string> take_remark() { return std::nullopt; }
  /// What has gone wrong outside, once. From then on the engine stands still; the drive is to end.
  virtual std::optional<Error> take_error() { return std::nullopt; }
};

/// The remark on a swarm of so many: nothing where they are as many as asked for, within 5 %.
std::optional<std::string> swarm_remark(std::size_t asked, std::size_t on_road);
/// When it is made.
inline constexpr double swarm_remark_s = 1.0, swarm_remark_again_s = 10.0;

/// Septet's own traffic (traffic.hpp). `network` outlives it.
std::unique_ptr<TrafficEngine> own_traffic(const road::RoadNetwork& network, std::uint64_t seed);

}  // namespace septet::traffic
