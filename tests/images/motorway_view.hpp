#pragma once
/// The scenario's motorway with traffic at fixed instants, for tests of pictures.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include "engine/core/check.hpp"
#include "engine/instant/instant.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/shipped_files.hpp"

namespace septet {

inline constexpr std::uint32_t motorway_width_px = 320, motorway_height_px = 210;

struct MotorwayInstant {
  const char* name;
  double s_m;
  double heading_deg;
  bool night, rain;
};

class Motorway {
 public:
  Motorway() {
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_road_world(builder, network_, 1);
    scene_ = scene::resolve(store);
  }
  const scene::ResolvedScene& scene() const { return scene_; }

  instant::FrameInput frame(const MotorwayInstant& instant) const {
    const Snapshot shown = snapshot(instant);
    instant::FrameInput input;
    input.simulated_time_s = shown.simulated_time_s;
    input.environment = shown.environment;
    instant::FrameView view;
    view.projection = instant::symmetric_view(Vec3(1.35, 0.37, 1.17), instant.heading_deg * std::numbers::pi / 180.0,
                                              0.0, 0.77, 0.52);
    view.world_from_car = in_lane(-3, instant.s_m);
    view.viewport = {0, 0, motorway_width_px, motorway_height_px};
    input.views.push_back(view);
    for (const Participant& participant : shown.participants) add(input, participant);
    // The driver's car gives its light and its shadow.
    input.participants.back().shown = instant::Shown::shadow_and_light;
    return input;
  }

  /// A server's snapshot: traffic, standing, and the driver's car as the last participant. All drive at `speed_mps`.
  Snapshot snapshot(const MotorwayInstant& instant, double speed_mps = 0.0) const {
    Snapshot shown;
    shown.tick = 1440;
    shown.simulated_time_s = 12.0;
    if (instant.rain) {
      shown.environment.rain_mm_per_h = 6.0;
      shown.environment.road_wetness = 0.8;
      shown.environment.cloud_cover = 1.0;
      shown.environment.visibility_m = 3000.0;
    }
    if (instant.night) {
      shown.environment.sun_elevation_rad = -0.4;
      shown.environment.sun_illuminance_lux = 0.0;
    }
    for (std::size_t i = 0; i < 14; ++i) {
      // Some ahead of the eye and some behind it, in all lanes but its own nearby.
      const double ahead_m = (i % 2 == 0 ? 14.0 : -16.0) + (i % 2 == 0 ? 9.0 : -9.0) * static_cast<double>(i);
      add_vehicle(shown.participants, i, in_lane(-2 - static_cast<int>((i * 2 + 2) % 5), instant.s_m + ahead_m),
                  instant.night || instant.rain);
    }
    Participant own{.id = 100, .model = *find_vehicle_model("volvo-s80")};
    own.world_from_vehicle = in_lane(-3, instant.s_m);
    own.lamps.set(Lamp::low_beam, instant.night);
    shown.participants.push_back(own);
    for (Participant& each : shown.participants)
      each.velocity_mps = each.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
    shown.driver_car = {.participant = own.id, .speed_mps = speed_mps, .engine_radps = 220.0, .gear = 4};
    return shown;
  }

  /// One that stands there, without lamps.
  instant::DrawnParticipant vehicle(std::string_view name, const RigidTransform& world_from_vehicle) const {
    Participant participant{.id = 1, .model = *find_vehicle_model(name)};
    participant.world_from_vehicle = world_from_vehicle;
    return instant::drawn_participant(participant, prototype(name));
  }

  /// Adds this many vehicles, evenly along all 10 km and over its five lanes.
  void add_traffic(instant::FrameInput& input, std::size_t count, bool lit) const {
    double length_m = 0.0;
    for (road::RoadIndex each = 0; each < main_roads; ++each) length_m += network_.roads[each].length_m;
    for (std::size_t i = 0; input.participants.size() < count && i < 2 * count; ++i) {
      double s_m = length_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      road::RoadIndex on = 0;
      while (on + 1 < main_roads && s_m > network_.roads[on].length_m) s_m -= network_.roads[on++].length_m;
      std::vector<Participant> more;
      add_vehicle(more, i, in_lane(-2 - static_cast<int>(i * 2 % 5), std::fmod(s_m, network_.roads[on].length_m), on),
                  lit);
      for (const Participant& participant : more) add(input, participant);
    }
  }

 private:
  static constexpr road::RoadIndex main_roads = 3;

  RigidTransform in_lane(int lane, double s_m, road::RoadIndex on = 0) const {
    return road::world_from_lane(road::evaluate_lane(network_, {on, lane, s_m, 0.0}));
  }
  /// Model, paint and lamps follow from its number. Without pedestrians.
  static void add_vehicle(std::vector<Participant>& participants, std::size_t i,
                          const RigidTransform& world_from_vehicle, bool lit) {
    const auto& models = vehicle_models();
    Participant participant{.id = static_cast<ParticipantId>(i)};
    participant.model = static_cast<ModelIndex>(i % models.size());
    if (models[participant.model].kind == ParticipantKind::pedestrian) return;
    participant.paint = static_cast<std::uint8_t>(i);
    participant.world_from_vehicle = world_from_vehicle;
    participant.wheel_spin_rad = 0.4;
    participant.lamps.set(Lamp::low_beam, lit);
    participant.lamps.set(Lamp::brake, i % 4 == 0);
    participant.lamps.set(Lamp::beacon, models[participant.model].kind == ParticipantKind::ambulance);
    participants.push_back(participant);
  }
  void add(instant::FrameInput& input, const Participant& participant) const {
    input.participants.push_back(
        instant::drawn_participant(participant, prototype(vehicle_models()[participant.model].name)));
  }
  std::uint32_t prototype(std::string_view name) const {
    const auto found = std::ranges::find(scene_.prototypes, name, &scene::Prototype::name);
    SEPTET_CHECK(found != scene_.prototypes.end(), "no vehicle {}", name);
    return static_cast<std::uint32_t>(found - scene_.prototypes.begin());
  }

  static road::RoadNetwork read() {
    const auto network =
        road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr");
    SEPTET_CHECK(network, "{}", describe(network.error()));
    return *network;
  }

  road::RoadNetwork network_ = read();
  scene::ResolvedScene scene_;
};

}  // namespace septet
