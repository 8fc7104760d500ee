#pragma once
/// A vehicle's or a person's body for crashes: its mass, its clearance above the road, the slope and crush of its
/// front. The values and their sources stand in bodies.toml, fronts.toml and crush.toml beside this file.

#include <optional>

#include "engine/world/vehicle_model.hpp"

namespace septet {

struct VehicleBody {
  double mass_kg;
  double clearance_m;  ///< From the road to its lowest edge.
};
const VehicleBody& vehicle_body(ParticipantKind kind);

/// Height above the road of a body's middle, between its lowest edge and its top.
double middle_height_m(const VehicleModel& model);

/// Slope from the bonnet's edge to the roof's beginning, as shares of the height and the length.
struct FrontSlope {
  double edge_height, roof_begins;
};
/// Empty for a body as high in front as behind.
std::optional<FrontSlope> front_slope(ParticipantKind kind);

/// A passenger car crushes against a rigid wall like a spring without return (engine/effects/debris/crash.hpp), and
/// harder beyond its crumple zone.
struct Crush {
  double frequency_radps;
  double crumple_m;
  double harder_times;
};
const Crush& passenger_car_crush();
/// A box (participant_shape.hpp) hardly gives.
const Crush& box_crush();

}  // namespace septet
