#pragma once
/// Content of the store: nodes of a few types, each a set of parts that can be addressed and changed one by one.
///
/// Source: Brink, Steenberg and Svensson, "The Verse Networked 3D Graphics Platform" (2006), §2.2 and §2.4. A node has
/// a 32-bit id that the server assigns and never uses twice, a name, and groups of typed tags; the rest depends on its
/// type. Verse's text, curve and audio nodes have no user here and are left out.
///
/// Units: metres, world frame and object frames as in rigid_transform.hpp. `revision` is the store's revision of the
/// last change of that part; a node's is the highest of its parts.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/material_fragment.hpp"
#include "engine/scene/motion.hpp"

namespace septet::scene {

using geometry::PolygonCorners;

/// Numbered as on the wire.
enum class NodeType : std::uint8_t { object, geometry, material, bitmap };
inline constexpr int node_type_count = 4;

using PartId = std::uint16_t;  ///< Id of a tag group, tag, link, layer within its node.

// ---- tags (every node)

/// A tag's value that points at a node (Verse: VN_TAG_LINK).
struct NodeReference {
  NodeId node = no_node;
  bool operator==(const NodeReference&) const = default;
};
using Blob = std::vector<std::uint8_t>;
using TagValue = std::variant<bool, std::uint32_t, double, std::string, Vec3, NodeReference, Blob>;

struct Tag {
  std::string name;
  TagValue value;
  bool operator==(const Tag&) const = default;
};

struct TagGroup {
  std::string name;
  std::map<PartId, Tag> tags;
  std::uint64_t revision = 0;
};

// ---- object

struct Transform {
  Vec3 position_m{0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< Unit quaternion, w first.
  glm::vec3 scale{1.0f};
  bool operator==(const Transform&) const = default;
};

struct Link {
  std::string label;            ///< "geometry", "material", "child"; see CONVENTIONS.md.
  NodeId target = no_node;      ///< May point at a node that does not exist (yet).
  std::uint32_t target_id = 0;  ///< Id of one of the target's (or of this object's) parts.
  bool operator==(const Link&) const = default;
};

struct ObjectData {
  Transform transform;  ///< parent_from_object.
  Motion
      motion;  ///< Of an object that no other links to: with legs it stands in place of `transform`, but for the scale.
  std::map<PartId, Link> links;
  bool hidden = false;
};

// ---- geometry

/// Numbered as on the wire.
enum class LayerType : std::uint8_t {
  vertex_xyz,
  vertex_integer,
  vertex_real,
  corner_integer,
  corner_real,  ///< Four values a polygon.
  face_byte,
  face_integer,
  face_real,  ///< One value a polygon.
};
inline constexpr int layer_type_count = 8;

constexpr bool is_vertex_layer(LayerType type) { return type <= LayerType::vertex_real; }
constexpr bool is_real_layer(LayerType type) {
  return type == LayerType::vertex_xyz || type == LayerType::vertex_real || type == LayerType::corner_real ||
         type == LayerType::face_real;
}
/// Values for one vertex or polygon.
constexpr std::uint32_t layer_width(LayerType type) {
  return type == LayerType::vertex_xyz                                         ? 3
         : type == LayerType::corner_integer || type == LayerType::corner_real ? 4
                                                                               : 1;
}

/// The base layers, for subscriptions; other layers have lower ids.
inline constexpr PartId base_vertex_layer = 0xFFFF;
inline constexpr PartId base_polygon_layer = 0xFFFE;

/// Named value for every vertex, corner or face. Exactly one of the two arrays is in use, of (vertices or polygons) ×
/// layer_width values.
struct GeometryLayer {
  std::string name;
  LayerType type = LayerType::vertex_real;
  std::uint32_t default_integer = 0;
  float default_real = 0.0f;
  std::vector<std::uint32_t> integers;
  std::vector<float> reals;
  std::uint64_t revision = 0;
};

/// The layer with the creases of vertices (a vertex_integer layer) or edges (a corner_integer layer, value k for the
/// edge from corner k), and the value where there is no such layer.
struct Crease {
  std::string layer;
  std::uint32_t default_value = geometry::crease_smooth;
  bool operator==(const Crease&) const = default;
};

struct GeometryData {
  std::vector<glm::vec3> vertices_m;     ///< The base vertex layer.
  std::vector<PolygonCorners> polygons;  ///< Base polygon layer; a polygon whose first corner is no_vertex is absent.
  std::map<PartId, GeometryLayer> layers;
  Crease vertex_crease, edge_crease;
  std::uint64_t shape_revision = 0;  ///< Revision of vertices_m and polygons.
};

// ---- material

struct MaterialData {
  std::map<FragmentId, Fragment> fragments;
};

// ---- bitmap

/// Numbered as on the wire.
enum class PixelType : std::uint8_t { bit, byte, word, real32, real64 };
inline constexpr int pixel_type_count = 5;
inline constexpr std::uint32_t tile_side = 8;

/// Bytes of one tile of 8 × 8 pixels: rows from the top, little-endian; eight bits a row for `bit`,
/// leftmost in the lowest bit.
constexpr std::uint32_t tile_bytes(PixelType type) {
  return type == PixelType::bit ? 8u : 64u << (static_cast<std::uint32_t>(type) - 1u);
}

struct BitmapLayer {
  std::string name;  ///< "color_r", "color_g", "color_b", "alpha", …
  PixelType type = PixelType::byte;
  /// tile_count × tile_bytes, tiles row by row, slice by slice; edge tiles are padded.
  std::vector<std::uint8_t> tiles;
  std::uint64_t revision = 0;
};

struct BitmapData {
  std::uint32_t width = 0, height = 0, depth = 1;
  std::map<PartId, BitmapLayer> layers;
};

constexpr std::uint64_t tile_columns(std::uint32_t width) { return (std::uint64_t{width} + tile_side - 1) / tile_side; }
constexpr std::uint64_t tile_count(std::uint32_t width, std::uint32_t height, std::uint32_t depth) {
  return tile_columns(width) * tile_columns(height) * depth;
}

// ---- node

using NodeData = std::variant<ObjectData, GeometryData, MaterialData, BitmapData>;

struct Node {
  NodeId id = no_node;
  std::string name;
  std::map<PartId, TagGroup> tag_groups;
  NodeData data;
  std::uint64_t revision = 0;
  /// Revision of the last change of anything that a picture may show: not of names (but a prototype's), nor of
  /// tags outside the groups of CONVENTIONS.md.
  std::uint64_t drawn_revision = 0;

  NodeType type() const { return static_cast<NodeType>(data.index()); }
};

/// True for a tag group that a picture may depend on (CONVENTIONS.md).
bool is_drawn_tag_group(std::string_view name);
/// Objects of this name's prefix are prototypes of participants (CONVENTIONS.md).
inline constexpr std::string_view prototype_prefix = "model/";

/// The value of a tag by its names, or null.
const TagValue* find_tag(const Node& node, std::string_view group, std::string_view tag);
/// The layer of that name, or null; the lowest id counts where several share it.
const GeometryLayer* find_layer(const GeometryData& geometry, std::string_view name);
const BitmapLayer* find_layer(const BitmapData& bitmap, std::string_view name);

}  // namespace septet::scene
