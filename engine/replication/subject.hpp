#pragma once
/// The subject of a change: the smallest unit that is sent as a whole, or a range of a layer.

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::replication {

using scene::NodeId;
using scene::PartId;

/// Listed in the order in which a node's subjects depend on each other.
enum class SubjectKind : std::uint8_t {
  existence,
  name,
  tag_group,
  tag,
  transform,
  motion,
  link,
  hide,
  geometry_size,
  crease,
  geometry_layer,
  vertices,
  polygons,
  layer_values,
  fragment,
  bitmap_size,
  bitmap_layer,
  tiles,
};

struct Subject {
  NodeId node = scene::no_node;
  SubjectKind kind = SubjectKind::existence;
  PartId part = 0;  ///< Tag group, link, layer, fragment; CreaseKind of a crease.
  PartId item = 0;  ///< Tag.
  auto operator<=>(const Subject&) const = default;
};

constexpr bool is_range(SubjectKind kind) {
  return kind == SubjectKind::vertices || kind == SubjectKind::polygons || kind == SubjectKind::layer_values ||
         kind == SubjectKind::tiles;
}

/// A change of a subject. Changes of one subject are merged while they wait.
struct Change {
  Subject subject;
  std::uint32_t first = 0, end = 0;  ///< Range of vertices, polygons or tiles.
  bool renew = false;                ///< True if destroyed (and perhaps made again) since it was last sent.
  /// Smallest sizes of a geometry since it was last sent; elements beyond them are forgotten.
  std::uint32_t smallest_vertices = ~0u, smallest_polygons = ~0u;
};

/// Change made by an applied command; empty for subscriptions.
std::optional<Change> change_of(const scene::Command& command, const scene::Store& store);

/// The number of elements of a range subject in the store now.
std::uint32_t element_count(const scene::Store& store, const Subject& subject);

/// Number of elements of a range that make about `bytes` when they are sent.
std::uint32_t elements_in(const scene::Store& store, const Subject& subject, std::size_t bytes);

/// Writes the commands that bring a client up to the store's present content of this change's subject. Ranges are cut
/// to existing elements.
void describe_change(const scene::Store& store, const Change& change,
                     const std::function<void(const scene::Command&)>& emit);

/// Enumerates the changes that bring a new subscriber up to date, by level of subscription.
using Mark = std::function<void(const Change&)>;
void mark_node(const scene::Node& node, const Mark& mark);
void mark_part(const scene::Store& store, NodeId node, scene::PartKind kind, PartId part, const Mark& mark);

}  // namespace septet::replication
