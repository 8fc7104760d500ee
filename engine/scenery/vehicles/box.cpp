#include <utility>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

/// A slice of a cube of a metre, from one share of its height to another, set in by a share of its width.
void add_slice(geometry::MeshBuilder& b, Finish finish, float from, float to, float inset) {
  b.material = index_of(finish);
  const float half = 0.5f - inset;
  b.append(geometry::box({-half, -half, from}, {half, half, to}), glm::mat4(1.0f), true);
}

}  // namespace

VehicleParts box_parts() {
  constexpr float skid = 0.06f, lid = 0.94f, inset = 0.012f;
  VehicleParts parts;
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    geometry::MeshBuilder b;
    if (level == DetailLevel::far) {
      add_slice(b, Finish::cloth, 0.0f, 1.0f, 0.0f);
    } else {
      add_slice(b, Finish::cloth, level == DetailLevel::near ? skid : 0.0f, lid, inset);
      add_slice(b, Finish::cloth, lid, 1.0f, 0.0f);
      if (level == DetailLevel::near) add_slice(b, Finish::trim, 0.0f, skid, 0.0f);
    }
    add_level(parts, {{"box", b.take(), 0, {Placement{}}}}, level);
  }
  return parts;
}

}  // namespace septet::scenery
