#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/traffic/driver_members.hpp"
#include "engine/traffic/network/network_traffic.hpp"
#include "engine/traffic/save_traffic.hpp"
#include "engine/traffic/traffic_engine.hpp"

namespace septet::traffic {
namespace {

tl::unexpected<Error> never_errs() {
  return failure("the drivers of this traffic never err", "errors of people",
                 "give a road network whose ways cross a TrafficSwarmAction, and drive with Septet's own traffic");
}

class CorridorsTraffic final : public TrafficEngine {
 public:
  CorridorsTraffic(const road::RoadNetwork& network, std::uint64_t seed) : network_(network), random_(seed, 1) {}

  void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) override {
    parameters_ = parameters;
    state_ = populate(parameters_, network_, foreign, random_);
    told_missing_ = 0;
  }
  void stop() override { state_ = {}; }
  void advance(std::span<const ForeignVehicle> foreign, double dt_s) override {
    const double before_s = state_.time_s;
    traffic::advance(parameters_, network_, foreign, dt_s, random_, state_);
    if (before_s < swarm_remark_s && state_.time_s >= swarm_remark_s)
      remark_on_swarm(0);
    else if (std::floor(before_s / swarm_remark_again_s) < std::floor(state_.time_s / swarm_remark_again_s))
      remark_on_swarm(
          told_missing_ +
          std::max<std::size_t>(1, parameters_.count / 10));  // It thins out where the road is shorter than its radius.
  }
  void limit_sight(const SightNow& sight) override { state_.sights.assign(sight.limited.begin(), sight.limited.end()); }
  bool release(ParticipantId id) override {
    if (!remove_vehicle(id, state_)) return false;
    // It is not missed.
    parameters_.count -= std::min<std::uint32_t>(parameters_.count, 1);
    return true;
  }
  void worsen(std::uint32_t more_vehicles) override { traffic::worsen(parameters_, more_vehicles, random_, state_); }
  std::optional<std::string> take_remark() override { return std::exchange(remark_, std::nullopt); }
  std::uint32_t take_bad_numbers() override { return std::exchange(state_.bad_numbers, 0); }
  void append_participants(std::vector<Participant>& participants) const override {
    traffic::append_participants(state_, network_, participants);
  }
  void add_to_hash(StateHash& hash) const override {
    hash_state(hash, state_);
    hash_members(hash, random_);
  }
  bool can_be_saved() const override { return true; }
  void save(StateWriter& writer) const override {
    save_traffic(parameters_, state_, writer);
    transfer(writer, random_);
  }
  void restore(StateReader& reader) override {
    restore_traffic(network_, reader, parameters_, state_);
    transfer(reader, random_);
  }

 private:
  /// Remarks on the swarm's size (swarm_remark); with `missing` above 0 only if more vehicles than that are missing.
  void remark_on_swarm(std::size_t missing) {
    const std::size_t on_road = vehicles_on_road();
    if (on_road + missing >= parameters_.count && missing > 0) return;
    if (auto remark = swarm_remark(parameters_.count, on_road)) {
      remark_ = std::move(remark);
      told_missing_ = parameters_.count > on_road ? parameters_.count - on_road : 0;
    }
  }
  std::size_t vehicles_on_road() const {
    std::size_t count = 0;
    for (const CorridorTraffic& traffic : state_.corridors)
      count += traffic.size() - static_cast<std::size_t>(std::ranges::count(traffic.lane, std::int16_t{0}));
    return count;
  }

  const road::RoadNetwork& network_;
  TrafficParameters parameters_;
  TrafficState state_;
  Random random_;
  std::optional<std::string> remark_;
  std::size_t told_missing_ = 0;  ///< In the last remark.
};

/// Of a network whose ways cross: a swarm lives on all of it. Until there is one it is as anywhere.
class CrossingTraffic final : public TrafficEngine {
 public:
  CrossingTraffic(const road::RoadNetwork& network, LaneGraph graph, std::uint64_t seed)
      : none_(network, seed), network_(network_traffic(network, std::move(graph), seed)) {}

  void see_walls(const sight::Walls& walls) override { network_->see_walls(walls); }
  void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) override {
    is_started_ = true;
    TrafficParameters erring = parameters;
    erring.errors = errors_;
    network_->start(erring, foreign);
  }
  void see_crossings(std::span<const CrossingPlace> places) override { network_->see_crossings(places); }
  void show_people(std::span<const PersonCrossing> people) override { now().show_people(people); }
  void stop() override { now().stop(); }
  void show_lights(std::span<const TrafficLight> lights) override { now().show_lights(lights); }
  void advance(std::span<const ForeignVehicle> foreign, double dt_s) override { now().advance(foreign, dt_s); }
  void limit_sight(const SightNow& sight) override { now().limit_sight(sight); }
  bool release(ParticipantId id) override { return now().release(id); }
  void worsen(std::uint32_t more_vehicles) override { now().worsen(more_vehicles); }
  Expected<void> set_errors(const PeopleErrorRates& rates) override {
    errors_ = rates;
    return network_->set_errors(rates);
  }
  Expected<void> overlook(std::optional<ParticipantId> who, ParticipantId whom) override {
    return now().overlook(who, whom);
  }
  std::vector<ToldError> take_errors() override { return now().take_errors(); }
  std::vector<ParticipantId> erring() const override { return now().erring(); }
  void append_participants(std::vector<Participant>& participants) const override {
    now().append_participants(participants);
  }
  void add_to_hash(StateHash& hash) const override { now().add_to_hash(hash); }
  bool can_be_saved() const override { return true; }
  void save(StateWriter& writer) const override {
    transfer(writer, is_started_);
    transfer(writer, errors_);
    now().save(writer);
  }
  void restore(StateReader& reader) override {
    transfer(reader, is_started_);
    transfer(reader, errors_);
    now().restore(reader);
  }
  std::uint32_t take_bad_numbers() override { return now().take_bad_numbers(); }
  std::optional<std::string> take_remark() override { return now().take_remark(); }
  std::vector<ViewOpening> take_openings() override { return now().take_openings(); }

 private:
  TrafficEngine& now() {
    if (is_started_) return *network_;
    return none_;
  }
  const TrafficEngine& now() const {
    if (is_started_) return *network_;
    return none_;
  }

  CorridorsTraffic none_;
  std::unique_ptr<TrafficEngine> network_;
  bool is_started_ = false;
  PeopleErrorRates errors_;  ///< Of the swarm, or the next one.
};

}  // namespace

std::optional<std::string> swarm_remark(std::size_t asked, std::size_t on_road) {
  const std::size_t off = asked > on_road ? asked - on_road : on_road - asked;
  if (20 * off <= asked) return std::nullopt;
  return fmt::format("asked={} on_road={}", asked, on_road);
}

Expected<void> TrafficEngine::set_errors(const PeopleErrorRates& /*rates*/) { return never_errs(); }

Expected<void> TrafficEngine::overlook(std::optional<ParticipantId> /*who*/, ParticipantId /*whom*/) {
  return never_errs();
}

std::unique_ptr<TrafficEngine> own_traffic(const road::RoadNetwork& network, std::uint64_t seed) {
  // Only a connecting road's ways can cross.
  const bool has_connections =
      std::ranges::any_of(network.roads, [](const road::Road& road) { return road.junction != road::no_index; });
  if (has_connections)
    if (LaneGraph graph = build_lane_graph(network); has_crossings(graph))
      return std::make_unique<CrossingTraffic>(network, std::move(graph), seed);
  return std::make_unique<CorridorsTraffic>(network, seed);
}

}  // namespace septet::traffic
