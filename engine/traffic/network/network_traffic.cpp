#include "engine/traffic/network/network_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/traffic/driver_members.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town.hpp"

namespace septet {
SEPTET_MEMBERS(ToldError, kind, who, whom, lasted_s, end, nearest_m)
}

namespace septet::traffic {

SEPTET_MEMBERS(Swerve, own, over, from_m, to_m, left_m)
// Kept are a vehicle's constants, drawn when it came in, and what is for the log alone.
SEPTET_MEMBER_GROUPS(TownVehicle, hashed(id), kept(model, paint, driver, law, urge),
                     hashed(outside, route, front_m, speed_mps, acceleration_mps2), kept(rolled_m),
                     hashed(claims, unused_s, waits_s), kept(stands_s, hidden_s), hashed(swerve, is_held))
SEPTET_MEMBERS(DriverError, who, kind, stage, whom, since_s, lasts_s, nearest_m, leader_gap_m, leader_mps, waits_within,
               way)
SEPTET_MEMBERS(AwaitedOverlook, whom, since_s)
// Told is for the log alone.
SEPTET_MEMBER_GROUPS(TownErrors, hashed(drivers, awaited, red_for_s), kept(told))
// Errors are hashed where there are any. People, sights and air are given anew each tick, openings taken in it.
SEPTET_MEMBER_GROUPS(TownState, hashed(vehicles, time_s), left_out(people, sights, air, openings), kept(errors),
                     hashed(claims, foreign_stands_s), kept(bad_numbers, next_id))

namespace {

constexpr auto wrong = "traffic in it does not fit together";

void require_drivable(const LaneGraph& graph, const TownVehicle& vehicle, StateReader& reader) {
  reader.require(vehicle.model < vehicle_models().size() && vehicle.outside == vehicle.route.empty() &&
                     vehicle.claims.size() <= vehicle.route.size(),
                 wrong);
  for (const WayIndex way : vehicle.route) reader.require(way < graph.ways.size(), wrong);
  if (vehicle.swerve)
    reader.require(vehicle.swerve->own < graph.ways.size() && vehicle.swerve->over < graph.ways.size() &&
                       vehicle.swerve->from_m <= vehicle.swerve->to_m && std::abs(vehicle.swerve->left_m) < 10.0,
                   wrong);
  if (!reader.ok()) return;
  double length_m = 0.0;
  for (std::size_t k = 0; k < vehicle.route.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    length_m += way.length_m;
    const auto next = graph.next_of(way);
    if (k + 1 < vehicle.route.size())
      reader.require(std::ranges::find(next, vehicle.route[k + 1]) != next.end(), wrong);
  }
  constexpr double most_mps = 200.0;
  reader.require(vehicle.front_m >= 0.0 && vehicle.front_m <= length_m + 1.0 && vehicle.speed_mps >= 0.0 &&
                     vehicle.speed_mps < most_mps && std::isfinite(vehicle.rolled_m) && vehicle.urge > 0.0,
                 wrong);
}

void require_sound(const LaneGraph& graph, const TownErrors& errors, StateReader& reader) {
  using enum DriverError::Stage;
  for (const ToldError& told : errors.told)
    reader.require(told.kind <= PeopleError::red && (!told.end || *told.end <= ErrorEnd::gone), wrong);
  reader.require(std::ranges::is_sorted(errors.drivers, {}, &DriverError::who), wrong);
  for (const DriverError& error : errors.drivers)
    reader.require(error.kind <= PeopleError::red && error.stage <= over &&
                       (error.way == no_way || error.way < graph.ways.size()) &&
                       (error.kind != PeopleError::overlook || error.stage != runs || error.whom.has_value()),
                   wrong);
}

class NetworkTraffic final : public TrafficEngine {
 public:
  NetworkTraffic(const road::RoadNetwork& network, LaneGraph graph, std::uint64_t seed)
      : network_(network), graph_(std::move(graph)), random_(seed, 1) {}

