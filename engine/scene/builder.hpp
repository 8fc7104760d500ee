#pragma once
/// Fills a store with scenery: meshes, images, materials and placed objects, in the conventions of CONVENTIONS.md.
///
/// All content goes through commands, so that the scenery can be replicated, changed and logged like any other content.
/// A call with values that a store would refuse (not finite, index out of range, over a limit) is a bug of the caller
/// and stops the program.

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

struct MeshOptions {
  /// 0 draws the polygons as they are, with smooth normals except at creases; n subdivides n times (at most 4).
  std::uint32_t subdivision_level = 0;
  /// Positions are rounded to this power of two (metres) and uvs to 1/4096, which makes the transfer compact. Zero
  /// chooses by the mesh's size: about 1/30,000 of its extent, between 2^-14 m and 2^-10 m (1 mm).
  double position_step_m = 0.0;
};

struct MaterialParameters {
  glm::vec3 base_color{0.8f};  ///< Linear Rec. 709.
  NodeId base_color_bitmap = no_node;
  BySurfaceMap<NodeId> maps{{no_node, no_node, no_node}};  ///< Bitmaps.
  std::uint32_t by_second_uv = 0;                          ///< See SurfaceMaterial.
  float roughness = 0.7f;
  float metallic = 0.0f;
  float opacity = 1.0f;
  float refraction_index = 1.5f;
  glm::vec3 emission{0.0f};
  bool takes_paint = false;
  bool wettable = false;
  bool stripe = false;  ///< See SurfaceMaterial, here and below.
  float retroreflection = 0.0f;
  std::uint32_t picture_columns = 1, picture_rows = 1;
  float share_of_sky = 1.0f;  ///< 0 in a tunnel: see SurfaceMaterial.
  float clear_coat = 0.0f;
  bool two_sided = false;
  float ambient_share = 1.0f;
  bool lit_by_night = false;
  bool in_street = false;
};

/// Its light of its own is that of the base colour's picture, in the picture's colours, times `emission`.
void shine_by_picture(MaterialParameters& material);

struct ObjectParameters {
  RigidTransform parent_from_object{};  ///< Pose; world_from_object for an object without a parent.
  glm::vec3 scale{1.0f};
  NodeId geometry = no_node;        ///< No geometry: the object groups its children.
  std::vector<NodeId> materials{};  ///< Entry k is for the polygons of material index k.
  float visible_from_m = 0.0f;
  float visible_to_m = 1e9f;
  PartRole role = PartRole::fixed;
  bool casts_shadow = true;
};

class SceneBuilder {
 public:
  /// `applied` (may be empty) is called with every command after the store has accepted it, for the replication server.
  explicit SceneBuilder(Store& store, std::function<void(const Command&)> applied = {});

  NodeId add_mesh(std::string_view name, const geometry::PolygonMesh& mesh, const MeshOptions& options = {});
  /// `rgba`: width × height × 4 bytes, rows from the top. Alpha is sent only where it is not opaque throughout.
  NodeId add_bitmap(std::string_view name, std::uint32_t width, std::uint32_t height,
                    std::span<const std::uint8_t> rgba, bool srgb = true, const ImageSampling& sampling = {});
  NodeId add_material(std::string_view name, const MaterialParameters& parameters);
  NodeId add_object(std::string_view name, const ObjectParameters& parameters);
  /// An object that is not drawn itself: the root of the drawing of every participant of model `model_name`. Give it
  /// its parts with add_child.
  NodeId add_prototype(std::string_view model_name);
  /// The child's transform is then relative to the parent's.
  void add_child(NodeId parent, NodeId child);

  /// The name, or where it was returned before, the name with a number: "name/2".
  std::string unused_name(std::string name);

  /// Applies one command to the store; a refused one stops the program.
  void apply(const Command& command);

 private:
  NodeId create(NodeType type, std::string_view name);

  Store& store_;
  std::function<void(const Command&)> applied_;
  std::map<std::string, std::uint32_t> used_names_;  ///< With their numbers.
};

}  // namespace septet::scene
