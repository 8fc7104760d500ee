#include "engine/scene/resolve.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/core/parallel_for.hpp"
#include "engine/scene/bitmap_image.hpp"
#include "engine/scene/material_evaluation.hpp"
#include "engine/scene/part_role.hpp"
#include "engine/scene/surface_mesh.hpp"

namespace septet::scene {
namespace {

constexpr int deepest_child = 32;
/// Limit of objects in one update: children shared again and again multiply.
constexpr std::size_t most_visits = 1u << 20;
constexpr std::string_view prototype_prefix = "model/";

/// Content of an object node, read once per change of it.
struct DrawnObject {
  std::uint64_t revision = 0;
  std::string name;
  Transform transform;
  bool hidden = false;
  NodeId geometry = no_node;
  std::vector<std::pair<std::uint32_t, NodeId>> materials;  ///< Materials by face material index, rising.
  std::vector<NodeId> children;
  float visible_from_m = 0.0f, visible_to_m = 1e9f;
  PartRole role = PartRole::fixed;
  bool casts_shadow = true;
  std::uint32_t mesh = 0;  ///< Slot at its last placement.
};

/// Meshes are shared by objects that have geometry and materials in common.
using MeshKey = std::pair<NodeId, std::vector<std::pair<std::uint32_t, NodeId>>>;

struct MeshSlot {
  MeshKey key;
  std::uint64_t made_from = 0;  ///< The geometry node's revision.
  std::uint64_t last_used = 0;  ///< Last pass of place_instances in which an instance used it.
};

template <class T>
T draw_tag(const Node& node, const char* name, T otherwise) {
  const TagValue* value = find_tag(node, "draw", name);
  const T* typed = value ? std::get_if<T>(value) : nullptr;
  return typed ? *typed : otherwise;
}

DrawnObject read_object(const Node& node) {
  const auto& data = std::get<ObjectData>(node.data);
  DrawnObject object;
  object.revision = node.revision;
  object.name = node.name;
  object.transform = data.transform;
  object.transform.rotation = glm::normalize(data.transform.rotation);
  object.hidden = data.hidden;
  for (const auto& [id, link] : data.links) {
    if (link.label == "geometry" && object.geometry == no_node) object.geometry = link.target;
    if (link.label == "material") object.materials.emplace_back(link.target_id, link.target);
    if (link.label == "child") object.children.push_back(link.target);
  }
  std::stable_sort(object.materials.begin(), object.materials.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  object.visible_from_m = static_cast<float>(draw_tag(node, "from_m", 0.0));
  object.visible_to_m = static_cast<float>(draw_tag(node, "to_m", 1e9));
  object.role = part_role(draw_tag(node, "role", std::string()));
  object.casts_shadow = draw_tag(node, "casts_shadow", true);
  return object;
}

/// Slots of one of ResolvedScene's arrays, by their source.
template <class Key, class Content>
class Slots {
 public:
  /// The slot of `key`, made where it does not exist.
  std::uint32_t of(const Key& key, std::vector<Content>& contents) {
    const auto [found, added] = by_key_.try_emplace(key, 0);
    if (!added) return found->second;
    if (free_.empty()) {
      found->second = static_cast<std::uint32_t>(contents.size());
      contents.emplace_back();
    } else {
      found->second = *free_.begin();
      free_.erase(free_.begin());
    }
    return found->second;
  }
  void release(const Key& key) {
    const auto found = by_key_.find(key);
    free_.insert(found->second);
    by_key_.erase(found);
  }
  const std::map<Key, std::uint32_t>& all() const { return by_key_; }

 private:
  std::map<Key, std::uint32_t> by_key_;
  std::set<std::uint32_t> free_;
};

}  // namespace

struct Resolver::State {
  ResolvedScene scene;
  std::uint64_t seen = 0;        ///< The store's revision at the last update.
  std::uint64_t seen_index = 0;  ///< The store's index revision at that update.
  std::uint64_t placing = 0;     ///< Counts the passes of place_instances.

  std::map<NodeId, DrawnObject> objects;
  Slots<MeshKey, SurfaceMesh> mesh_slots;
  std::vector<MeshSlot> meshes;
  Slots<NodeId, SurfaceMaterial> material_slots;
  Slots<NodeId, TextureImage> image_slots;
  std::map<NodeId, std::uint64_t> image_made_from;
  std::size_t pending = 0;

  State() { scene.materials.emplace_back(); }  // Slot 0: parts without a material are neutral grey.

  std::uint64_t next_revision() { return ++scene.revision; }

  // ---- changes

  struct Changes {
    bool objects = false, materials = false, bitmaps = false, geometries = false;
  };

