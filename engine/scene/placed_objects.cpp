#include "engine/scene/placed_objects.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/world_bounds.hpp"

namespace septet::scene {
namespace {

/// Limit of objects placed: children shared again and again multiply.
constexpr std::size_t most_visits = 1u << 20;
/// Unused instances from which on all are placed anew, if they are the greater part.
constexpr std::size_t many_unused = 4096;

/// Of no participant: those count from 0.
std::uint32_t moving_number(NodeId id) { return 0x8000'0000u | id; }

/// Or is moved by pushes.
bool moves_by_itself(const Motion& motion, const DrawnObject& drawn) { return !motion.legs.empty() || drawn.box; }

}  // namespace

// ---- meshes

std::uint32_t PlacedObjects::use_mesh(Object& object, ResolvedScene& scene) {
  const DrawnObject& drawn = object.drawn;
  const auto is_of = [&](const MeshSlot& slot) {
    return slot.used && slot.key.first == drawn.geometry && slot.key.second == drawn.materials;
  };
  if (object.mesh >= meshes_.size() || !is_of(meshes_[object.mesh])) {
    const MeshKey key{drawn.geometry, drawn.materials};
    object.mesh = mesh_slots_.of(key, scene.meshes);
    if (object.mesh >= meshes_.size()) meshes_.resize(object.mesh + 1);
    if (!is_of(meshes_[object.mesh])) {
      meshes_[object.mesh] = {key, 0, 0, true};
      stale_.insert(object.mesh);
    }
  }
  ++meshes_[object.mesh].uses;
  return object.mesh;
}

void PlacedObjects::leave_mesh(std::uint32_t mesh) {
  if (mesh >= meshes_.size()) return;
  if (--meshes_[mesh].uses == 0) left_.insert(mesh);
}

void PlacedObjects::free_unused(ResolvedScene& scene) {
  for (const std::uint32_t mesh : std::exchange(left_, {})) {
    MeshSlot& slot = meshes_[mesh];
    if (!slot.used || slot.uses > 0) continue;
    scene.meshes[mesh] = {};
    scene.meshes[mesh].revision = ++scene.revision;
    scene.changes.add(scene.revision, {SceneChange::Kind::mesh, mesh});
    mesh_slots_.release(slot.key);
    stale_.erase(mesh);
    slot = {};
  }
}

void PlacedObjects::spoil(NodeId geometry) {
  const auto& all = mesh_slots_.all();
  for (auto at = all.lower_bound({geometry, {}}); at != all.end() && at->first.first == geometry; ++at)
    stale_.insert(at->second);
}

// ---- one root

/// Appends an object and everything below it. `path` holds the objects above.
void PlacedObjects::place(Object& object, NodeId id, const ScaledPose& parent, const Keyed* above,
                          std::vector<NodeId>& path, std::size_t& visits, std::vector<Instance>& into,
                          ResolvedScene& scene) {
  const DrawnObject& drawn = object.drawn;
  if (drawn.hidden || path.size() >= deepest_child || visits_ + ++visits > most_visits) return;
  if (std::find(path.begin(), path.end(), id) != path.end()) return;
  const RigidTransform own{drawn.transform.position_m, drawn.transform.rotation};
  const ScaledPose placed = child_of(parent, own, drawn.transform.scale);
  if (!is_in_world(placed.pose.position_m) || !is_within(placed.scale, largest_drawn_scale)) return;
  Keyed keyed;
  if (above)
    keyed = {above->above, above->keys, child_of(above->below, own, drawn.transform.scale)};
  else if (!drawn.keys.empty())
    keyed = {parent, &drawn.keys, {}};
  if (drawn.geometry != no_node)
    into.push_back(
        {use_mesh(object, scene), placed.pose, placed.scale, drawn.visible_from_m, drawn.visible_to_m,
         drawn.casts_shadow, drawn.role,
         keyed.keys ? std::make_shared<const KeyedPart>(KeyedPart{keyed.above, keyed.below, *keyed.keys}) : nullptr});
  path.push_back(id);
  for (const NodeId child : drawn.children)
    if (const auto found = objects_.find(child); found != objects_.end())
      place(found->second, child, placed, keyed.keys ? &keyed : nullptr, path, visits, into, scene);
  path.pop_back();
}

/// The motion by which a root is drawn: its own, or, with parts that move by keys, one that stands at its pose, to
/// which `instances` are then relative. Without legs for any other.
Motion PlacedObjects::motion_of(const DrawnObject& root, std::vector<Instance>& instances) {
  if (moves_by_itself(root.motion, root)) return root.motion;
  if (std::ranges::none_of(instances, [](const Instance& part) { return part.keyed != nullptr; })) return {};
  const RigidTransform root_from_world = inverse({root.transform.position_m, root.transform.rotation});
  for (Instance& part : instances) {
    part.world_from_object = root_from_world * part.world_from_object;
    if (!part.keyed) continue;
    KeyedPart keyed = *part.keyed;
    keyed.above.pose = root_from_world * keyed.above.pose;
    part.keyed = std::make_shared<const KeyedPart>(std::move(keyed));
  }
  return {root.transform.position_m, root.transform.rotation, {MotionLeg{}}};
}

void PlacedObjects::set_instance(std::uint32_t index, const Instance& instance, ResolvedScene& scene) {
  Instance& current = scene.instances[index];
  if (current == instance) return;
  if (current.mesh == no_mesh) --unused_instances_;
  if (instance.mesh == no_mesh) ++unused_instances_;
  scene.changes.add(scene.revision, {SceneChange::Kind::instance, index, current.mesh});
  current = instance;
}

void PlacedObjects::clear(const Root& root, ResolvedScene& scene) {
  Instance none;
  none.mesh = no_mesh;
  for (std::uint32_t i = root.first; i < root.first + root.capacity; ++i) set_instance(i, none, scene);
  if (root.capacity > 0) free_ranges_.emplace(root.capacity, root.first);
}

/// Writes the root's instances to its range, or to another one if they are too many for it.
void PlacedObjects::keep(Root& root, const std::vector<Instance>& instances, ResolvedScene& scene) {
  const auto count = static_cast<std::uint32_t>(instances.size());
  if (count > root.capacity) {
    clear(root, scene);
    root.capacity = count;
    if (const auto fits = free_ranges_.find(count); fits != free_ranges_.end()) {
      root.first = fits->second;
      free_ranges_.erase(fits);
    } else {
      root.first = static_cast<std::uint32_t>(scene.instances.size());
      Instance none;
      none.mesh = no_mesh;
      scene.instances.resize(scene.instances.size() + count, none);
      unused_instances_ += count;
    }
  }
  Instance none;
  none.mesh = no_mesh;
  for (std::uint32_t i = 0; i < root.capacity; ++i)
    set_instance(root.first + i, i < count ? instances[i] : none, scene);
}

void PlacedObjects::set_parts(std::uint32_t prototype, std::vector<Instance> parts, ResolvedScene& scene) {
  for (const Instance& part : scene.prototypes[prototype].parts) leave_mesh(part.mesh);
  if (scene.prototypes[prototype].parts == parts) return;
  scene.prototypes[prototype].parts = std::move(parts);
  scene.changes.add(scene.revision, {SceneChange::Kind::prototype, prototype});
}

bool PlacedObjects::place_model(Root& root, const Object& object, std::vector<Instance> parts, ResolvedScene& scene) {
  Prototype& prototype = scene.prototypes[root.prototype];
  if (prototype.name != *object.drawn.prototype) return false;
  if (prototype.paint != object.drawn.paint || prototype.is_hidden != object.drawn.hidden)
    scene.changes.add(scene.revision, {SceneChange::Kind::prototype, root.prototype});
  prototype.paint = object.drawn.paint;
  prototype.is_hidden = object.drawn.hidden;
  const bool is_changed = prototype.parts != parts;
  if (is_changed) scene.prototypes_revision = scene.revision;
  set_parts(root.prototype, std::move(parts), scene);
  return true;
}

/// Prototypes keep their indices, so one of an object comes and goes for the price of its parts.
void PlacedObjects::place_moving(Root& root, NodeId id, const Object& object, const Motion& motion,
                                 std::vector<Instance> parts, ResolvedScene& scene) {
  if (!root.moves) {
    clear(root, scene);
    root = {.visits = root.visits, .moves = true, .prototype = static_cast<std::uint32_t>(scene.prototypes.size())};
    if (free_prototypes_.empty()) {
      scene.prototypes.emplace_back();
    } else {
      root.prototype = free_prototypes_.back();
      free_prototypes_.pop_back();
    }
  }
  Prototype& prototype = scene.prototypes[root.prototype];
  if (prototype.motion != motion || prototype.box != object.drawn.box)
    scene.changes.add(scene.revision, {SceneChange::Kind::prototype, root.prototype});
  prototype.motion = motion;
  prototype.box = object.drawn.box;
  prototype.number = moving_number(id);
  set_parts(root.prototype, std::move(parts), scene);
}

void PlacedObjects::stop_moving(Root& root, ResolvedScene& scene) {
  set_parts(root.prototype, {}, scene);
  scene.prototypes[root.prototype] = {};
  free_prototypes_.push_back(root.prototype);
  root.moves = false;
}

bool PlacedObjects::place_root(NodeId id, ResolvedScene& scene) {
  const auto found = objects_.find(id);
  const auto known = roots_.find(id);
  const bool is_root = found != objects_.end() && !parents_.contains(id);
  const bool is_model = is_root && found->second.drawn.prototype;
  const bool was_model = known != roots_.end() && known->second.is_model;
  if (is_model != was_model) return false;
  if (known == roots_.end() && !is_root) return true;

  std::vector<std::uint32_t> meshes_before;
  if (known != roots_.end())
    for (std::uint32_t i = 0; i < known->second.capacity; ++i)
      meshes_before.push_back(scene.instances[known->second.first + i].mesh);
  Root& root = known != roots_.end() ? known->second : roots_[id];
  visits_ -= std::exchange(root.visits, 0);
  std::vector<Instance> instances;
  std::vector<NodeId> path;
  if (is_root) place(found->second, id, {}, nullptr, path, root.visits, instances, scene);
  visits_ += root.visits;
  ++scene.revision;
  if (is_model) return place_model(root, found->second, std::move(instances), scene);
  const Motion motion = is_root ? motion_of(found->second.drawn, instances) : Motion{};
  const bool moves = is_root && moves_by_itself(motion, found->second.drawn);
  if (root.moves && !moves) stop_moving(root, scene);
  if (moves) {
    place_moving(root, id, found->second, motion, std::move(instances), scene);
  } else if (is_root) {
    keep(root, instances, scene);
  } else {
    clear(root, scene);
    roots_.erase(id);
  }
  for (const std::uint32_t mesh : meshes_before)
    if (mesh != no_mesh) leave_mesh(mesh);
  return true;
}

// ---- objects

void PlacedObjects::link_children(NodeId parent, const std::vector<NodeId>& children) {
  for (const NodeId child : children) parents_[child].push_back(parent);
}

void PlacedObjects::unlink_children(NodeId parent, const std::vector<NodeId>& children) {
  for (const NodeId child : children) {
    const auto found = parents_.find(child);
    found->second.erase(std::find(found->second.begin(), found->second.end(), parent));
    if (found->second.empty()) parents_.erase(found);
  }
}

void PlacedObjects::add_roots_above(NodeId id, std::set<NodeId>& roots) const {
  std::vector<NodeId> open{id};
  std::set<NodeId> seen{id};
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    const auto above = parents_.find(at);
    if (above == parents_.end()) {
      roots.insert(at);
      continue;
    }
    for (const NodeId parent : above->second)
      if (seen.insert(parent).second) open.push_back(parent);
  }
}

/// Reads one object, and adds the objects to be placed; false where nothing of it is drawn otherwise.
bool PlacedObjects::read(const Store& store, NodeId id, std::set<NodeId>& to_place) {
  const Node* node = store.find(id);
  const bool is_object = node && node->type() == NodeType::object;
  const auto found = objects_.find(id);
  if (!is_object && found == objects_.end()) return false;
  DrawnObject drawn;
  if (is_object) drawn = read_object(*node);
  if (is_object && found != objects_.end() && found->second.drawn == drawn) return false;
  const std::vector<NodeId> before = found == objects_.end() ? std::vector<NodeId>{} : found->second.drawn.children;
  if (before != drawn.children) {
    unlink_children(id, before);
    link_children(id, drawn.children);
    to_place.insert(before.begin(), before.end());
    to_place.insert(drawn.children.begin(), drawn.children.end());
  }
  if (is_object)
    objects_[id].drawn = std::move(drawn);
  else
    objects_.erase(found);
  to_place.insert(id);
  return true;
}

void PlacedObjects::place_changed(const Store& store, const std::set<NodeId>& changed, ResolvedScene& scene) {
  std::set<NodeId> to_place, roots;
  for (const NodeId id : changed) read(store, id, to_place);
  for (const NodeId id : to_place) {
    if (roots_.contains(id)) roots.insert(id);  // It may be a child now.
    add_roots_above(id, roots);
  }
  bool whole = false;
  for (const NodeId id : roots) whole = !place_root(id, scene) || whole;
  if (whole || (unused_instances_ > many_unused && unused_instances_ > scene.instances.size() / 2))
    place_all(store, scene);
  else
    free_unused(scene);
}

void PlacedObjects::place_all(const Store& store, ResolvedScene& scene) {
  objects_.clear(), parents_.clear(), roots_.clear(), free_ranges_.clear(), free_prototypes_.clear();
  visits_ = unused_instances_ = 0;
  for (const auto& [id, node] : store.nodes())
    if (node.type() == NodeType::object) {
      Object& object = objects_[id];
      object.drawn = read_object(node);
      link_children(id, object.drawn.children);
    }
  for (MeshSlot& slot : meshes_) slot.uses = 0;
  scene.instances.clear();
  scene.prototypes.clear();
  std::vector<NodeId> path;
  for (auto& [id, object] : objects_) {
    if (parents_.contains(id)) continue;
    Root& root = roots_[id];
    root.is_model = object.drawn.prototype.has_value();
    std::vector<Instance> instances;
    place(object, id, {}, nullptr, path, root.visits, instances, scene);
    const Motion motion = root.is_model ? Motion{} : motion_of(object.drawn, instances);
    root.moves = !root.is_model && moves_by_itself(motion, object.drawn);
    if (root.is_model || root.moves) {
      root.prototype = static_cast<std::uint32_t>(scene.prototypes.size());
      scene.prototypes.push_back({object.drawn.prototype.value_or(""), std::move(instances), object.drawn.paint, motion,
                                  root.moves ? moving_number(id) : 0, object.drawn.box,
                                  root.is_model && object.drawn.hidden});
    } else {
      root.first = static_cast<std::uint32_t>(scene.instances.size());
      root.capacity = static_cast<std::uint32_t>(instances.size());
      scene.instances.insert(scene.instances.end(), instances.begin(), instances.end());
    }
    visits_ += root.visits;
  }
  for (std::uint32_t i = 0; i < meshes_.size(); ++i)
    if (meshes_[i].used && meshes_[i].uses == 0) left_.insert(i);
  free_unused(scene);
  scene.prototypes_revision = ++scene.revision;
  scene.changes.forget(scene.revision);
}

}  // namespace septet::scene
