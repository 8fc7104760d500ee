#pragma once
/// Traffic of a given flow on given routes: who comes, when, and how many have come past a line. Cars alone, whose drivers
/// are drawn as a swarm's.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/traffic/network/lane_graph.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// Vehicles come in by chance, independently of each other (Poisson); who finds no room at the route's begin comes in as
/// soon as there is.
struct FlowSource {
  std::vector<WayIndex> route;
  double begin_m = 0.0;   ///< Where fronts come in, from the route's begin.
  double per_hour = 0.0;  ///< 0: as many as find room, so that there is always a queue.
  double next_s = 0.0;
  ParticipantId last = 0;  ///< Who came in last; 0: nobody has.
};

class FlowRun {
 public:
  FlowRun(const road::RoadNetwork& network, const LaneGraph& graph, std::uint64_t seed)
      : network_(network), graph_(graph), random_(seed, 1), arrivals_(seed, 2) {}

  void add(FlowSource source) { sources_.push_back(std::move(source)); }

  /// Drives on. Who has come to the end of his last way leaves.
  void drive(double seconds) {
    const TrafficParameters nobody = motorway_traffic(0, 1000.0);
    const double until_s = town_.time_s + seconds;
    while (town_.time_s < until_s) {
      for (FlowSource& source : sources_) bring_in(source);
      advance_town(nobody, network_, graph_, {}, {}, tick_s, random_, town_);
      std::erase_if(town_.vehicles, [&](const TownVehicle& vehicle) {
        double end_m = 0.0;
        for (const WayIndex way : vehicle.route) end_m += graph_.ways[way].length_m;
        return vehicle.outside || vehicle.front_m > end_m - 20.0;
      });
      for (const TownVehicle& vehicle : town_.vehicles) {
        stands_s_ = std::max(stands_s_, vehicle.stands_s);
        hard_ += vehicle.acceleration_mps2 < -4.0 && vehicle.speed_mps > 0.5 ? 1 : 0;
        for (Line& line : lines_)
          if (vehicle.route.front() == line.way && vehicle.front_m - vehicle.length_m() < tick_s * vehicle.speed_mps &&
              std::ranges::find(line.past, vehicle.id) == line.past.end())
            line.past.push_back(vehicle.id);
      }
    }
  }

  /// Counts who has wholly come onto a way from now on. Returns the counter's number.
  std::size_t count_on(WayIndex way) {
    lines_.push_back({way, {}});
    return lines_.size() - 1;
  }
  std::size_t counted(std::size_t line) const { return lines_[line].past.size(); }
  double longest_stand_s() const { return stands_s_; }
  double hard_s() const { return hard_ * tick_s; }  ///< Vehicle seconds of braking above 4 m/s².

  static constexpr double tick_s = 1.0 / 20.0;

 private:
  struct Line {
    WayIndex way = no_way;
    std::vector<ParticipantId> past;
  };

  void bring_in(FlowSource& source) {
    if (town_.time_s < source.next_s) return;
    // The last one's rear, and how fast it goes.
    double ahead_m = 100.0, ahead_mps = 14.0;
    const auto last = std::ranges::find(town_.vehicles, source.last, &TownVehicle::id);
    if (source.last != 0 && last != town_.vehicles.end()) {
      if (last->route.front() == source.route.front()) {
        ahead_m = last->front_m - last->length_m() - source.begin_m;
        ahead_mps = last->speed_mps;
      }
    }
    const bool queues = source.per_hour <= 0.0;
    // Behind one who stands it comes in so far behind him as drivers stand; else at the headway of a lane that is full.
    if (ahead_m < (queues ? 3.0 : 4.0) + 1.2 * ahead_mps) return;
    const TrafficParameters all = motorway_traffic(1, 1000.0);
    const VehicleClass& kind = all.classes.front();
    const double bell = (random_.uniform() + random_.uniform() + random_.uniform()) / 3.0;
    const double temperament = 0.5 + kind.temperament_spread * (bell - 0.5) * 1.5;
    TownVehicle car;
    car.id = source.last = next_id_++;
    car.model = kind.model;
    car.driver = driver_in_town(kind.middle, temperament);
    car.law = FollowingLaw(car.driver.following);
    car.urge = 1.15 - 0.3 * std::clamp(temperament, 0.0, 1.0);
    car.outside = false;
    car.route = source.route;
    car.front_m = source.begin_m;
    car.speed_mps = std::min(12.0, std::sqrt(ahead_mps * ahead_mps + 2.0 * 1.2 * std::max(0.0, ahead_m - 4.0)));
    town_.vehicles.push_back(std::move(car));
    if (!queues) source.next_s += -std::log(1.0 - arrivals_.uniform()) * 3600.0 / source.per_hour;
  }

  const road::RoadNetwork& network_;
  const LaneGraph& graph_;
  Random random_, arrivals_;
  TownState town_;
  std::vector<FlowSource> sources_;
  std::vector<Line> lines_;
  ParticipantId next_id_ = 1;
  double stands_s_ = 0.0;
  int hard_ = 0;
};

}  // namespace septet::traffic