  Changes read_changes(const Store& store) {
    Changes changes;
    const bool index = store.index_revision() > seen_index;
    if (index) {
      std::erase_if(objects, [&](const auto& entry) { return !store.find(entry.first); });
      changes = {true, true, true, true};
    }
    for (const auto& [id, node] : store.nodes()) {
      if (node.revision <= seen) continue;
      switch (node.type()) {
        case NodeType::object:
          objects[id] = read_object(node);
          changes.objects = true;
          break;
        case NodeType::geometry:
          changes.geometries = true;
          break;
        case NodeType::material:
          changes.materials = true;
          break;
        case NodeType::bitmap:
          changes.bitmaps = true;
          break;
        default:
          break;
      }
    }
    seen = store.revision();
    seen_index = store.index_revision();
    return changes;
  }

  // ---- objects to instances

  std::uint32_t mesh_slot(DrawnObject& object) {
    const auto is_of = [&](const MeshSlot& slot) {
      return slot.last_used != 0 && slot.key.first == object.geometry && slot.key.second == object.materials;
    };
    if (object.mesh >= meshes.size() || !is_of(meshes[object.mesh])) {
      const MeshKey key{object.geometry, object.materials};
      object.mesh = mesh_slots.of(key, scene.meshes);
      if (object.mesh >= meshes.size()) meshes.resize(object.mesh + 1);
      if (!is_of(meshes[object.mesh])) meshes[object.mesh] = {key, 0, placing};
    }
    meshes[object.mesh].last_used = placing;
    return object.mesh;
  }

  struct Placement {
    RigidTransform world_from_object;
    glm::vec3 scale{1.0f};
  };

  static Placement child_of(const Placement& parent, const Transform& t) {
    Placement placed;
    placed.world_from_object.position_m = parent.world_from_object * (glm::dvec3(parent.scale) * t.position_m);
    placed.world_from_object.orientation = parent.world_from_object.orientation * t.rotation;
    placed.scale = parent.scale * t.scale;
    return placed;
  }

  /// Appends an object and everything below it. `path` holds the objects above.
  void place(DrawnObject& object, NodeId id, const Placement& parent, std::vector<NodeId>& path, std::size_t& visits,
             std::vector<Instance>& into) {
    if (object.hidden || path.size() >= deepest_child || ++visits > most_visits) return;
    if (std::find(path.begin(), path.end(), id) != path.end()) return;
    const Placement placed = child_of(parent, object.transform);
    if (object.geometry != no_node)
      into.push_back({mesh_slot(object), placed.world_from_object, placed.scale, object.visible_from_m,
                      object.visible_to_m, object.casts_shadow, object.role});
    path.push_back(id);
    for (const NodeId child : object.children)
      if (const auto found = objects.find(child); found != objects.end())
        place(found->second, child, placed, path, visits, into);
    path.pop_back();
  }

  void place_instances() {
    ++placing;
    std::vector<NodeId> children;
    for (const auto& [id, object] : objects)
      children.insert(children.end(), object.children.begin(), object.children.end());
    std::sort(children.begin(), children.end());
    scene.instances.clear();
    scene.prototypes.clear();
    std::vector<NodeId> path;
    std::size_t visits = 0;
    for (auto& [id, object] : objects) {
      if (std::binary_search(children.begin(), children.end(), id)) continue;
      if (object.name.starts_with(prototype_prefix)) {
        Prototype& prototype = scene.prototypes.emplace_back();
        prototype.name = object.name.substr(prototype_prefix.size());
        place(object, id, {}, path, visits, prototype.parts);
      } else {
        place(object, id, {}, path, visits, scene.instances);
      }
    }
    for (MeshSlot& slot : meshes) {
      if (slot.last_used == 0 || slot.last_used == placing) continue;
      const std::uint32_t index = mesh_slots.all().at(slot.key);
      scene.meshes[index] = {};
      scene.meshes[index].revision = next_revision();
      mesh_slots.release(slot.key);
      slot = {};
    }
    next_revision();
  }

  // ---- meshes

  std::uint32_t material_slot(NodeId id) { return material_slots.of(id, scene.materials); }

