#include "engine/scene/solid_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/printable.hpp"
#include "engine/scene/drawn_object.hpp"

namespace septet::scene {
namespace {

constexpr std::size_t most_parts = 256, most_vertices = 1u << 18;

struct Bounds {
  Vec3 low_m{std::numeric_limits<double>::infinity()}, high_m{-std::numeric_limits<double>::infinity()};
  bool holds_anything() const { return low_m.x <= high_m.x; }
  void add(const Vec3& point_m) {
    low_m = glm::min(low_m, point_m);
    high_m = glm::max(high_m, point_m);
  }
};

Bounds bounds_of(const GeometryData& geometry) {
  Bounds bounds;
  for (const glm::vec3& vertex_m : geometry.vertices_m) bounds.add(Vec3(vertex_m));
  return bounds;
}

class Parts {
 public:
  Parts(const Store& store, ReadSolid& read) : store_(store), read_(read) {}

  /// Takes an object and all below it; false where they are too many.
  bool take(NodeId id, const Vec3& parent_m, const Quat& parent_turn, const Vec3& parent_scale) {
    const Node* node = note(id);
    if (!node || node->type() != NodeType::object) return true;
    if (++parts_ > most_parts || vertices_ > most_vertices) return false;
    const DrawnObject drawn = read_object(*node);
    if (drawn.hidden || path_.size() >= deepest_child || std::ranges::find(path_, id) != path_.end()) return true;
    const Vec3 origin_m = parent_m + parent_turn * (parent_scale * drawn.transform.position_m);
    const Quat turn = parent_turn * drawn.transform.rotation;
    const Vec3 scale = parent_scale * Vec3(drawn.transform.scale);
    add_geometry(drawn.geometry, origin_m, turn, scale);
    path_.push_back(id);
    bool all = true;
    for (const NodeId child : drawn.children) all = all && take(child, origin_m, turn, scale);
    path_.pop_back();
    return all && vertices_ <= most_vertices;
  }
  const Bounds& bounds() const { return bounds_; }

 private:
  const Node* note(NodeId id) {
    const Node* node = store_.find(id);
    read_.read_from.emplace_back(id, node ? node->drawn_revision : 0);
    return node;
  }
  void add_geometry(NodeId id, const Vec3& origin_m, const Quat& turn, const Vec3& scale) {
    if (id == no_node) return;
    const Node* node = note(id);
    const auto* geometry = node ? std::get_if<GeometryData>(&node->data) : nullptr;
    if (!geometry) return;
    vertices_ += geometry->vertices_m.size();
    if (vertices_ > most_vertices) return;
    const Bounds own = bounds_of(*geometry);
    if (!own.holds_anything()) return;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3 at_m((corner & 1u) != 0 ? own.high_m.x : own.low_m.x, (corner & 2u) != 0 ? own.high_m.y : own.low_m.y,
                      (corner & 4u) != 0 ? own.high_m.z : own.low_m.z);
      bounds_.add(origin_m + turn * (scale * at_m));
    }
  }

  const Store& store_;
  ReadSolid& read_;
  Bounds bounds_;
  std::vector<NodeId> path_;
  std::size_t parts_ = 0, vertices_ = 0;
};

}  // namespace

bool is_tagged_solid(const Node& node) {
  if (node.type() != NodeType::object) return false;
  const TagValue* value = find_tag(node, solid_group, solid_tag);
  const bool* solid = value ? std::get_if<bool>(value) : nullptr;
  return solid && *solid;
}

Expected<ReadSolid> read_solid(const Store& store, NodeId object) {
  const Node& node = *store.find(object);
  const std::string where = fmt::format("\"{}\"", printable(node.name));
  const DrawnObject drawn = read_object(node);
  if (drawn.prototype)
    return failure("a prototype of participants cannot be solid", where, "make an object that stands in the world");
  if (!drawn.motion.legs.empty())
    return failure("what is solid stands still, and this is in motion", where,
                   "end its motion, or take its tag body.solid away");
  ReadSolid read;
  Parts parts(store, read);
  const Vec3 ahead = drawn.transform.rotation * Vec3(1.0, 0.0, 0.0);
  SolidBox box;
  // Of what stands on end the heading is any.
  if (std::hypot(ahead.x, ahead.y) > 1e-6) box.heading_rad = std::atan2(ahead.y, ahead.x);
  const Quat world_from_upright = glm::angleAxis(box.heading_rad, Vec3(0.0, 0.0, 1.0));
  if (!parts.take(object, Vec3(0.0), glm::conjugate(world_from_upright), Vec3(1.0)))
    return failure(fmt::format("it has more than {} parts or {} vertices", most_parts, most_vertices), where,
                   "make a simpler object solid in its place");
  if (!parts.bounds().holds_anything()) return read;
  const Vec3 &low_m = parts.bounds().low_m, &high_m = parts.bounds().high_m;
  box.size_m = high_m - low_m;
  box.foot_m = world_from_upright * Vec3(0.5 * (low_m.x + high_m.x), 0.5 * (low_m.y + high_m.y), low_m.z);
  read.box = box;
  return read;
}

bool is_as_read(const Store& store, const std::vector<ReadNode>& read_from) {
  return !read_from.empty() && std::ranges::all_of(read_from, [&](const ReadNode& read) {
    const Node* node = store.find(read.first);
    return (node ? node->drawn_revision : 0) == read.second;
  });
}

std::optional<NodeId> parent_of(const Store& store, NodeId child) {
  for (const auto& [id, node] : store.nodes())
    if (const auto* data = std::get_if<ObjectData>(&node.data))
      for (const auto& [link_id, link] : data->links)
        if (link.label == "child" && link.target == child) return id;
  return std::nullopt;
}

}  // namespace septet::scene
