#pragma once
/// The scene for renderers: triangles, materials, images and placed parts, resolved from the node store.
///
/// A rasteriser (engine/render) and a ray tracer can both draw this, so that neither knows the node model. Lengths are
/// metres; meshes and parts are in their object's frame; only `world_from_object` is double. Everything carries a
/// revision: a renderer uploads content with a higher one than it last saw.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/change_list.hpp"
#include "engine/scene/image_sampling.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/scene/surface_map.hpp"

namespace septet::scene {

inline constexpr std::uint32_t white_vertex = 0xFFFFFFFFu;
/// Least opacity of a surface that is opaque: its alpha cuts holes, and is not blended.
inline constexpr float opaque_from = 0.999f;

struct SurfaceVertex {
  glm::vec3 position_m;
  glm::vec3 normal;
  glm::vec2 uv;
  std::uint32_t color =
      white_vertex;  ///< Multiplies the base colour. Linear, 8 bits each: red lowest, then green, blue.
  /// Direction of a normal map's red, in 8 bits with sign each: x lowest, y, z, and w, the side of its green: w ·
  /// (normal × tangent). 0: both follow from how the texture coordinates lie.
  std::uint32_t tangent = 0;
  glm::vec2 second_uv{0.0f};  ///< Of the images that SurfaceMaterial::by_second_uv names.
};

/// A run of triangles with one material; `material` indexes ResolvedScene::materials.
struct MeshPart {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t material = 0;
};

struct SurfaceMesh {
  std::uint64_t revision = 0;
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< Triangles, counter-clockwise seen from the front.
  std::vector<MeshPart> parts;
  glm::vec3 bounds_min_m{0.0f}, bounds_max_m{0.0f};
};

/// 8-bit RGBA, rows from the top. Mip levels are made by the renderer.
struct TextureImage {
  std::uint64_t revision = 0;
  std::uint32_t width = 0, height = 0;
  bool srgb = true;
  std::vector<std::uint8_t> rgba;
  ImageSampling sampling{};
};

/// Colours are linear Rec. 709.
struct SurfaceMaterial {
  std::uint64_t revision = 0;
  glm::vec3 base_color{0.8f};
  /// Indexes ResolvedScene::images; multiplies base_color; alpha cuts out below ½.
  std::int32_t base_color_image = -1;
  SurfaceMapImages maps = no_surface_maps;  ///< Indices of ResolvedScene::images.
  std::uint32_t by_second_uv = 0;           ///< Bit n: SurfaceMap n lies by SurfaceVertex::second_uv.
  float roughness = 0.7f;
  float metallic = 0.0f;
  float opacity = 1.0f;
  float refraction_index = 1.5f;
  /// Radiance relative to the sky's luminance; a lamp's part shines with it only while the lamp is on.
  glm::vec3 emission{0.0f};
  bool takes_paint = false;  ///< base_color is multiplied by the participant's paint.
  bool wettable = false;     ///< Darkens and reflects with the road's wetness.
  /// A thin stripe, whose uv.x runs from 0 at one edge to 1 at the other. A rasteriser draws it no thinner than it can
  /// sample, and as much fainter.
  bool stripe = false;
  /// Retroreflection of sheeting or beads, white, cd per lx and m² at 0.33° (EN 12899-1); multiplied by the base
  /// colour.
  float retroreflection = 0.0f;
  /// Layout of the image's pictures, side by side and below each other; a participant shows that of its number.
  std::uint32_t picture_columns = 1, picture_rows = 1;
  /// Share of the sky's light, and the sun's, that reaches it: 1 in the open, 0 in a tunnel, whose lamps then light it.
  /// The bounds of an instance with a material below ½ dim vehicles that drive through them.
  float share_of_sky = 1.0f;
  float clear_coat = 0.0f;  ///< Share of its area under a clear coat.
  /// True: its triangles are visible from both sides; false: culled from behind. Cut-out and transparent ones are
  /// always two-sided. Shadows are cast by either side of all.
  bool two_sided = false;
  /// Share of the sky's and the ground's light that passes close surroundings, where no ray is traced: 1 in the open,
  /// 0.35 on a dashboard. Excludes the sun's, for which shadows are drawn.
  float ambient_share = 1.0f;
  /// True for a window: its emission comes with the night; it is visible and lights no other surface.
  bool lit_by_night = false;
  /// True for a wall along a street, where houses hide the lowest sky and the wall shades the ground before it: light
  /// from around is then SkyLight::street_irradiance, where no ray is traced.
  bool in_street = false;
};

/// Source of a part's motion or light on a vehicle.
enum class PartRole : std::uint8_t {
  fixed,
  wheel_front_left,
  wheel_front_right,
  wheel_rear_left,
  wheel_rear_right,
  lamp_brake,
  lamp_reverse,
  lamp_indicator_left,
  lamp_indicator_right,
  lamp_head,
  lamp_tail,
  signal_red,  ///< Lamp of a traffic light, as are the next two.
  /// Limbs of a walking person, to arm_right: engine/world/limbs.hpp. A shin stands at the place of its thigh.
  signal_amber,
  signal_green,
  beacon,
  steering_wheel,
  leg_left,
  leg_right,
  shin_left,
  shin_right,
  arm_left,
  arm_right,
  pedalling_leg_left,  ///< Limbs of a cyclist, to crank; they move with the rear wheel.
  pedalling_leg_right,
  pedalling_shin_left,
  pedalling_shin_right,
  crank,
  foot_left,  ///< Of a walking person, as are the next two. A foot stands at the place of its thigh, too.
  foot_right,
  trunk,  ///< Whatever rises and falls with the hips.
};

/// Mesh of an instance that is no more: it keeps its index for others to come, and nothing is drawn of it.
inline constexpr std::uint32_t no_mesh = std::numeric_limits<std::uint32_t>::max();

struct KeyedPart;
/// True for keys and places that are equal, and for two null ones.
bool same_keys(const std::shared_ptr<const KeyedPart>& a, const std::shared_ptr<const KeyedPart>& b);

/// One placed mesh.
struct Instance {
  std::uint32_t mesh = 0;            ///< Indexes ResolvedScene::meshes; left out where it points outside.
  RigidTransform world_from_object;  ///< Pose; vehicle_from_object in a prototype.
  glm::vec3 scale{1.0f};
  float visible_from_m = 0.0f;  ///< Drawn while the eye's distance is in [visible_from_m, visible_to_m).
  float visible_to_m = 1e9f;
  bool casts_shadow = true;
  PartRole role = PartRole::fixed;
  std::shared_ptr<const KeyedPart> keyed{};  ///< Of a part that moves by keys (keyed_part.hpp); its pose is at rest.
  bool operator==(const Instance& other) const {
    return mesh == other.mesh && world_from_object.position_m == other.world_from_object.position_m &&
           world_from_object.orientation == other.world_from_object.orientation && scale == other.scale &&
           visible_from_m == other.visible_from_m && visible_to_m == other.visible_to_m &&
           casts_shadow == other.casts_shadow && role == other.role && same_keys(keyed, other.keyed);
  }
};

/// The drawing of every participant of one model ("model/NAME"), or of one object that moves by itself.
struct Prototype {
  std::string name;  ///< Empty: of an object.
  std::vector<Instance> parts;
  std::optional<glm::vec3> paint;  ///< Of what it hangs on, in place of that one's own; linear Rec. 709.
  Motion motion;                   ///< Of an object; without legs it has gone.
  std::uint32_t number = 0;        ///< Tells objects that move apart from each other and from participants.
  std::optional<PushableBox> box;  ///< Of an object that can be pushed, which need not have legs.
  bool is_hidden = false;          ///< Of a participant: it is not drawn.
};

/// Pixels of an image, from the upper left.
struct PixelRect {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PixelRect&) const = default;
};

