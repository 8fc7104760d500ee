#include "engine/scene/resolve.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/parallel_for.hpp"
#include "engine/scene/baked_materials.hpp"
#include "engine/scene/bitmap_image.hpp"
#include "engine/scene/material_evaluation.hpp"
#include "engine/scene/placed_objects.hpp"
#include "engine/scene/slots.hpp"
#include "engine/scene/surface_mesh.hpp"

namespace septet::scene {
namespace {

/// More changes than these at once are read as a whole.
constexpr std::size_t most_separate_changes = 2000;

bool same(const SurfaceMaterial& a, const SurfaceMaterial& b) {
  return a.base_color == b.base_color && a.base_color_image == b.base_color_image && a.maps == b.maps &&
         a.by_second_uv == b.by_second_uv && a.roughness == b.roughness && a.metallic == b.metallic &&
         a.opacity == b.opacity && a.refraction_index == b.refraction_index && a.emission == b.emission &&
         a.takes_paint == b.takes_paint && a.wettable == b.wettable && a.stripe == b.stripe &&
         a.retroreflection == b.retroreflection && a.picture_columns == b.picture_columns &&
         a.picture_rows == b.picture_rows && a.share_of_sky == b.share_of_sky && a.clear_coat == b.clear_coat &&
         a.two_sided == b.two_sided && a.ambient_share == b.ambient_share && a.lit_by_night == b.lit_by_night &&
         a.in_street == b.in_street;
}

}  // namespace

struct Resolver::State {
  ResolvedScene scene;
  std::uint64_t seen = 0;  ///< The store's revision at the last update.
  bool is_whole = true;    ///< True if the next update reads everything.

  PlacedObjects placed;
  Slots<NodeId, SurfaceMaterial> material_slots;
  Slots<NodeId, TextureImage> image_slots;
  std::set<NodeId> changed_materials, changed_images;  ///< Of those with a slot: to be made.
  std::map<NodeId, std::uint64_t> image_made_from;
  BakedMaterials baked;

  State() { scene.materials.emplace_back(); }  // Slot 0: parts without a material are neutral grey.

  std::uint64_t next_revision() { return ++scene.revision; }
  void tell(const SceneChange& change) { scene.changes.add(next_revision(), change); }

  // ---- meshes

  std::uint32_t material_slot(NodeId id) {
    if (!material_slots.all().contains(id)) changed_materials.insert(id);
    return material_slots.of(id, scene.materials);
  }

  bool is_of_prototype(std::uint32_t mesh) const {
    return std::ranges::any_of(scene.prototypes, [&](const Prototype& prototype) {
      return std::ranges::any_of(prototype.parts, [&](const Instance& part) { return part.mesh == mesh; });
    });
  }

