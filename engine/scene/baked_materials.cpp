#include "engine/scene/baked_materials.hpp"

namespace septet::scene {
namespace {

std::map<NodeId, std::uint64_t> revisions_for(const Store& store, const Node& material) {
  std::map<NodeId, std::uint64_t> revisions{{material.id, material.drawn_revision}};
  for (const NodeId bitmap : bitmaps_of(material)) {
    const Node* node = store.find(bitmap);
    revisions[bitmap] = node ? node->drawn_revision : 0;
  }
  return revisions;
}

}  // namespace

void BakedMaterials::bake(const Store& store, NodeId id, const Node* node, ResolvedScene& scene,
                          SurfaceMaterial& made) {
  if (!node || !is_to_be_baked(*node)) {
    if (const auto before = bakes_.find(id); before != bakes_.end()) {
      keep_pictures(id, before->second, {}, scene);
      bakes_.erase(before);
    }
    return;
  }
  Bake& bake = bakes_[id];
  if (auto revisions = revisions_for(store, *node); bake.made_from != revisions) {
    bake.made_from = std::move(revisions);
    keep_pictures(id, bake, bake_material(*node, [&](NodeId bitmap) { return store.find(bitmap); }), scene);
  }
  set_numbers(bake.numbers, made);
  made.base_color_image = bake.base_color;
  // A bitmap of the material's own tags counts before what its tree comes to.
  if (made.maps[SurfaceMap::emission] < 0) made.maps[SurfaceMap::emission] = bake.emission;
  if (made.maps[SurfaceMap::properties] < 0) made.maps[SurfaceMap::properties] = bake.properties;
}

std::vector<NodeId> BakedMaterials::made_from(NodeId bitmap) const {
  std::vector<NodeId> materials;
  for (const auto& [material, bake] : bakes_)
    if (bake.made_from.contains(bitmap)) materials.push_back(material);
  return materials;
}

void BakedMaterials::forget() {
  for (auto& entry : bakes_) entry.second.made_from.clear();
}

void BakedMaterials::keep_pictures(NodeId material, Bake& bake, BakedSurface baked, ResolvedScene& scene) {
  bake.numbers = baked.numbers;
  bake.base_color = keep(material, Picture::base_color, std::move(baked.base_color), scene);
  bake.emission = keep(material, Picture::emission, std::move(baked.emission), scene);
  bake.properties = keep(material, Picture::properties, std::move(baked.properties), scene);
}

std::int32_t BakedMaterials::keep(NodeId material, Picture kind, std::optional<TextureImage> picture,
                                  ResolvedScene& scene) {
  const std::pair key{material, kind};
  const auto before = slots_.all().find(key);
  if (!picture && before == slots_.all().end()) return -1;
  const std::uint32_t slot = slots_.of(key, scene.images);
  const bool is_kept = picture.has_value();
  if (!is_kept) slots_.release(key);
  TextureImage& image = scene.images[slot];
  TextureImage made = std::move(picture).value_or(TextureImage{});
  if (image.width != made.width || image.height != made.height || image.srgb != made.srgb || image.rgba != made.rgba) {
    scene.changes.add(++scene.revision, {SceneChange::Kind::image, slot});
    image = std::move(made);
    image.revision = scene.revision;
  }
  return is_kept ? static_cast<std::int32_t>(slot) : -1;
}

}  // namespace septet::scene
