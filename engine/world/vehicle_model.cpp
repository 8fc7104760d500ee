#include "engine/world/vehicle_model.hpp"

#include <array>

namespace septet {
namespace {
using enum ParticipantKind;
// Length, width, height, wheelbase, rear overhang, track, wheel radius. The S80's outer dimensions and tyre are those
// of the 1999 model (4.822 × 1.831 × 1.435 m, wheelbase 2.791 m, 215/55 R16); the others are plain examples of their
// class, no longer, wider or higher than 96/53/EC lets them be. All are those of what is drawn, to 2 cm, without
// mirrors and what stands on the roofs of cars. Logs and sessions hold indices: new ones come last.
constexpr std::array<VehicleModel, 36> models{{
    {"volvo-s80", car, 4.822, 1.831, 1.435, 2.791, 1.10, 1.57, 0.321},
    {"hatchback", car, 4.05, 1.74, 1.46, 2.55, 0.68, 1.48, 0.305},
    {"saloon", car, 4.62, 1.80, 1.44, 2.77, 0.98, 1.54, 0.316},
    {"estate", car, 4.75, 1.84, 1.50, 2.80, 1.05, 1.56, 0.321},
    {"suv", car, 4.70, 1.90, 1.70, 2.76, 0.98, 1.60, 0.360},
    {"van", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    {"lorry", lorry, 11.90, 2.55, 3.85, 6.20, 4.25, 2.05, 0.500},
    {"ambulance", ambulance, 6.10, 2.08, 2.75, 3.66, 1.35, 1.72, 0.345},
    {"motorcycle", motorcycle, 2.20, 0.80, 1.54, 1.50, 0.35, 0.0, 0.310},
    {"pedestrian", pedestrian, 0.50, 0.60, 1.75, 0.20, 0.15, 0.20, 0.05},
    // Outlined as the saloon is,
    {"taxi", car, 4.62, 1.80, 1.44, 2.77, 0.98, 1.54, 0.316},
    {"police-car", car, 4.62, 1.80, 1.44, 2.77, 0.98, 1.54, 0.316},
    {"coupe", car, 4.62, 1.80, 1.44, 2.77, 0.98, 1.54, 0.316},
    // as the SUV,
    {"pick-up", car, 4.70, 1.90, 1.70, 2.76, 0.98, 1.60, 0.360},
    {"mpv", car, 4.70, 1.90, 1.70, 2.76, 0.98, 1.60, 0.360},
    // as the van,
    {"minibus", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    {"dropside-van", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    {"box-van", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    {"police-van", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    // as the lorry, tankers and tippers lower.
    {"tanker", lorry, 11.90, 2.55, 3.44, 6.20, 4.25, 2.05, 0.500},
    {"tipper", lorry, 11.90, 2.55, 3.20, 6.20, 4.25, 2.05, 0.500},
    {"city-articulated", lorry, 11.90, 2.55, 3.85, 6.20, 4.25, 2.05, 0.500},
    {"timber-lorry", lorry, 11.90, 2.55, 3.85, 6.20, 4.25, 2.05, 0.500},
    {"coach", bus, 11.90, 2.55, 3.85, 6.20, 4.25, 2.05, 0.500},
    // With outlines of their own. Articulated vehicles are drawn as one body, their origin below the last axles.
    {"city-bus", bus, 12.00, 2.55, 3.10, 5.90, 3.40, 2.10, 0.480},
    {"articulated-lorry", lorry, 16.50, 2.55, 4.00, 11.30, 3.80, 2.05, 0.500},
    {"fire-engine", lorry, 8.20, 2.50, 3.30, 4.60, 2.20, 2.05, 0.500},
    {"farm-tractor", lorry, 4.60, 2.20, 2.90, 2.55, 0.95, 1.64, 0.800},
    {"sports-car", car, 4.35, 1.86, 1.27, 2.55, 0.90, 1.58, 0.330},
    {"caravan", van, 6.40, 2.30, 2.60, 2.20, 1.90, 2.00, 0.320},
    {"semitrailer", lorry, 13.60, 2.55, 4.00, 7.70, 3.80, 2.05, 0.500},
    {"tractor-unit", lorry, 6.00, 2.50, 3.80, 3.70, 0.95, 2.05, 0.500},
    {"bicycle", bicycle, 1.80, 0.60, 1.73, 1.05, 0.37, 0.0, 0.340},
    // Whose riders were thrown off.
    {"bicycle-alone", bicycle, 1.80, 0.60, 1.01, 1.05, 0.37, 0.0, 0.340},
    {"motorcycle-alone", motorcycle, 2.20, 0.80, 1.07, 1.50, 0.35, 0.0, 0.310},
    // A scenario's object; each has a size of its own (participant_shape.hpp).
    {"box", object, 1.0, 1.0, 1.0, 0.0, 0.5, 0.0, 0.0},
}};
}  // namespace

bool has_four_wheels(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::car:
    case ParticipantKind::van:
    case ParticipantKind::lorry:
    case ParticipantKind::bus:
    case ParticipantKind::ambulance:
      return true;
    default:
      return false;
  }
}

std::span<const VehicleModel> vehicle_models() { return models; }

std::optional<ModelIndex> find_vehicle_model(std::string_view name) {
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i].name == name) return static_cast<ModelIndex>(i);
  return std::nullopt;
}

}  // namespace septet
