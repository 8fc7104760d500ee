/// septet-sumo.so: the only place that knows SUMO's client library (libtracicpp).
///
/// Vehicle states come by subscription: one message per step for all of them together. A call per vehicle and value
/// costs a round trip of some 17 µs each, which for 200 vehicles would take longer than the step.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/core.h>
#include <libsumo/libtraci.h>

#include "engine/math/angle_units.hpp"
#include "sim-server/sumo/sumo_client.hpp"

namespace septet::server {
namespace {

/// moveToXY: any edge, and off the network if there is none.
constexpr int anywhere = 2;

template <class Call>
auto asked(Call call) -> Expected<decltype(call())> {
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      call();
      return {};
    } else {
      return call();
    }
  } catch (const libsumo::TraCIException& refusal) {
    return failure(std::string("SUMO refuses: ") + refusal.what(), "--traffic sumo",
                   "check the scenario's road, or drive with --traffic own");
  } catch (const std::exception& gone) {
    return failure(std::string("SUMO has gone: ") + gone.what(), "--traffic sumo",
                   "start the drive again, or drive with --traffic own");
  }
}

double number(const libsumo::TraCIResults& values, int variable) {
  const auto found = values.find(variable);
  const auto* value = found == values.end() ? nullptr : dynamic_cast<const libsumo::TraCIDouble*>(found->second.get());
  return value ? value->value : 0.0;
}

class TraciClient final : public SumoClient {
 public:
  explicit TraciClient(int port) {
    libtraci::Simulation::init(port, 0);
    libtraci::Simulation::subscribe(std::vector<int>{libsumo::VAR_DEPARTED_VEHICLES_IDS});
  }
  ~TraciClient() override {
    (void)asked([] { libtraci::Simulation::close(); });
  }

  Expected<void> define_type(const SumoVehicleType& type) override {
    return asked([&] {
      using libtraci::VehicleType;
      VehicleType::copy(type.base, type.id);
      VehicleType::setLength(type.id, type.length_m);
      VehicleType::setWidth(type.id, type.width_m);
      VehicleType::setHeight(type.id, type.height_m);
      VehicleType::setMaxSpeed(type.id, type.following.desired_speed_mps);
      VehicleType::setTau(type.id, type.following.time_gap_s);
      VehicleType::setAccel(type.id, type.following.acceleration_mps2);
      VehicleType::setDecel(type.id, type.following.comfortable_braking_mps2);
      VehicleType::setMinGap(type.id, type.following.standstill_gap_m);
    });
  }

  Expected<void> add_vehicle(const SumoDeparture& departure) override {
    return asked([&] {
      // A speed that is demanded ("desired", or a number) and cannot be kept into the next edge has the vehicle thrown
      // away; "max" is lowered. A route is known by where it begins: the rest follows from the corridor.
      const std::string route = departure.route.front() + ">" + departure.route.back();
      if (std::ranges::find(routes_, route) == routes_.end()) {
        libtraci::Route::add(route, departure.route);
        routes_.push_back(route);
      }
      ++entries_[departure.id];
      libtraci::Vehicle::add(name_of(departure.id), route, departure.type, "now", std::to_string(departure.lane_index),
                             std::to_string(departure.along_m), "max");
      if (!departure.watched) libtraci::Vehicle::setSpeedMode(name_of(departure.id), 0);
      if (!departure.watched) unwatched_.push_back(name_of(departure.id));
    });
  }

  Expected<void> remove_vehicle(ParticipantId id) override {
    return asked([&] {
      // SUMO would still reply to the subscription once, with an error.
      try {
        if (std::erase(watched_, name_of(id)) > 0) libtraci::Vehicle::unsubscribe(name_of(id));
        libtraci::Vehicle::remove(name_of(id));
      } catch (const libsumo::TraCIException&) {
        // Unknown to SUMO: it reached the end of its route, or was never placed.
      }
    });
  }

