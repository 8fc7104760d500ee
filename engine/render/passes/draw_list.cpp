#include "engine/render/passes/draw_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::render {

InstanceRecord record_of(const PlacedMesh& placed, const glm::vec3& origin_m, const instant::LevelFade& fade) {
  const glm::mat3& m = placed.world_from_object;
  return {glm::vec4(m[0].x, m[1].x, m[2].x, origin_m.x),
          glm::vec4(m[0].y, m[1].y, m[2].y, origin_m.y),
          glm::vec4(m[0].z, m[1].z, m[2].z, origin_m.z),
          placed.tint,
          glm::vec4(placed.share_of_sky, placed.snowed_on, placed.number, placed.over_road_m),
          glm::vec2(fade.from, fade.to)};
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
                    const std::function<bool(const PlacedMesh&, const glm::vec3&)>& keep, const Detail& detail,
                    bool still) {
  struct Run {
    std::vector<InstanceRecord> records;
    float nearest_m = 1e30f;
  };
  std::array<Run, 2> runs;  // Records of one mesh: those shown whole, and those that fade.
  std::uint32_t run_mesh = 0;
  const scene::SurfaceMesh* run_reshaped = nullptr;
  const auto close = [&] {
    for (std::size_t fading = 0; fading < runs.size(); ++fading) {
      Run& run = runs[fading];
      if (run.records.empty()) continue;
      list.batches.push_back({run_mesh, static_cast<std::uint32_t>(list.records.size()),
                              static_cast<std::uint32_t>(run.records.size()), run.nearest_m, fading != 0, still,
                              run_reshaped});
      list.records.insert(list.records.end(), run.records.begin(), run.records.end());
      run.records.clear();
      run.nearest_m = 1e30f;
    }
  };
  for (const PlacedMesh& mesh : placed) {
    const glm::vec3 origin(mesh.origin_m - eye_m);
    const instant::LevelFade fade =
        instant::fade_at(detail_range_m(mesh, origin, detail), mesh.visible_from_m, mesh.visible_to_m);
    if (fade.none()) continue;
    const glm::vec3 centre = origin + mesh.centre_m;
    if (!keep(mesh, centre)) continue;
    if (run_mesh != mesh.mesh || run_reshaped != mesh.reshaped) close();
    run_mesh = mesh.mesh;
    run_reshaped = mesh.reshaped;
    Run& run = runs[fade.all() ? 0 : 1];
    run.records.push_back(record_of(mesh, origin, fade));
    run.nearest_m = std::min(run.nearest_m, glm::length(centre));
  }
  close();
}

void sort_by_distance(DrawList& list) {
  // Sorting within a batch, too: trees in front hide those behind before they are shaded.
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
