#include "sim-client/frame/dent_drawing.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/vehicle_model.hpp"
#include "sim-client/frame/dented_mesh.hpp"
#include "sim-client/frame/torn_vehicle.hpp"

namespace septet::frame {
namespace {

std::shared_ptr<const instant::ReshapedParts> reshaped(const scene::ResolvedScene& scene,
                                                       const scene::Prototype& prototype, const VehicleModel& model,
                                                       const debris::DentedVehicle& told) {
  auto parts = std::make_shared<instant::ReshapedParts>(without_torn(scene, prototype, model, told.torn));
  for (std::size_t i = 0; i < prototype.parts.size(); ++i) {
    const scene::Instance& part = prototype.parts[i];
    if (!is_sheet_metal(part.role) || part.mesh >= scene.meshes.size()) continue;
    const scene::SurfaceMesh& mesh = (*parts)[i] ? *(*parts)[i] : scene.meshes[part.mesh];
    if (auto bent = dented_mesh(mesh, part.world_from_object, part.scale, told.dents))
      (*parts)[i] = std::make_shared<const scene::SurfaceMesh>(std::move(*bent));
  }
  return parts;
}

}  // namespace

void DentDrawing::show(const Snapshot& instant, const scene::ResolvedScene& scene) {
  const auto effect = std::ranges::lower_bound(instant.effects, debris::dent_effect_id, {}, &EffectKeyframe::id);
  const bool there = effect != instant.effects.end() && effect->id == debris::dent_effect_id &&
                     effect->kind == debris::dent_keyframe_kind;
  const bool same_scene = std::exchange(scene_revision_, scene::shape_revision(scene)) == scene::shape_revision(scene);
  if (!there) {
    made_.clear();
    data_.clear();
    return;
  }
  if (same_scene && effect->data == data_) return;
  if (!same_scene) made_.clear();
  data_ = effect->data;
  const auto vehicles = debris::decode_dents(data_);
  std::map<ParticipantId, Made> made;
  for (const debris::DentedVehicle& told : vehicles.value_or(std::vector<debris::DentedVehicle>())) {
    const Participant* vehicle = find_participant(instant, told.vehicle);
    if (!vehicle || vehicle->model >= vehicle_models().size()) {
      data_.clear();  // The vehicle may come later: the keyframe is read again then.
      continue;
    }
    Bytes bytes = debris::encode_dents(std::span(&told, 1));
    if (const auto known = made_.find(told.vehicle); known != made_.end() && known->second.told == bytes) {
      made.insert(made_.extract(known));
      continue;
    }
    Made& fresh = made[told.vehicle];
    fresh.told = std::move(bytes);
    const VehicleModel& model = vehicle_models()[vehicle->model];
    const std::string outside(model.name), inside = "interior/" + outside, shell = "shell/" + outside;
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
      if (const std::string& name = scene.prototypes[i].name; name == outside || name == inside || name == shell)
        fresh.by_prototype[static_cast<std::uint32_t>(i)] = reshaped(scene, scene.prototypes[i], model, told);
  }
  made_ = std::move(made);
}

void DentDrawing::add_to(instant::FrameInput& frame) const {
  if (made_.empty()) return;
  for (instant::DrawnParticipant& drawn : frame.participants) {
    const auto made = made_.find(drawn.number);
    if (made == made_.end()) continue;
    const auto parts = made->second.by_prototype.find(drawn.prototype);
    if (parts != made->second.by_prototype.end()) drawn.reshaped = parts->second;
  }
}

}  // namespace septet::frame