  Expected<void> place_vehicle(ParticipantId id, const Vec2& front_m, double heading_rad) override {
    // SUMO's angles run clockwise from north.
    const double angle = 90.0 - heading_rad * degrees_per_radian;
    return asked([&] {
      try {
        libtraci::Vehicle::moveToXY(name_of(id), "", 0, front_m.x, front_m.y, angle, anywhere);
      } catch (const libsumo::TraCIException&) {
        // No road within its reach: traffic can ignore it.
      }
    });
  }

  Expected<void> set_standstill_gap(ParticipantId id, double gap_m) override {
    return asked([&] { libtraci::Vehicle::setMinGap(name_of(id), gap_m); });
  }

  Expected<void> hold_vehicle(ParticipantId id, bool held) override {
    constexpr double as_it_likes = -1.0;
    return asked([&] { libtraci::Vehicle::setSpeed(name_of(id), held ? 0.0 : as_it_likes); });
  }

  Expected<void> move_aside(ParticipantId id, double left_m) override {
    return asked([&] { libtraci::Vehicle::changeSublane(name_of(id), left_m); });
  }

  Expected<std::vector<SumoVehicle>> step() override {
    return asked([&] {
      libtraci::Simulation::step();
      const auto simulation = libtraci::Simulation::getSubscriptionResults();
      if (const auto found = simulation.find(libsumo::VAR_DEPARTED_VEHICLES_IDS); found != simulation.end())
        if (const auto* list = dynamic_cast<const libsumo::TraCIStringList*>(found->second.get()))
          for (const auto& name : list->value)
            if (std::ranges::find(unwatched_, name) == unwatched_.end()) {
              libtraci::Vehicle::subscribe(name, watched_values);
              watched_.push_back(name);
            }
      std::vector<SumoVehicle> vehicles;
      for (const auto& [name, values] : libtraci::Vehicle::getAllSubscriptionResults()) {
        SumoVehicle vehicle;
        std::from_chars(name.data(), name.data() + name.size(), vehicle.id);
        const auto place = values.find(libsumo::VAR_POSITION);
        const auto* at =
            place == values.end() ? nullptr : dynamic_cast<const libsumo::TraCIPosition*>(place->second.get());
        if (!at || at->x == libsumo::INVALID_DOUBLE_VALUE) continue;
        vehicle.front_m = {at->x, at->y};
        vehicle.heading_rad = (90.0 - number(values, libsumo::VAR_ANGLE)) / degrees_per_radian;
        vehicle.speed_mps = number(values, libsumo::VAR_SPEED);
        vehicle.acceleration_mps2 = number(values, libsumo::VAR_ACCELERATION);
        const auto signals = values.find(libsumo::VAR_SIGNALS);
        if (const auto* bits =
                signals == values.end() ? nullptr : dynamic_cast<const libsumo::TraCIInt*>(signals->second.get()))
          vehicle.signals = bits->value;
        vehicles.push_back(vehicle);
      }
      std::ranges::sort(vehicles, {}, &SumoVehicle::id);
      return vehicles;
    });
  }

 private:
  /// "101.3": the third entry of participant 101. SUMO remembers a subscription to a removed vehicle; a new one of the
  /// same name that still waits for room would reply to it with an error.
  std::string name_of(ParticipantId id) const { return fmt::format("{}.{}", id, entries_.at(id)); }

  inline static const std::vector<int> watched_values{libsumo::VAR_POSITION, libsumo::VAR_ANGLE, libsumo::VAR_SPEED,
                                                      libsumo::VAR_ACCELERATION, libsumo::VAR_SIGNALS};
  std::vector<std::string> routes_, unwatched_, watched_;
  std::map<ParticipantId, int> entries_;
};

Expected<std::unique_ptr<SumoClient>> connect(int port) {
  return asked([&]() -> std::unique_ptr<SumoClient> { return std::make_unique<TraciClient>(port); });
}

}  // namespace

// Looked up by this name (load_sumo_module), by C++ of the same build.
extern "C" {
extern const ConnectSumo septet_connect_sumo;
const ConnectSumo septet_connect_sumo = connect;
}

}  // namespace septet::server
