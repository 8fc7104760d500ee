#pragma once
/// Where the drawn body of a passenger car has the parts that a crash can tear off: by its seams and lamps.

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/effects/debris/mounted_part.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

/// Vehicle frame.
struct RegionBox {
  glm::vec3 low_m{0.0f}, high_m{0.0f};

  bool holds(const glm::vec3& place_m) const;
};

struct MountRegion {
  std::optional<RegionBox> skin;   ///< Its sheet; empty for glass alone.
  std::vector<RegionBox> carried;  ///< What stands off the skin and goes with it: a door's mirror.
  std::optional<RegionBox> panes;  ///< Clear panes whose middle lies there go as well.
  glm::vec3 outward{1.0f, 0.0f, 0.0f};
  float recess_m = 0.1f;  ///< Depth of what is then seen behind the skin.
};

/// Empty for a vehicle without a car's lines, and for doors that it does not have.
std::optional<MountRegion> mount_region(const VehicleModel& model, debris::Mount mount);

}  // namespace septet::scenery