  void make_meshes(const Store& store, std::size_t budget) {
    struct Task {
      std::uint32_t index;
      const Node* node;                                                ///< Null: there is no geometry.
      std::vector<std::pair<std::uint32_t, std::uint32_t>> materials;  ///< Slots by face material index.
    };
    std::vector<Task> tasks;
    std::set<std::uint32_t>& stale = placed.stale();
    while (!stale.empty() && tasks.size() < budget) {
      const std::uint32_t index = *stale.begin();
      stale.erase(stale.begin());
      MeshSlot& slot = placed.meshes()[index];
      const Node* node = store.find(slot.key.first);
      const std::uint64_t revision = node ? node->drawn_revision : 0;
      if (slot.made_from == revision) continue;
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
    for (const Task& task : tasks) {
      scene.meshes[task.index].revision = next_revision();
      scene.changes.add(scene.revision, {SceneChange::Kind::mesh, task.index});
      if (is_of_prototype(task.index)) scene.prototypes_revision = scene.revision;
    }
  }

  // ---- materials and images

  void evaluate_materials(const Store& store) {
    const auto image_of = [&](NodeId bitmap) {
      if (!image_slots.all().contains(bitmap)) changed_images.insert(bitmap);
      return static_cast<std::int32_t>(image_slots.of(bitmap, scene.images));
    };
    for (const NodeId id : std::exchange(changed_materials, {})) {
      const auto slot = material_slots.all().find(id);
      if (slot == material_slots.all().end()) continue;
      SurfaceMaterial& current = scene.materials[slot->second];
      const Node* node = store.find(id);
      SurfaceMaterial made = node ? evaluate_material(*node, image_of) : SurfaceMaterial{};
      baked.bake(store, id, node, scene, made);
      made.revision = current.revision;
      if (current.revision != 0 && same(made, current)) continue;
      tell({SceneChange::Kind::material, slot->second});
      made.revision = scene.revision;
      current = made;
    }
  }

  void make_images(const Store& store) {
    std::vector<std::pair<std::uint32_t, const Node*>> tasks;
    for (const NodeId id : std::exchange(changed_images, {})) {
      const auto slot = image_slots.all().find(id);
      if (slot == image_slots.all().end()) continue;
      const Node* node = store.find(id);
      const std::uint64_t revision = node ? node->drawn_revision : 0;
      const auto [made, added] = image_made_from.try_emplace(id, 0);
      if (!added && made->second == revision) continue;
      made->second = revision;
      tasks.emplace_back(slot->second, node);
    }
    parallel_for(tasks.size(), [&](std::size_t i) {
      const auto [slot, node] = tasks[i];
      scene.images[slot] = node ? image_of_bitmap(*node) : TextureImage{};
    });
    for (const auto& task : tasks) {
      tell({SceneChange::Kind::image, task.first});
      scene.images[task.first].revision = scene.revision;
    }
  }

  /// Renews the pixels of some tiles; false where the image has to be made as a whole.
  bool renew_tiles(const Node& node, const NodeChange& change) {
    const auto slot = image_slots.all().find(node.id);
    if (slot == image_slots.all().end()) return true;
    TextureImage& image = scene.images[slot->second];
    const auto pixels = scene::renew_tiles(image, node, change.layer, change.first_tile, change.tiles);
    if (!pixels) return false;
    image_made_from[node.id] = node.drawn_revision;
    if (pixels->width == 0 || pixels->height == 0) return true;
    tell({SceneChange::Kind::image, slot->second, no_mesh, *pixels});
    image.revision = scene.revision;
    return true;
  }

  // ---- updates

  void read_everything(const Store& store) {
    placed.place_all(store, scene);
    for (std::uint32_t index = 0; index < placed.meshes().size(); ++index)
      if (placed.meshes()[index].used) placed.stale().insert(index);
    for (const auto& entry : material_slots.all()) changed_materials.insert(entry.first);
    for (const auto& entry : image_slots.all()) changed_images.insert(entry.first);
  }

  void read_changes(const Store& store, std::span<const ChangeList<NodeChange>::Change> changes) {
    std::set<NodeId> objects;
    for (const auto& [revision, change] : changes) {
      const Node* node = store.find(change.node);
      if (node && node->drawn_revision <= seen) continue;
      // A destroyed node may have been of any type.
      if (!node || node->type() == NodeType::object) objects.insert(change.node);
      if (!node || node->type() == NodeType::geometry) placed.spoil(change.node);
      if (!node || node->type() == NodeType::material) changed_materials.insert(change.node);
      if (!node || node->type() == NodeType::bitmap) {
        changed_images.insert(change.node);
        for (const NodeId material : baked.made_from(change.node)) changed_materials.insert(material);
      }
    }
    // Tiles are renewed where nothing else of their bitmap changed.
    std::set<NodeId> whole_images;
    for (const auto& [revision, change] : changes)
      if (change.tiles == 0 && changed_images.contains(change.node)) whole_images.insert(change.node);
    for (const auto& [revision, change] : changes) {
      if (change.tiles == 0 || !changed_images.contains(change.node) || whole_images.contains(change.node)) continue;
      if (!renew_tiles(*store.find(change.node), change)) whole_images.insert(change.node);
    }
    changed_images = std::move(whole_images);
    if (!objects.empty()) placed.place_changed(store, objects, scene);
  }

  bool update(const Store& store, std::size_t mesh_budget) {
    if (!is_whole && store.revision() == seen && placed.stale().empty()) return false;
    const std::uint64_t before = scene.revision;
    const auto changes = is_whole ? std::nullopt : store.changes().since(seen);
    const bool separate = changes && changes->size() <= most_separate_changes;
    if (separate)
      read_changes(store, *changes);
    else
      read_everything(store);
    seen = store.revision();
    is_whole = false;
    make_meshes(store, mesh_budget);
    evaluate_materials(store);
    make_images(store);
    if (!separate) scene.changes.forget(scene.revision);
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
  state_->is_whole = true;
  state_->seen = 0;
  state_->image_made_from.clear();
  state_->baked.forget();
  for (MeshSlot& slot : state_->placed.meshes()) slot.made_from = ~std::uint64_t{0};
}

const ResolvedScene& Resolver::scene() const { return state_->scene; }
std::size_t Resolver::pending() const { return state_->placed.stale().size(); }

ResolvedScene resolve(const Store& store) {
  Resolver resolver;
  resolver.update(store);
  ResolvedScene scene = resolver.scene();
  scene.changes = ChangeList<SceneChange>(ChangeList<SceneChange>::knows_nothing);  // Its copy may be changed by hand.
  return scene;
}

}  // namespace septet::scene
