#include <algorithm>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/finish.hpp"

namespace septet::scenery {

geometry::PolygonMesh van_load(const CarSurface& car) {
  const bool box = car.model.name == "box-van", dropside = car.model.name == "dropside-van";
  if (!box && !dropside) return {};
  geometry::MeshBuilder builder;
  const auto rear = static_cast<float>(-car.model.rear_overhang_m);
  const float half = car.half_width_m(), front = rear + car.shape.backlight_m - 0.04f;
  const auto add = [&](Finish finish, const glm::vec3& low, const glm::vec3& high, float bevel = 0.0f) {
    builder.material = index_of(finish);
    builder.append(geometry::box(low, high, bevel), glm::mat4(1.0f), true);
  };
  const bool near = car.level == DetailLevel::near;
  if (box) {
    add(Finish::tarpaulin, {rear, -half, 0.9f}, {front - 0.04f, half, static_cast<float>(car.model.height_m)},
        near ? 0.03f : 0.0f);
    return builder.take();
  }
  const float low = car.shape.deck_m - 0.02f, top = low + 0.42f, wall = 0.04f;
  for (const float side : {1.0f, -1.0f})
    add(Finish::rim, {rear, std::min(side * half, side * (half - wall)), low},
        {front, std::max(side * half, side * (half - wall)), top});
  add(Finish::rim, {rear, -half + wall, low}, {rear + wall, half - wall, top});
  add(Finish::trim, {front - 0.08f, -half + wall, low}, {front, half - wall, top + 0.75f});
  if (car.level != DetailLevel::far) {  // Goods on the bed.
    add(Finish::timber, {rear + 0.4f, -0.7f, low}, {rear + 1.9f, 0.1f, low + 0.62f});
    add(Finish::tarpaulin, {rear + 2.05f, -0.75f, low}, {front - 0.3f, 0.75f, low + 0.5f}, near ? 0.1f : 0.0f);
  }
  return builder.take();
}

}  // namespace septet::scenery
