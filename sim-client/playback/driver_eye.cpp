#include "sim-client/playback/driver_eye.hpp"

#include <utility>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::playback {

std::optional<rig::Rig> rig_of(const logging::SessionInfo& info) {
  for (const auto& source : info.files)
    if (source.role == "rig")
      if (auto rig = rig::read_rig(source.content, source.name)) return std::move(*rig);
  return std::nullopt;
}

Vec3 driver_eye_m(const logging::SessionInfo& info) {
  const auto rig = rig_of(info);
  return rig ? rig->eye_point_m : scenery::eye_in(vehicle_models().front());
}

}  // namespace septet::playback
