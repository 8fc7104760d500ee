#pragma once
/// The node commands: all changes of a store, and all content of replication.
///
/// Symmetrical (Brink, Steenberg and Svensson 2006, §2.2.2): the same struct requests a change and announces it, and a
/// first value looks exactly like a later change of it (§2.2.4). Their bytes are specified in COMMANDS.md and made by
/// command_codec.hpp. "Set" creates an absent object; "Destroy" of an absent one does nothing.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/node.hpp"

namespace septet::scene {

// ---- subscriptions: from a client; they do not change a store

/// Subscribes to the index of nodes of these types; bit k is NodeType k. Zero ends the subscription.
struct NodeIndexSubscribe {
  std::uint32_t type_mask = 0;
  bool operator==(const NodeIndexSubscribe&) const = default;
};

/// Subscribes to the node's own content, and to the list of its subscribable parts (tag groups, layers).
struct NodeSubscribe {
  NodeId node = no_node;
  bool subscribe = true;
  bool operator==(const NodeSubscribe&) const = default;
};

/// Kinds of subscribable parts. Numbered as on the wire.
enum class PartKind : std::uint8_t { tag_group, layer };

/// Subscribes to the content of one part.
struct PartSubscribe {
  NodeId node = no_node;
  PartKind kind = PartKind::tag_group;
  PartId part = 0;
  bool subscribe = true;
  bool operator==(const PartSubscribe&) const = default;
};

// ---- every node

/// Creation of a node: `no_node` as a request; the server assigns an id (Store::assign_id).
struct NodeCreate {
  NodeId node = no_node;
  NodeType type = NodeType::object;
  bool operator==(const NodeCreate&) const = default;
};
struct NodeDestroy {
  NodeId node = no_node;
  bool operator==(const NodeDestroy&) const = default;
};
struct NodeNameSet {
  NodeId node = no_node;
  std::string name;
  bool operator==(const NodeNameSet&) const = default;
};
struct TagGroupSet {
  NodeId node = no_node;
  PartId group = 0;
  std::string name;
  bool operator==(const TagGroupSet&) const = default;
};
struct TagGroupDestroy {
  NodeId node = no_node;
  PartId group = 0;
  bool operator==(const TagGroupDestroy&) const = default;
};
struct TagSet {
  NodeId node = no_node;
  PartId group = 0;
  PartId tag = 0;
  Tag value;
  bool operator==(const TagSet&) const = default;
};
struct TagDestroy {
  NodeId node = no_node;
  PartId group = 0;
  PartId tag = 0;
  bool operator==(const TagDestroy&) const = default;
};

// ---- object

struct TransformSet {
  NodeId node = no_node;
  Transform transform;
  bool operator==(const TransformSet&) const = default;
};
struct LinkSet {
  NodeId node = no_node;
  PartId link = 0;
  Link value;
  bool operator==(const LinkSet&) const = default;
};
struct LinkDestroy {
  NodeId node = no_node;
  PartId link = 0;
  bool operator==(const LinkDestroy&) const = default;
};
/// `legs` empty: the motion ends, and the object stands at its transform.
struct MotionSet {
  NodeId node = no_node;
  Motion motion;
  /// Of a request: times count from the tick at which it is done, and it begins where the object is then. The server
  /// puts the true ones in their place.
  bool from_now = false;
  bool operator==(const MotionSet&) const = default;
};
struct HideSet {
  NodeId node = no_node;
  bool hidden = false;
  bool operator==(const HideSet&) const = default;
};

// ---- geometry

/// Grows or cuts the arrays; new elements are vertices at the origin, absent polygons, layers at their default.
struct GeometrySizeSet {
  NodeId node = no_node;
  std::uint32_t vertices = 0;
  std::uint32_t polygons = 0;
  bool operator==(const GeometrySizeSet&) const = default;
};
/// Creates a layer with every value at the default; renames an existing one, or makes it anew if its type differs.
struct GeometryLayerSet {
  NodeId node = no_node;
  PartId layer = 0;
  std::string name;
  LayerType type = LayerType::vertex_real;
  std::uint32_t default_integer = 0;
  float default_real = 0.0f;
  bool operator==(const GeometryLayerSet&) const = default;
};
struct GeometryLayerDestroy {
  NodeId node = no_node;
  PartId layer = 0;
  bool operator==(const GeometryLayerDestroy&) const = default;
};
/// Runs of many values, so that a big mesh is few messages; the range must lie within the geometry's size.
struct VerticesSet {
  NodeId node = no_node;
  std::uint32_t first = 0;
  std::vector<glm::vec3> positions_m;
  bool operator==(const VerticesSet&) const = default;
};
struct PolygonsSet {
  NodeId node = no_node;
  std::uint32_t first = 0;
  std::vector<PolygonCorners> polygons;
  bool operator==(const PolygonsSet&) const = default;
};
/// `first` counts vertices or polygons; values.size() is a multiple of the layer's width.
struct LayerIntegersSet {
  NodeId node = no_node;
  PartId layer = 0;
  std::uint32_t first = 0;
  std::vector<std::uint32_t> values;
  bool operator==(const LayerIntegersSet&) const = default;
};
struct LayerRealsSet {
  NodeId node = no_node;
  PartId layer = 0;
  std::uint32_t first = 0;
  std::vector<float> values;
  bool operator==(const LayerRealsSet&) const = default;
};
/// Numbered as on the wire.
enum class CreaseKind : std::uint8_t { vertex, edge };
struct CreaseSet {
  NodeId node = no_node;
  CreaseKind kind = CreaseKind::vertex;
  Crease crease;
  bool operator==(const CreaseSet&) const = default;
};

// ---- material

struct FragmentSet {
  NodeId node = no_node;
  FragmentId fragment = 0;
  Fragment value;
  bool operator==(const FragmentSet&) const = default;
};
struct FragmentDestroy {
  NodeId node = no_node;
  FragmentId fragment = 0;
  bool operator==(const FragmentDestroy&) const = default;
};

// ---- bitmap

/// Every layer is cleared to zero.
struct BitmapSizeSet {
  NodeId node = no_node;
  std::uint32_t width = 0, height = 0, depth = 1;
  bool operator==(const BitmapSizeSet&) const = default;
};
/// Creates a layer of zeros; renames an existing one, or makes it anew if its type differs.
struct BitmapLayerSet {
  NodeId node = no_node;
  PartId layer = 0;
  std::string name;
  PixelType type = PixelType::byte;
  bool operator==(const BitmapLayerSet&) const = default;
};
struct BitmapLayerDestroy {
  NodeId node = no_node;
  PartId layer = 0;
  bool operator==(const BitmapLayerDestroy&) const = default;
};
/// Whole tiles; tiles.size() is a multiple of tile_bytes of the layer's type.
struct BitmapTilesSet {
  NodeId node = no_node;
  PartId layer = 0;
  std::uint32_t first_tile = 0;
  std::vector<std::uint8_t> tiles;
  bool operator==(const BitmapTilesSet&) const = default;
};

/// In the order of their opcodes (COMMANDS.md): new commands go at the end.
using Command = std::variant<NodeIndexSubscribe, NodeSubscribe, PartSubscribe, NodeCreate, NodeDestroy, NodeNameSet,
                             TagGroupSet, TagGroupDestroy, TagSet, TagDestroy, TransformSet, LinkSet, LinkDestroy,
                             HideSet, GeometrySizeSet, GeometryLayerSet, GeometryLayerDestroy, VerticesSet, PolygonsSet,
                             LayerIntegersSet, LayerRealsSet, CreaseSet, FragmentSet, FragmentDestroy, BitmapSizeSet,
                             BitmapLayerSet, BitmapLayerDestroy, BitmapTilesSet, MotionSet>;

/// "vertices set", for messages and logs.
std::string_view name_of(const Command& command);

}  // namespace septet::scene