/// One part that changed.
struct SceneChange {
  enum class Kind : std::uint8_t { instance, mesh, material, image, prototype };
  Kind kind = Kind::instance;
  std::uint32_t index = 0;              ///< In the array of its kind.
  std::uint32_t mesh_before = no_mesh;  ///< Of an instance.
  PixelRect pixels{};                   ///< Of an image of the same size; no width: the whole image.
  bool operator==(const SceneChange&) const = default;
};

struct ResolvedScene {
  std::uint64_t revision = 0;  ///< Highest of all parts below.
  std::uint64_t prototypes_revision =
      0;  ///< Of the newest change of prototypes and their meshes; 0: `revision` counts.
  std::vector<SurfaceMesh> meshes;
  std::vector<SurfaceMaterial> materials;
  std::vector<TextureImage> images;
  std::vector<Instance> instances;
  std::vector<Prototype> prototypes;
  /// What changed, for a renderer that follows the scene of one resolver; a scene made otherwise knows nothing.
  ChangeList<SceneChange> changes{ChangeList<SceneChange>::knows_nothing};
};

/// Revision of prototypes and their meshes, for what is made from their shapes.
inline std::uint64_t shape_revision(const ResolvedScene& scene) {
  return scene.prototypes_revision != 0 ? scene.prototypes_revision : scene.revision;
}

}  // namespace septet::scene
