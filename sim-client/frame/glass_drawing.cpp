#include "sim-client/frame/glass_drawing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/effects/ice/glass_keyframe.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/world/vehicle_model.hpp"
#include "engine/world/windscreen.hpp"

namespace septet::frame {
namespace {

ice::PaneShape windscreen_from_within() {
  constexpr double bulge_m = 0.04;
  const auto mirrored = [](const Vec3& place) { return Vec3(place.x, -place.y, place.z); };
  return ice::pane_between(mirrored(windscreen::foot_left_m), windscreen::foot_left_m,
                           mirrored(windscreen::head_left_m), windscreen::head_left_m, bulge_m);
}

bool is_glass(const scene::SurfaceMaterial& material) {
  const glm::vec3& color = material.base_color;
  return std::max({color.r, color.g, color.b}) < 0.03f && material.roughness < 0.1f && material.metallic == 0.0f &&
         material.emission == glm::vec3(0.0f) && !material.takes_paint;
}

ice::IceBody body_of(const std::vector<ice::IceVertex>& surface, const Vec3& middle_m,
                     const RigidTransform& world_from_vehicle, ice::OnGlass what) {
  ice::IceBody body;
  body.look.on_glass = what;
  body.origin_m = world_from_vehicle * middle_m;
  body.vertices = surface;
  const glm::dmat3 turn = glm::mat3_cast(world_from_vehicle.orientation);
  for (ice::IceVertex& vertex : body.vertices) {
    vertex.position_m = glm::vec3(turn * (Vec3(vertex.position_m) - middle_m));
    vertex.normal = glm::vec3(turn * Vec3(vertex.normal));
  }
  return body;
}

bool same_frost(const ice::Frost& a, const ice::Frost& b) {
  return a.thickness_kgpm2 == b.thickness_kgpm2 && a.seed == b.seed && a.melted_kgpm2 == b.melted_kgpm2;
}

}  // namespace

ice::PaneShape windscreen_of(const scene::ResolvedScene& scene, const scene::Prototype& prototype) {
  constexpr float least_forward = 0.3f, least_height_m = 0.7f;
  std::vector<Vec3> triangles;
  for (const scene::Instance& placed : prototype.parts) {
    if (placed.role != scene::PartRole::fixed || placed.visible_from_m > 0.0f || placed.mesh >= scene.meshes.size())
      continue;
    const scene::SurfaceMesh& mesh = scene.meshes[placed.mesh];
    for (const scene::MeshPart& part : mesh.parts) {
      if (part.material >= scene.materials.size() || !is_glass(scene.materials[part.material])) continue;
      for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
        std::array<Vec3, 3> corners;
        for (std::uint32_t k = 0; k < 3; ++k)
          corners[k] = placed.world_from_object *
                       Vec3(mesh.vertices[mesh.indices[part.first_index + i + k]].position_m * placed.scale);
        const Vec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(area.x > least_forward * glm::length(area)) || corners[0].z < least_height_m) continue;
        triangles.insert(triangles.end(), corners.begin(), corners.end());
      }
    }
  }
  return ice::pane_on(triangles);
}

void GlassDrawing::make(Made& made, const Participant& vehicle, const scene::ResolvedScene& scene) const {
  const std::string outside(vehicle_models()[vehicle.model].name), inside = "interior/" + outside;
  const bool has_cockpit = scenery::has_cockpit(vehicle_models()[vehicle.model]);
  for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
    const bool within = has_cockpit && scene.prototypes[i].name == inside;
    if (!within && scene.prototypes[i].name != outside) continue;
    Surfaces& surfaces = made.by_prototype[static_cast<std::uint32_t>(i)];
    if (surfaces.shape.empty())
      surfaces.shape = within ? windscreen_from_within() : windscreen_of(scene, scene.prototypes[i]);
    surfaces.frost = ice::frost_surface(surfaces.shape, made.pane.frost);
    surfaces.cracks.clear();
    for (const ice::Star& star : made.pane.stars) {
      const auto cracks = ice::star_surface(surfaces.shape, star);
      surfaces.cracks.insert(surfaces.cracks.end(), cracks.begin(), cracks.end());
    }
  }
}

void GlassDrawing::show(const Snapshot& instant, const scene::ResolvedScene& scene) {
  const auto effect = std::ranges::lower_bound(instant.effects, ice::glass_effect_id, {}, &EffectKeyframe::id);
  const bool there =
      effect != instant.effects.end() && effect->id == ice::glass_effect_id && effect->kind == ice::glass_keyframe_kind;
  if (!there) {
    panes_.clear();
    data_.clear();
  } else if (effect->data != data_) {
    data_ = effect->data;
    panes_ = ice::decode_glass(data_).value_or(std::vector<ice::Pane>());
  }
  const std::uint64_t shapes = scene::shape_revision(scene);
  if (shapes != scene_revision_) made_.clear();
  scene_revision_ = shapes;
  for (auto& [vehicle, made] : made_) made.shown = false;
  for (const ice::Pane& pane : panes_) {
    const Participant* vehicle = find_participant(instant, pane.vehicle);
    if (!vehicle) continue;
    const auto [at, fresh] = made_.try_emplace(pane.vehicle);
    Made& made = at->second;
    made.shown = true;
    made.world_from_vehicle = vehicle->world_from_vehicle;
    if (!fresh && same_frost(made.pane.frost, pane.frost) && made.pane.stars.size() == pane.stars.size()) continue;
    made.pane = pane;
    make(made, *vehicle, scene);
  }
  std::erase_if(made_, [](const auto& entry) { return !entry.second.shown; });
}

void GlassDrawing::add_to(instant::FrameInput& frame) const {
  constexpr double reach_m = 60.0;  // The cracks of a star are much less than a pixel there.
  for (const auto& [id, made] : made_) {
    const Vec3& place = made.world_from_vehicle.position_m;
    if (std::ranges::none_of(frame.views, [&](const instant::FrameView& view) {
          return glm::length(place - instant::world_eye(view)) < reach_m;
        }))
      continue;
    for (const instant::DrawnParticipant& drawn : frame.participants) {
      const auto surfaces = made.by_prototype.find(drawn.prototype);
      if (surfaces == made.by_prototype.end() || drawn.shown != instant::Shown::whole ||
          drawn.world_from_vehicle.position_m != place)
        continue;
      const auto& [shape, frost, cracks] = surfaces->second;
      const Vec3 middle_m = ice::place_on(shape, 0.5, 0.5);
      if (!frost.empty()) frame.glass.push_back(body_of(frost, middle_m, made.world_from_vehicle, ice::OnGlass::frost));
      if (!cracks.empty())
        frame.glass.push_back(body_of(cracks, middle_m, made.world_from_vehicle, ice::OnGlass::cracks));
    }
  }
}

}  // namespace septet::frame
