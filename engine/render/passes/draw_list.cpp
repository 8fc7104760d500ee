#include "engine/render/passes/draw_list.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::render {

InstanceRecord record_of(const PlacedMesh& placed, const glm::vec3& origin_m) {
  const glm::mat3& m = placed.world_from_object;
  return {glm::vec4(m[0].x, m[1].x, m[2].x, origin_m.x), glm::vec4(m[0].y, m[1].y, m[2].y, origin_m.y),
          glm::vec4(m[0].z, m[1].z, m[2].z, origin_m.z), placed.tint,
          glm::vec4(placed.share_of_sky, placed.snowed_on, placed.number, placed.over_road_m)};
}

ViewVolume view_volume(const FrameView& view) {
  const OffAxisView& projection = view.projection;
  const auto inward = [&](const Vec3& axis, double slope, double sign) {
    // A point right·x + up·y − back·z is inside the edge where sign·(axis − slope·z) ≥ 0.
    const Vec3 normal = sign * (axis + slope * projection.back);
    return glm::vec3(glm::normalize(view.world_from_car.orientation * normal));
  };
  return {inward(projection.right, projection.left_slope, 1.0), inward(projection.right, projection.right_slope, -1.0),
          inward(projection.up, projection.bottom_slope, 1.0), inward(projection.up, projection.top_slope, -1.0)};
}

bool intersects(const ViewVolume& volume, const glm::vec3& centre_m, float radius_m) {
  return std::all_of(volume.begin(), volume.end(),
                     [&](const glm::vec3& normal) { return glm::dot(normal, centre_m) >= -radius_m; });
}

float detail_range_m(const PlacedMesh& placed, const glm::vec3& origin_m, const Detail& detail) {
  const float away_m = glm::length(origin_m);
  return std::max({away_m, detail.least_m, (away_m - placed.radius_m) * detail.times});
}

void append_visible(DrawList& list, std::span<const PlacedMesh> placed, const Vec3& eye_m,
                    const std::function<bool(const PlacedMesh&, const glm::vec3&)>& keep, const Detail& detail) {
  Batch batch;
  const auto close = [&] {
    if (batch.count > 0) list.batches.push_back(batch);
  };
  for (const PlacedMesh& mesh : placed) {
    const glm::vec3 origin(mesh.origin_m - eye_m);
    const float range_m = detail_range_m(mesh, origin, detail);
    if (range_m < mesh.visible_from_m || range_m >= mesh.visible_to_m) continue;
    const glm::vec3 centre = origin + mesh.centre_m;
    if (!keep(mesh, centre)) continue;
    if (batch.count == 0 || batch.mesh != mesh.mesh) {
      close();
      batch = {mesh.mesh, static_cast<std::uint32_t>(list.records.size()), 0, 1e30f};
    }
    list.records.push_back(record_of(mesh, origin));
    ++batch.count;
    batch.nearest_m = std::min(batch.nearest_m, glm::length(centre));
  }
  close();
}

void sort_by_distance(DrawList& list) {
  // Within a batch too: trees in front hide those behind before they are shaded.
  const auto square = [](const InstanceRecord& record) {
    return record.row0.w * record.row0.w + record.row1.w * record.row1.w + record.row2.w * record.row2.w;
  };
  for (const Batch& batch : list.batches)
    std::stable_sort(list.records.begin() + batch.first, list.records.begin() + batch.first + batch.count,
                     [&](const InstanceRecord& a, const InstanceRecord& b) { return square(a) < square(b); });
  std::stable_sort(list.batches.begin(), list.batches.end(),
                   [](const Batch& a, const Batch& b) { return a.nearest_m < b.nearest_m; });
}

}  // namespace septet::render