  void make_meshes(const Store& store, std::size_t budget) {
    struct Task {
      std::uint32_t index;
      const Node* node;                                                ///< Null: there is no geometry.
      std::vector<std::pair<std::uint32_t, std::uint32_t>> materials;  ///< Slots by face material index.
    };
    pending = 0;
    std::vector<Task> tasks;
    for (std::uint32_t index = 0; index < meshes.size(); ++index) {
      MeshSlot& slot = meshes[index];
      if (slot.last_used == 0) continue;
      const Node* node = store.find(slot.key.first);
      const std::uint64_t revision = node ? node->revision : 0;
      if (slot.made_from == revision) continue;
      if (tasks.size() == budget) {
        ++pending;
        continue;
      }
      slot.made_from = revision;
      Task& task = tasks.emplace_back(Task{index, node, {}});
      for (const auto& [face, material] : slot.key.second) task.materials.emplace_back(face, material_slot(material));
    }
    parallel_for(tasks.size(), [&](std::size_t i) {
      const Task& task = tasks[i];
      const auto material_of = [&](std::uint32_t face_material) -> std::uint32_t {
        for (const auto& [face, material] : task.materials)
          if (face == face_material) return material;
        return task.materials.empty() || task.materials.front().first != 0 ? 0 : task.materials.front().second;
      };
      scene.meshes[task.index] = task.node ? surface_of_geometry(*task.node, material_of) : SurfaceMesh{};
    });
    for (const Task& task : tasks) scene.meshes[task.index].revision = next_revision();
  }

  // ---- materials and images

  void evaluate_materials(const Store& store) {
    const auto image_of = [&](NodeId bitmap) {
      return static_cast<std::int32_t>(image_slots.of(bitmap, scene.images));
    };
    for (const auto& [id, slot] : material_slots.all()) {
      SurfaceMaterial& current = scene.materials[slot];
      const Node* node = store.find(id);
      SurfaceMaterial made = node ? evaluate_material(*node, image_of) : SurfaceMaterial{};
      made.revision = current.revision;
      if (current.revision != 0 && same(made, current)) continue;
      made.revision = next_revision();
      current = made;
    }
  }

  static bool same(const SurfaceMaterial& a, const SurfaceMaterial& b) {
    return a.base_color == b.base_color && a.base_color_image == b.base_color_image && a.roughness == b.roughness &&
           a.metallic == b.metallic && a.opacity == b.opacity && a.refraction_index == b.refraction_index &&
           a.emission == b.emission && a.takes_paint == b.takes_paint && a.wettable == b.wettable &&
           a.stripe == b.stripe && a.retroreflection == b.retroreflection && a.picture_columns == b.picture_columns &&
           a.picture_rows == b.picture_rows && a.share_of_sky == b.share_of_sky && a.clear_coat == b.clear_coat &&
           a.two_sided == b.two_sided && a.ambient_share == b.ambient_share && a.lit_by_night == b.lit_by_night &&
           a.in_street == b.in_street;
  }

  void make_images(const Store& store) {
    std::vector<std::pair<std::uint32_t, const Node*>> tasks;
    for (const auto& [id, slot] : image_slots.all()) {
      const Node* node = store.find(id);
      const std::uint64_t revision = node ? node->revision : 0;
      const auto [made, added] = image_made_from.try_emplace(id, 0);
      if (!added && made->second == revision) continue;
      made->second = revision;
      tasks.emplace_back(slot, node);
    }
    parallel_for(tasks.size(), [&](std::size_t i) {
      const auto [slot, node] = tasks[i];
      scene.images[slot] = node ? image_of_bitmap(*node) : TextureImage{};
    });
    for (const auto& task : tasks) scene.images[task.first].revision = next_revision();
  }

  bool update(const Store& store, std::size_t mesh_budget) {
    if (store.revision() == seen && pending == 0) return false;
    const std::uint64_t before = scene.revision;
    const std::size_t materials_before = material_slots.all().size();
    const Changes changes = read_changes(store);
    if (changes.objects) place_instances();
    if (changes.objects || changes.geometries || pending > 0) make_meshes(store, mesh_budget);
    const bool new_materials = material_slots.all().size() != materials_before;
    const std::size_t images_before = image_slots.all().size();
    if (changes.materials || new_materials) evaluate_materials(store);
    if (changes.bitmaps || image_slots.all().size() != images_before) make_images(store);
    return scene.revision != before;
  }
};

Resolver::Resolver() : state_(std::make_unique<State>()) {}
Resolver::~Resolver() = default;
Resolver::Resolver(Resolver&&) noexcept = default;
Resolver& Resolver::operator=(Resolver&&) noexcept = default;

bool Resolver::update(const Store& store, std::size_t mesh_budget) { return state_->update(store, mesh_budget); }

void Resolver::forget() {
  // Existing content stays in its slot until the next update frees or makes it again.
  state_->seen = state_->seen_index = 0;
  state_->objects.clear();
  state_->image_made_from.clear();
  for (MeshSlot& slot : state_->meshes) slot.made_from = ~std::uint64_t{0};
}

const ResolvedScene& Resolver::scene() const { return state_->scene; }
std::size_t Resolver::pending() const { return state_->pending; }

ResolvedScene resolve(const Store& store) {
  Resolver resolver;
  resolver.update(store);
  return resolver.scene();
}

}  // namespace septet::scene
