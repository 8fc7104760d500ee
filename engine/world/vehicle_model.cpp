#include "engine/world/vehicle_model.hpp"

#include <array>

namespace septet {
namespace {
using enum ParticipantKind;
// Length, width, height, wheelbase, rear overhang, track, wheel radius. The S80's outer dimensions and tyre are those of
// the 1999 model (4.822 × 1.831 × 1.435 m, wheelbase 2.791 m, 215/55 R16); the others are plain examples of their class.
constexpr std::array<VehicleModel, 10> models{{
    {"volvo-s80", car, 4.822, 1.831, 1.435, 2.791, 1.10, 1.57, 0.321},
    {"hatchback", car, 4.05, 1.74, 1.46, 2.55, 0.68, 1.48, 0.305},
    {"saloon", car, 4.62, 1.80, 1.44, 2.77, 0.98, 1.54, 0.316},
    {"estate", car, 4.75, 1.84, 1.50, 2.80, 1.05, 1.56, 0.321},
    {"suv", car, 4.70, 1.90, 1.70, 2.76, 0.98, 1.60, 0.360},
    {"van", van, 5.90, 2.02, 2.55, 3.66, 1.20, 1.72, 0.345},
    {"lorry", lorry, 11.90, 2.55, 3.85, 6.20, 4.25, 2.05, 0.500},
    {"ambulance", ambulance, 6.10, 2.08, 2.75, 3.66, 1.35, 1.72, 0.345},
    {"motorcycle", motorcycle, 2.20, 0.80, 1.40, 1.50, 0.35, 0.0, 0.310},
    {"pedestrian", pedestrian, 0.50, 0.60, 1.75, 0.20, 0.15, 0.20, 0.05},
}};
}  // namespace

std::span<const VehicleModel> vehicle_models() { return models; }

std::optional<ModelIndex> find_vehicle_model(std::string_view name) {
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i].name == name) return static_cast<ModelIndex>(i);
  return std::nullopt;
}

}  // namespace septet
