#pragma once
/// Where objects stand, as instances of meshes: one root and everything below it is placed at a time, so that an edit
/// costs what hangs on the edited root. Instances keep their index; those of removed objects become no_mesh and serve
/// again.

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/scene/drawn_object.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/scene/slots.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// Meshes are shared by objects that have geometry and materials in common.
using MeshKey = std::pair<NodeId, FaceMaterials>;

struct MeshSlot {
  MeshKey key;
  std::uint64_t made_from = 0;  ///< The geometry node's drawn revision.
  std::uint32_t uses = 0;       ///< Instances and parts of prototypes that have it.
  bool used = false;            ///< False: the slot is free.
};

class PlacedObjects {
 public:
  /// Reads and places everything anew.
  void place_all(const Store& store, ResolvedScene& scene);
  /// Reads the changed objects, whether they exist or not, and places what they belong to.
  void place_changed(const Store& store, const std::set<NodeId>& changed, ResolvedScene& scene);

  std::vector<MeshSlot>& meshes() { return meshes_; }
  /// Meshes to be made: new ones, and those of a changed geometry.
  std::set<std::uint32_t>& stale() { return stale_; }
  /// Marks the meshes of a geometry.
  void spoil(NodeId geometry);

 private:
  struct Object {
    DrawnObject drawn;
    std::uint32_t mesh = no_mesh;  ///< Slot at its last placement.
  };
  /// A root's instances: indices from `first`, or a prototype's.
  struct Root {
    std::uint32_t first = 0, capacity = 0;
    std::size_t visits = 0;
    bool is_model = false, moves = false;  ///< Either: its instances are parts of a prototype.
    std::uint32_t prototype = 0;
  };
  /// The keyed object that is placed now or is above the placed one; of several the uppermost.
  struct Keyed {
    ScaledPose above;
    const std::vector<PoseKey>* keys = nullptr;
    ScaledPose below;
  };

  std::uint32_t use_mesh(Object& object, ResolvedScene& scene);
  void leave_mesh(std::uint32_t mesh);
  void free_unused(ResolvedScene& scene);
  void place(Object& object, NodeId id, const ScaledPose& parent, const Keyed* keyed, std::vector<NodeId>& path,
             std::size_t& visits, std::vector<Instance>& into, ResolvedScene& scene);
  static Motion motion_of(const DrawnObject& root, std::vector<Instance>& instances);
  void link_children(NodeId parent, const std::vector<NodeId>& children);
  void unlink_children(NodeId parent, const std::vector<NodeId>& children);
  void add_roots_above(NodeId id, std::set<NodeId>& roots) const;
  bool read(const Store& store, NodeId id, std::set<NodeId>& to_place);
  /// False where models come or go, which only place_all does.
  bool place_root(NodeId id, ResolvedScene& scene);
  bool place_model(Root& root, const Object& object, std::vector<Instance> parts, ResolvedScene& scene);
  void place_moving(Root& root, NodeId id, const Object& object, const Motion& motion, std::vector<Instance> parts,
                    ResolvedScene& scene);
  void stop_moving(Root& root, ResolvedScene& scene);
  void set_parts(std::uint32_t prototype, std::vector<Instance> parts, ResolvedScene& scene);
  void keep(Root& root, const std::vector<Instance>& instances, ResolvedScene& scene);
  void set_instance(std::uint32_t index, const Instance& instance, ResolvedScene& scene);
  void clear(const Root& root, ResolvedScene& scene);

  std::map<NodeId, Object> objects_;
  std::map<NodeId, std::vector<NodeId>> parents_;  ///< By child, once for each link.
  std::map<NodeId, Root> roots_;
  std::vector<std::uint32_t> free_prototypes_;               ///< Of objects that moved.
  std::multimap<std::uint32_t, std::uint32_t> free_ranges_;  ///< First instance, by capacity.
  std::size_t visits_ = 0;                                   ///< Of all roots.
  std::size_t unused_instances_ = 0;
  Slots<MeshKey, SurfaceMesh> mesh_slots_;
  std::vector<MeshSlot> meshes_;
  std::set<std::uint32_t> stale_, left_;  ///< left_: a use of it ended.
};

}  // namespace septet::scene
