#include <utility>

#include "engine/traffic/save_traffic.hpp"
#include "engine/traffic/traffic_engine.hpp"

namespace septet::traffic {
namespace {

class OwnTraffic final : public TrafficEngine {
 public:
  OwnTraffic(const road::RoadNetwork& network, std::uint64_t seed) : network_(network), random_(seed, 1) {}

  void start(const TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) override {
    parameters_ = parameters;
    state_ = populate(parameters_, network_, foreign, random_);
  }
  void stop() override { state_ = {}; }
  void advance(std::span<const ForeignVehicle> foreign, double dt_s) override {
    traffic::advance(parameters_, network_, foreign, dt_s, random_, state_);
  }
  void worsen(std::uint32_t more_vehicles) override { traffic::worsen(parameters_, more_vehicles, random_, state_); }
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
  const road::RoadNetwork& network_;
  TrafficParameters parameters_;
  TrafficState state_;
  Random random_;
};

}  // namespace

std::unique_ptr<TrafficEngine> own_traffic(const road::RoadNetwork& network, std::uint64_t seed) {
  return std::make_unique<OwnTraffic>(network, seed);
}

}  // namespace septet::traffic