  void see_walls(const sight::Walls& walls) override {
    walls_ = &walls;
    look_past_walls(walls, graph_, gone_);
  }
  void see_crossings(std::span<const CrossingPlace> places) override { mark_crossings(network_, places, graph_); }
  void show_people(std::span<const PersonCrossing> people) override {
    town_.people.assign(people.begin(), people.end());
  }
  void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) override {
    parameters_ = parameters;
    town_ = populate_town(parameters_, network_, graph_, foreign, random_);
  }
  void stop() override { town_ = {}; }
  void show_lights(std::span<const TrafficLight> lights) override { lights_.assign(lights.begin(), lights.end()); }
  void advance(std::span<const ForeignVehicle> foreign, double dt_s) override {
    const double before_s = town_.time_s;
    advance_town(parameters_, network_, graph_, lights_, foreign, dt_s, random_, town_);
    if (before_s < swarm_remark_s && town_.time_s >= swarm_remark_s)
      remark_ = swarm_remark(town_.vehicles.size(), on_road());
  }
  void limit_sight(const SightNow& now) override {
    town_.sights.assign(now.limited.begin(), now.limited.end());
    town_.air = now.air;
    if (std::ranges::equal(now.gone, gone_)) return;
    gone_.assign(now.gone.begin(), now.gone.end());
    if (walls_) look_past_walls(*walls_, graph_, gone_);
  }
  bool release(ParticipantId id) override {
    const auto found = std::ranges::find(town_.vehicles, id, &TownVehicle::id);
    if (found == town_.vehicles.end()) return false;
    // Who leaves the rails has met somebody.
    end_at_touch(id, town_);
    town_.vehicles.erase(found);
    parameters_.count -= std::min<std::uint32_t>(parameters_.count, 1);
    return true;
  }
  void worsen(std::uint32_t more_vehicles) override {
    if (!town_.vehicles.empty()) worsen_town(parameters_, graph_, more_vehicles, random_, town_);
  }
  Expected<void> set_errors(const PeopleErrorRates& rates) override {
    parameters_.errors = rates;
    return {};
  }
  Expected<void> overlook(std::optional<ParticipantId> who, ParticipantId whom) override {
    return traffic::overlook(who, whom, town_);
  }
  std::vector<ToldError> take_errors() override { return std::exchange(town_.errors.told, {}); }
  std::vector<ParticipantId> erring() const override {
    std::vector<ParticipantId> erring;
    for (const DriverError& error : town_.errors.drivers)
      if (error.stage != DriverError::Stage::waits && (erring.empty() || erring.back() != error.who))
        erring.push_back(error.who);
    return erring;
  }
  std::optional<std::string> take_remark() override { return std::exchange(remark_, std::nullopt); }
  std::vector<ViewOpening> take_openings() override { return std::exchange(town_.openings, {}); }
  std::uint32_t take_bad_numbers() override { return std::exchange(town_.bad_numbers, 0); }
  void append_participants(std::vector<Participant>& participants) const override {
    traffic::append_participants(graph_, town_, participants);
  }
  void add_to_hash(StateHash& hash) const override {
    hash_members(hash, town_, random_);
    if (parameters_.errors.any() || town_.errors.any()) hash_members(hash, town_.errors);
  }
  bool can_be_saved() const override { return true; }
  void save(StateWriter& writer) const override {
    transfer(writer, parameters_);
    transfer(writer, town_);
    transfer(writer, random_);
  }
  void restore(StateReader& reader) override {
    transfer(reader, parameters_);
    transfer(reader, town_);
    transfer(reader, random_);
    for (const VehicleClass& kind : parameters_.classes) reader.require(kind.model < vehicle_models().size(), wrong);
    reader.require(town_.vehicles.empty() || !parameters_.classes.empty(), wrong);
    for (const TownVehicle& vehicle : town_.vehicles) require_drivable(graph_, vehicle, reader);
    require_sound(graph_, town_.errors, reader);
  }

 private:
  std::size_t on_road() const {
    return static_cast<std::size_t>(std::ranges::count(town_.vehicles, false, &TownVehicle::outside));
  }

  const road::RoadNetwork& network_;
  LaneGraph graph_;
  const sight::Walls* walls_ = nullptr;
  std::vector<std::uint32_t> gone_;  ///< Things whose walls `graph_` takes not to stand.
  TrafficParameters parameters_;
  TownState town_;
  std::vector<TrafficLight> lights_;  ///< Of this tick.
  Random random_;
  std::optional<std::string> remark_;
};

}  // namespace

std::unique_ptr<TrafficEngine> network_traffic(const road::RoadNetwork& network, LaneGraph graph, std::uint64_t seed) {
  return std::make_unique<NetworkTraffic>(network, std::move(graph), seed);
}

}  // namespace septet::traffic
