#pragma once
/// A user's own glTF 2.0 file as scenery: meshes by node, and their materials' numbers.
///
/// Read from a file: the default scene's nodes with their transforms, and the animations that move them
/// (animation.hpp); triangles, strips and fans with positions, normals, texture coordinates, the first vertex colours
/// and tangents, sparse accessors too; of materials base colour, metallic, roughness, emissive (with
/// KHR_materials_emissive_strength), normals, occlusion, by factor and PNG or JPEG texture, which may name its set of
/// coordinates and transform them, in two ways for one material; alpha, transmission as transparency, and unlit ones as
/// emission. Skinned meshes stand as their joints do, morph targets by their weights, and in motion both move in steps
/// (bent_meshes.hpp); cameras and lights are skipped. A file is self-contained: a .glb, or a .gltf whose buffers are
/// data: URIs. External files that it names are never opened.
///
/// Axes: glTF has y up, z forward and x left (its specification, 3.4); here x is forward, y left, z up, metres.
/// Vertices are joined where position and normal agree, so that edges which the file keeps sharp stay sharp.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/core/expected.hpp"
#include "engine/geometry/polygon_mesh.hpp"
#include "engine/image/image.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {

/// Limits of a file. A model is drawn many times a picture, on every screen.
inline constexpr std::size_t largest_file_bytes = 64u << 20, most_triangles = 200'000, most_vertices = 600'000,
                             most_materials = 256, most_parts = 256;
/// Pictures are halved until they are no larger than the second.
inline constexpr std::uint32_t largest_picture_px = 4096, drawn_picture_px = 1024;
/// Limit of distances from its origin; a file beyond it is not in metres.
inline constexpr float furthest_m = 2000.0f;

/// Selects the texture coordinates of a picture (glTF 2.0, 3.9.2), with KHR_texture_transform on them: scaled, then
/// turned, then moved.
struct PictureMapping {
  std::uint32_t uv_set = 0;  ///< n of TEXCOORD_n.
  glm::dvec2 scale{1.0}, offset{0.0};
  double rotation_rad = 0.0;  ///< About the coordinates' origin, counter-clockwise in the picture; v points down.
  /// Share of the held picture that the file's takes: a half along an axis on which it repeats mirrored (3.8.4.5),
  /// since the held one is then followed by its mirror image.
  glm::dvec2 share{1.0};

  glm::dvec2 operator()(const glm::dvec2& uv) const;
  bool operator==(const PictureMapping&) const = default;
};

/// A picture of a material; others than colours, of normals and the like, are not sRGB but linear.
struct Picture : image::Image {
  bool is_linear = false;
  bool ends_u = false,
       ends_v = false;    ///< Goes on as its edges' pixels are beyond them; otherwise it repeats (3.8.4.5).
  bool is_sharp = false;  ///< Near to, a place has the colour of one pixel (3.8.4.4).
};

/// A material. Colours are linear Rec. 709. Pictures are indices of Model::pictures, −1 where there is none; each lies
/// by one of two sets of coordinates. They are those of scene::SurfaceMap, the strengths of a file worked in.
struct Look {
  std::string name;
  glm::vec3 base_color{1.0f};
  std::int32_t picture = -1;             ///< Indexes Model::pictures; multiplies base_color.
  std::int32_t emission_picture = -1;    ///< Multiplies emission.
  std::int32_t properties_picture = -1;  ///< Red: share of the light from around; green, blue: times the two below.
  std::int32_t normal_picture = -1;
  PictureMapping mapping;          ///< Mapping of the pictures' coordinates.
  PictureMapping second_mapping;   ///< Of the pictures that `by_second_uv` names.
  std::uint32_t by_second_uv = 0;  ///< See scene::SurfaceMaterial; its bits are
  static constexpr std::uint32_t emission_bit = 1, properties_bit = 2, normal_bit = 4;
  bool is_unlit = false;                ///< Shines with its base colour, whatever the light.
  bool ends_u = false, ends_v = false;  ///< One of its pictures does.
  float roughness = 1.0f, metallic = 1.0f, opacity = 1.0f;
  bool alpha_blends = false;  ///< The picture's alpha multiplies the opacity; otherwise it cuts out below ½.
  glm::vec3 emission{0.0f};   ///< A picture of the base colour does not colour it.
  bool two_sided = false;     ///< The file's `doubleSided`.

  bool has_picture() const {
    return picture >= 0 || emission_picture >= 0 || properties_picture >= 0 || normal_picture >= 0;
  }
};

/// A part that moves or shines as one, or the rest.
struct Part {
  std::string name;            ///< Name of the node that begins it; empty: everything that belongs to no part.
  glm::vec3 origin_m{0.0};     ///< The node's place in the model; the mesh is relative to it, axes as the model's.
  geometry::PolygonMesh mesh;  ///< Materials are indices of Model::looks.
  /// Poses of a part that an animation moves, in the model's frame and by their time in the animation, which repeats;
  /// the mesh is then relative to them, and `origin_m` zero. Empty for any other.
  std::vector<PoseKey> keys{};

  /// False for one that its animation gives no size at the beginning, as all but one pose of a bent mesh.
  bool is_there_at_first() const { return keys.empty() || keys.front().scale != glm::vec3(0.0f); }
};

using ExtraValue = std::variant<bool, double, std::string, glm::dvec3>;

/// A property that the file's author gave to a node.
struct Extra {
  std::string name;
  ExtraValue value;
  bool operator==(const Extra&) const = default;
};

struct Model {
  std::vector<Part> parts;  ///< Empty without a triangle.
  std::vector<Look> looks;
  std::vector<Picture> pictures;
  glm::vec3 least_m{0.0f}, most_m{0.0f};  ///< Bounds of all parts.
  std::vector<Extra> extras;              ///< Of all nodes, by name; of equal names the first that is read.
  std::vector<std::string> left_out;      ///< Skipped contents that may be missed, each a sentence.
};

/// `where` names the file in errors. A node whose name `begins_part` accepts starts a part, with everything below it.
/// Error, for any bytes: the fault, its accessor, node or chunk, and the remedy.
Expected<Model> read_gltf(std::string_view bytes, std::string_view where,
                          const std::function<bool(std::string_view)>& begins_part);

}  // namespace septet::gltf
