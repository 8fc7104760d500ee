#include "command-line/command/edit/exported_model.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "engine/gltf/write_glb.hpp"
#include "engine/math/pose_keys.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/scene/part_role.hpp"
#include "engine/scene/resolve.hpp"

namespace septet::server {
namespace {

/// The object and every node that it is drawn by, at the origin.
scene::Store store_of(const scene::Store& store, scene::NodeId object) {
  scene::Store part;
  std::set<scene::NodeId> known{object};
  std::vector<scene::NodeId> next{object};
  const auto reach = [&](scene::NodeId id) {
    if (known.insert(id).second) next.push_back(id);
  };
  while (!next.empty()) {
    const scene::Node* node = store.find(next.back());
    next.pop_back();
    if (!node) continue;
    scene::describe_node(*node, [&](const scene::Command& command) { (void)part.apply(command); });
    if (const auto* of_object = std::get_if<scene::ObjectData>(&node->data))
      for (const auto& [link_id, link] : of_object->links) reach(link.target);
    if (const auto* of_material = std::get_if<scene::MaterialData>(&node->data))
      for (const auto& [fragment_id, fragment] : of_material->fragments)
        if (const auto* texture = std::get_if<scene::TextureFragment>(&fragment)) reach(texture->bitmap);
    for (const char* map : scene::surface_map_tags)
      if (const scene::TagValue* value = scene::find_tag(*node, "surface", map))
        if (const auto* bitmap = std::get_if<scene::NodeReference>(value)) reach(bitmap->node);
  }
  (void)part.apply(scene::TransformSet{object, {}});
  (void)part.apply(scene::HideSet{object, false});
  return part;
}

/// What of a resolved scene is drawn, each mesh, material and image once.
class DrawingOf {
 public:
  explicit DrawingOf(const scene::ResolvedScene& scene) : scene_(scene) {}

  void add(const scene::Instance& instance, const std::string& name) {
    if (instance.mesh >= scene_.meshes.size() || instance.visible_from_m > 0.0f) return;
    if (!instance.keyed && instance.scale == glm::vec3(0.0f)) return;
    // A wheel or a lamp is called as the reader of models knows it.
    const bool is_part = instance.role != scene::PartRole::fixed;
    gltf::DrawnNode node{is_part ? std::string(scene::name_of(instance.role)) : name, mesh(instance.mesh),
                         instance.world_from_object, instance.scale};
    if (const scene::KeyedPart* keyed = instance.keyed.get()) {
      node.model_from_node = keyed->below.pose;
      node.scale = keyed->below.scale;
      for (const PoseKey& key : keyed->keys) {
        const auto at = scene::child_of(keyed->above, {Vec3(key.position_m), Quat(key.rotation)}, key.scale);
        node.keys.push_back({key.at_s, glm::vec3(at.pose.position_m), glm::quat(at.pose.orientation), at.scale});
      }
    }
    drawing_.nodes.push_back(std::move(node));
  }
  void add_extras(const scene::Node& object) {
    for (const auto& [group_id, group] : object.tag_groups) {
      if (group.name != "extras") continue;
      for (const auto& [tag_id, tag] : group.tags) {
        gltf::Extra extra{tag.name, {}};
        if (const auto* truth = std::get_if<bool>(&tag.value)) extra.value = *truth;
        if (const auto* number = std::get_if<double>(&tag.value)) extra.value = *number;
        if (const auto* count = std::get_if<std::uint32_t>(&tag.value)) extra.value = static_cast<double>(*count);
        if (const auto* text = std::get_if<std::string>(&tag.value)) extra.value = *text;
        if (const auto* list = std::get_if<Vec3>(&tag.value)) extra.value = *list;
        const bool has_no_form =
            std::holds_alternative<scene::NodeReference>(tag.value) || std::holds_alternative<scene::Blob>(tag.value);
        if (!has_no_form) drawing_.extras.push_back(std::move(extra));
      }
    }
  }
  gltf::Drawing take() { return std::move(drawing_); }

 private:
  std::uint32_t mesh(std::uint32_t index) {
    const auto [known, is_new] = meshes_.try_emplace(index, static_cast<std::uint32_t>(drawing_.meshes.size()));
    if (!is_new) return known->second;
    const scene::SurfaceMesh& mesh = scene_.meshes[index];
    gltf::DrawnMesh drawn{{}, mesh.indices, {}};
    drawn.vertices.reserve(mesh.vertices.size());
    for (const scene::SurfaceVertex& v : mesh.vertices)
      drawn.vertices.push_back({v.position_m, v.normal, v.uv, v.color, v.tangent, v.second_uv});
    for (const scene::MeshPart& part : mesh.parts)
      drawn.runs.push_back({part.first_index, part.index_count, look(part.material)});
    drawing_.meshes.push_back(std::move(drawn));
    return known->second;
  }
  std::uint32_t look(std::uint32_t index) {
    const auto [known, is_new] = looks_.try_emplace(index, static_cast<std::uint32_t>(drawing_.looks.size()));
    if (!is_new) return known->second;
    gltf::Look look;
    look.name = fmt::format("material {}", known->second);
    if (index < scene_.materials.size()) {
      const scene::SurfaceMaterial& material = scene_.materials[index];
      look.base_color = material.base_color;
      look.picture = picture(material.base_color_image);
      using scene::SurfaceMap;
      look.emission_picture = picture(material.maps[SurfaceMap::emission]);
      look.properties_picture = picture(material.maps[SurfaceMap::properties]);
      look.normal_picture = picture(material.maps[SurfaceMap::normal]);
      look.by_second_uv = material.by_second_uv;
      if (material.takes_paint) look.name = "paint";
      look.roughness = material.roughness;
      look.metallic = material.metallic;
      look.opacity = material.opacity;
      look.emission = material.emission;
      look.two_sided = material.two_sided;
    }
    drawing_.looks.push_back(std::move(look));
    return known->second;
  }
  std::int32_t picture(std::int32_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= scene_.images.size()) return -1;
    const auto [known, is_new] = pictures_.try_emplace(index, static_cast<std::int32_t>(drawing_.pictures.size()));
    if (is_new) {
      const scene::TextureImage& image = scene_.images[static_cast<std::size_t>(index)];
      gltf::Picture picture;
      picture.width = image.width;
      picture.height = image.height;
      picture.rgba = image.rgba;
      picture.ends_u = image.sampling.clamps_u;
      picture.ends_v = image.sampling.clamps_v;
      picture.is_sharp = image.sampling.sharp;
      drawing_.pictures.push_back(std::move(picture));
    }
    return known->second;
  }

  const scene::ResolvedScene& scene_;
  gltf::Drawing drawing_;
  std::map<std::uint32_t, std::uint32_t> meshes_, looks_;
  std::map<std::int32_t, std::int32_t> pictures_;
};

}  // namespace

Expected<Bytes> exported_model(const scene::Store& store, scene::NodeId object, const std::string& name) {
  const scene::ResolvedScene scene = scene::resolve(store_of(store, object));
  DrawingOf drawing(scene);
  for (const scene::Instance& instance : scene.instances) drawing.add(instance, name);
  for (const scene::Prototype& prototype : scene.prototypes)
    for (const scene::Instance& part : prototype.parts) drawing.add(part, name);
  if (const scene::Node* node = store.find(object)) drawing.add_extras(*node);
  return gltf::write_glb(drawing.take(), name);
}

}  // namespace septet::server
