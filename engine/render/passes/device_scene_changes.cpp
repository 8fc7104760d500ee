/// Changes of a device copy of a scene.

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/render/passes/device_scene.hpp"

namespace septet::render {
namespace {

using Changes = std::span<const scene::ChangeList<scene::SceneChange>::Change>;
using Kind = scene::SceneChange::Kind;

/// Vacated placements from which on all are ordered anew, if they are the greater part.
constexpr std::size_t many_vacated = 4096;

class Renewal {
 public:
  Renewal(DeviceScene& scene, const scene::ResolvedScene& source, vulkan::Upload& upload,
          const std::function<void()>& wait)
      : scene_(scene), source_(source), upload_(upload), wait_(wait) {
    scene_.meshes.resize(source.meshes.size());
    scene_.edited.resize(source.meshes.size());
    scene_.placed_at.resize(source.instances.size(), nowhere);
  }

  void renew_materials(Changes changes) {
    bool whole = scene_.textures.size() != source_.images.size() || scene_.materials.size() != source_.materials.size();
    for (const auto& [revision, change] : changes) {
      if (change.kind == Kind::material) whole = whole || is_read_otherwise(change.index);
      if (change.kind != Kind::image || change.index >= scene_.textures.size()) continue;
      before_device();
      const bool in_part =
          change.pixels.width > 0 &&
          renew_texture(scene_.textures[change.index], source_.images[change.index], change.pixels, upload_);
      whole = whole || !in_part;
    }
    if (whole) {
      before_device();
      upload_textures(scene_.textures, source_, upload_);
      scene_.materials.resize(source_.materials.size());
      for (std::uint32_t i = 0; i < source_.materials.size(); ++i) renew_material(i);
      return;
    }
    for (const auto& [revision, change] : changes)
      if (change.kind == Kind::material && change.index < source_.materials.size()) renew_material(change.index);
  }

  void renew_places(Changes changes) {
    std::vector<bool> reshaped;
    for (const auto& [revision, change] : changes) {
      if (change.kind == Kind::mesh && change.index < source_.meshes.size()) {
        const bool was_drawn = scene_.meshes[change.index].present || scene_.is_still(change.index);
        leave_still(change.index);
        used_.insert(change.index);
        if (!was_drawn) continue;
        reshaped.resize(source_.meshes.size());
        reshaped[change.index] = true;
      } else if (change.kind == Kind::instance && change.index < source_.instances.size()) {
        leave_still(change.mesh_before);
        put(change.index);
      } else if (change.kind == Kind::prototype && change.index < source_.prototypes.size()) {
        for (const scene::Instance& part : source_.prototypes[change.index].parts) {
          leave_still(part.mesh);
          used_.insert(part.mesh);
        }
      }
    }
    if (!reshaped.empty())  // Bounding spheres are new.
      for (std::uint32_t i = 0; i < source_.instances.size(); ++i)
        if (const std::uint32_t mesh = source_.instances[i].mesh; mesh < reshaped.size() && reshaped[mesh]) put(i);
    if (scene_.vacated > many_vacated && scene_.vacated > scene_.placed.size() / 2) place_instances(scene_, source_);
  }

  void upload_meshes() {
    for (const std::uint32_t index : used_) {
      if (index >= source_.meshes.size() || scene_.is_still(index)) continue;
      DeviceMesh& mesh = scene_.meshes[index];
      if (mesh.present && mesh.revision == source_.meshes[index].revision) continue;
      before_device();
      upload_mesh(mesh, source_.meshes[index], scene_.materials, upload_);
    }
  }

 private:
  void before_device() {
    if (!has_waited_) wait_();
    has_waited_ = true;
  }
  /// True where the levels of the base colour's image are not for the material's kind of alpha.
  bool is_read_otherwise(std::uint32_t index) const {
    if (index >= source_.materials.size()) return false;
    const scene::SurfaceMaterial& material = source_.materials[index];
    const auto image = static_cast<std::size_t>(material.base_color_image);
    return material.base_color_image >= 0 && image < scene_.textures.size() && scene_.textures[image].holes &&
           scene_.textures[image].alpha != (is_blended(material) ? Alpha::blends : Alpha::cuts);
  }
  void renew_material(std::uint32_t index) {
    scene_.materials[index] = device_material(source_.materials[index], scene_.textures);
  }

  /// The mesh's piece is seen no more; its instance is placed.
  void leave_still(std::uint32_t mesh) {
    if (!scene_.is_still(mesh)) return;
    const std::uint32_t instance = std::exchange(scene_.still_instance[mesh], nowhere);
    scene_.edited[mesh] = true;
    if (const std::uint32_t piece = scene_.still_piece[mesh]; piece != nowhere)
      scene_.still.pieces[piece].placed.visible_from_m = scene_.still.pieces[piece].placed.visible_to_m = 0.0f;
    if (instance < source_.instances.size() && source_.instances[instance].mesh == mesh) put(instance);
  }

  void vacate(std::uint32_t at) {
    if (at == nowhere || scene_.placed[at].visible_to_m == 0.0f) return;
    scene_.placed[at].visible_from_m = scene_.placed[at].visible_to_m = 0.0f;
    ++scene_.vacated;
  }

  void put(std::uint32_t index) {
    const scene::Instance& instance = source_.instances[index];
    std::uint32_t& at = scene_.placed_at[index];
    if (instance.mesh >= source_.meshes.size()) return vacate(at);
    leave_still(instance.mesh);
    used_.insert(instance.mesh);
    const PlacedMesh placed = place(instance, scene_.summary.meshes[instance.mesh].bounds, instance.world_from_object);
    if (at != nowhere && scene_.placed[at].mesh == instance.mesh) {
      if (scene_.placed[at].visible_to_m == 0.0f && scene_.vacated > 0) --scene_.vacated;
      scene_.placed[at] = placed;
      return;
    }
    vacate(at);
    at = static_cast<std::uint32_t>(scene_.placed.size());
    scene_.placed.push_back(placed);
  }

  DeviceScene& scene_;
  const scene::ResolvedScene& source_;
  vulkan::Upload& upload_;
  const std::function<void()>& wait_;
  bool has_waited_ = false;
  std::set<std::uint32_t> used_;  ///< Meshes that have to be on the device.
};

}  // namespace

void renew_scene(DeviceScene& scene, const scene::ResolvedScene& source, Changes changes, const vulkan::Device& device,
                 vulkan::MemoryPool& memory, const std::function<void()>& wait) {
  vulkan::Upload upload(device, memory);
  if (renew(scene.summary, source, changes)) scene.lamps_revision = source.revision;
  Renewal renewal(scene, source, upload, wait);
  renewal.renew_materials(changes);
  renewal.renew_places(changes);
  renewal.upload_meshes();
  upload.finish();
  scene.revision = source.revision;
}

}  // namespace septet::render
