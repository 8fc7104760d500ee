#include "engine/world/vehicle_body.hpp"

#include "engine/core/check.hpp"

namespace septet {
namespace crush_entries {
namespace {

#define SEPTET_ENTRY(name, ...) constexpr Crush name __VA_ARGS__;
#include "engine/world/crush.toml.inc"

}  // namespace
}  // namespace crush_entries

const VehicleBody& vehicle_body(ParticipantKind kind) {
  switch (kind) {
#define SEPTET_ENTRY(name, ...)                    \
  case ParticipantKind::name: {                    \
    static constexpr VehicleBody data __VA_ARGS__; \
    return data;                                   \
  }
#include "engine/world/bodies.toml.inc"
  }
  SEPTET_CHECK(false, "kind {}", static_cast<int>(kind));
}

double middle_height_m(const VehicleModel& model) {
  return 0.5 * (vehicle_body(model.kind).clearance_m + model.height_m);
}

std::optional<FrontSlope> front_slope(ParticipantKind kind) {
  switch (kind) {
#define SEPTET_ENTRY(name, ...) \
  case ParticipantKind::name:   \
    return FrontSlope __VA_ARGS__;
#include "engine/world/fronts.toml.inc"
    default:
      return std::nullopt;
  }
}

const Crush& passenger_car_crush() { return crush_entries::passenger_car; }
const Crush& box_crush() { return crush_entries::box; }

}  // namespace septet
