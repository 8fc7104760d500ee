#pragma once
/// The catalogue of vehicles (and other participants): name, kind, dimensions.
///
/// The same index names the model in snapshots, in the scene (prototype object "model/NAME") and in traffic. Dimensions
/// follow OpenSCENARIO's bounding box and axles; the origin is the vehicle frame's (rigid_transform.hpp).

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace septet {

enum class ParticipantKind : std::uint8_t { car, van, lorry, bus, motorcycle, bicycle, pedestrian, ambulance, object };

using ModelIndex = std::uint16_t;

struct VehicleModel {
  std::string_view name;
  ParticipantKind kind;
  double length_m, width_m, height_m;
  double wheelbase_m;
  double rear_overhang_m;  ///< From the rear axle back to the rear bumper; the bounding box runs from −rear_overhang_m.
  double track_m;
  double wheel_radius_m;

  double front_m() const { return length_m - rear_overhang_m; }  ///< x of the front bumper.
  double centre_x_m() const { return length_m / 2.0 - rear_overhang_m; }
};

/// True for those who drive a body of sheet metal on four wheels: no two-wheelers, people or objects.
bool has_four_wheels(ParticipantKind kind);

std::span<const VehicleModel> vehicle_models();
std::optional<ModelIndex> find_vehicle_model(std::string_view name);

}  // namespace septet
