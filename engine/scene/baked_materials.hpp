#pragma once
/// The baked materials of a resolver: which pictures stand for which material, and from what they were made.

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/scene/material_baking.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/scene/slots.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

class BakedMaterials {
 public:
  /// Replaces what of a material varies over the surface by pictures of it, in slots of the scene's images; they are
  /// made anew where the material or a bitmap that it reads has changed. `node` is null where there is no such material
  /// (any more).
  void bake(const Store& store, NodeId id, const Node* node, ResolvedScene& scene, SurfaceMaterial& made);
  /// Materials whose pictures were made from this bitmap.
  std::vector<NodeId> made_from(NodeId bitmap) const;
  /// All are made anew when they are baked next.
  void forget();

 private:
  enum class Picture : std::uint8_t { base_color, emission, properties };
  struct Bake {
    std::map<NodeId, std::uint64_t> made_from;  ///< Revisions of the material and of the bitmaps that it reads.
    SurfaceNumbers numbers;
    std::int32_t base_color = -1, emission = -1, properties = -1;  ///< Slots.
  };

  void keep_pictures(NodeId material, Bake& bake, BakedSurface baked, ResolvedScene& scene);
  /// Puts a picture into its slot, or empties that; returns its index, -1 without one.
  std::int32_t keep(NodeId material, Picture kind, std::optional<TextureImage> picture, ResolvedScene& scene);

  Slots<std::pair<NodeId, Picture>, TextureImage> slots_;
  std::map<NodeId, Bake> bakes_;  ///< By material.
};

}  // namespace septet::scene
