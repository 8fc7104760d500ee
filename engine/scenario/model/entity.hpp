#pragma once
/// Participants of a scenario (OpenSCENARIO XML 1.3, "Entities"), as plain data.
///
/// Metres, seconds, radians. Bounding boxes and axles stand in the entity's frame, which is the vehicle frame of
/// rigid_transform.hpp.

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "engine/math/rigid_transform.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenario {

using EntityIndex = std::uint32_t;
inline constexpr EntityIndex no_entity = std::numeric_limits<EntityIndex>::max();

enum class EntityKind : std::uint8_t { vehicle, pedestrian, misc_object };

struct BoundingBox {
  Vec3 centre_m{0.0};
  double length_m = 0.0, width_m = 0.0, height_m = 0.0;

  double front_m() const { return centre_m.x + length_m / 2.0; }
  double rear_m() const { return centre_m.x - length_m / 2.0; }
};

struct Axle {
  double max_steering_rad = 0.0;
  double wheel_diameter_m = 0.0;
  double track_m = 0.0;
  double x_m = 0.0, z_m = 0.0;
};

/// Bounds of speed and acceleration actions; infinite where the file gives none.
struct Performance {
  double max_speed_mps = std::numeric_limits<double>::infinity();
  double max_acceleration_mps2 = std::numeric_limits<double>::infinity();
  double max_deceleration_mps2 = std::numeric_limits<double>::infinity();
};

struct Entity {
  std::string name;
  EntityKind kind = EntityKind::vehicle;
  std::string type_name;  ///< Name of the vehicle, pedestrian or object itself: "volvo-s80".
  std::string category;   ///< The standard's word: "car", "truck", "pedestrian", "barrier", …
  std::string role;       ///< The standard's word: "none", "ambulance", "police", …
  BoundingBox box;
  Axle front_axle, rear_axle;
  Performance performance;
  double mass_kg = 0.0;
  std::map<std::string, std::string> properties;
  ModelIndex model = 0;  ///< Drawn model; chosen by match_vehicle_model.
};

/// Kind of a vehicle of this category (OpenSCENARIO's word); a car for the rest.
ParticipantKind kind_of_category(std::string_view category);

/// Of an object the box (participant_shape.hpp). Else the model of the same name as the entity's type; else the one that its role, category and name suggest
/// ("car_police"); else, among those of its kind (category and role), the one nearest in length, width and height; else
/// the nearest of any kind.
ModelIndex match_vehicle_model(const Entity& entity);

}  // namespace septet::scenario
