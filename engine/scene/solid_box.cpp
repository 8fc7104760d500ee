#include "engine/scene/solid_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

/// What a thing reaches as it turns about the x axis, and about any.
struct Reach {
  double from_axis_m = 0.0, from_origin_m = 0.0;
  void add(const Vec3& point_m) {
    from_axis_m = std::max(from_axis_m, std::hypot(point_m.y, point_m.z));
    from_origin_m = std::max(from_origin_m, glm::length(point_m));
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

  /// Takes an object and all below it, from its origin, turned by `turn`; false where they are too many.
  bool take_root(NodeId id, const Quat& turn) {
    const DrawnObject drawn = read_object(*note(id));
    return drawn.hidden || add(id, drawn, Vec3(0.0), turn, Vec3(drawn.transform.scale));
  }
  const Bounds& bounds() const { return bounds_; }
  const Reach& reach() const { return reach_; }

 private:
  bool take(NodeId id, const Vec3& parent_m, const Quat& parent_turn, const Vec3& parent_scale) {
    const Node* node = note(id);
    if (!node || node->type() != NodeType::object) return true;
    const DrawnObject drawn = read_object(*node);
    if (drawn.hidden || path_.size() >= deepest_child || std::ranges::find(path_, id) != path_.end()) return true;
    const Vec3 origin_m = parent_m + parent_turn * (parent_scale * drawn.transform.position_m);
    return add(id, drawn, origin_m, parent_turn * drawn.transform.rotation, parent_scale * Vec3(drawn.transform.scale));
  }
  bool add(NodeId id, const DrawnObject& drawn, const Vec3& origin_m, const Quat& turn, const Vec3& scale) {
    if (++parts_ > most_parts || vertices_ > most_vertices) return false;
    add_geometry(drawn.geometry, origin_m, turn, scale);
    path_.push_back(id);
    bool all = true;
    for (const NodeId child : drawn.children) all = all && take(child, origin_m, turn, scale);
    path_.pop_back();
    return all && vertices_ <= most_vertices;
  }
  const Node* note(NodeId id) {
    const Node* node = store_.find(id);
    read_.read_from.emplace_back(id, node ? node->drawn_revision : 0);
    return node;
  }
  void add_geometry(NodeId id, const Vec3& origin_m, const Quat& turn, const Vec3& scale) {
    if (id == no_node || scale == Vec3(0.0)) return;
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
    for (const glm::vec3& vertex_m : geometry->vertices_m) reach_.add(origin_m + turn * (scale * Vec3(vertex_m)));
  }

  const Store& store_;
  ReadSolid& read_;
  Bounds bounds_;
  Reach reach_;
  std::vector<NodeId> path_;
  std::size_t parts_ = 0, vertices_ = 0;
};

/// In the frame of a box, whose x axis is what a rolling thing turns about.
Bounds swept(Bounds bounds, const Reach& reach, Turning turning) {
  if (turning == Turning::upright) return bounds;
  const double radius_m = turning == Turning::rolling ? reach.from_axis_m : reach.from_origin_m;
  const double low_x_m = bounds.low_m.x, high_x_m = bounds.high_m.x;
  bounds = {Vec3(-radius_m), Vec3(radius_m)};
  if (turning == Turning::rolling) bounds.low_m.x = low_x_m, bounds.high_m.x = high_x_m;
  return bounds;
}

Expected<std::optional<double>> read_mass(const Node& node, const std::string& where) {
  const TagValue* value = find_tag(node, solid_group, mass_tag);
  if (!value) return std::nullopt;
  const double* mass_kg = std::get_if<double>(value);
  if (mass_kg && *mass_kg >= lightest_solid_kg && *mass_kg <= heaviest_solid_kg) return *mass_kg;
  return failure(
      fmt::format("the mass of a solid is a number from {:g} to {:g} kg", lightest_solid_kg, heaviest_solid_kg), where,
      "give its tag body.mass_kg such a number, or take the tag away: it then stands fast");
}

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
  ReadSolid read;
  auto mass_kg = read_mass(node, where);
  if (!mass_kg) return tl::unexpected(mass_kg.error());
  read.mass_kg = *mass_kg;
  const bool is_placed = drawn.motion.legs.empty() && !drawn.box;  // By its transform alone.
  read.about_m = is_placed ? drawn.transform.position_m : drawn.motion.position_m;
  const Quat rotation = is_placed ? drawn.transform.rotation : drawn.motion.rotation;
  const double heading_rad = box_heading_rad(rotation, drawn.motion);
  const Quat world_from_upright = glm::angleAxis(heading_rad, Vec3(0.0, 0.0, 1.0));
  Parts parts(store, read);
  if (!parts.take_root(object, glm::conjugate(world_from_upright) * rotation))
    return failure(fmt::format("it has more than {} parts or {} vertices", most_parts, most_vertices), where,
                   "make a simpler object solid in its place");
  if (!parts.bounds().holds_anything()) return read;
  const Turning turning = turning_of(drawn.motion);
  const Bounds bounds = swept(parts.bounds(), parts.reach(), turning);
  const Vec3 &low_m = bounds.low_m, &high_m = bounds.high_m;
  const Vec3 foot_m(0.5 * (low_m.x + high_m.x), 0.5 * (low_m.y + high_m.y), low_m.z);
  read.box = SolidBox{read.about_m + world_from_upright * foot_m, heading_rad, high_m - low_m};
  read.legs = drawn.motion.legs;
  if (turning != Turning::upright)
    for (MotionLeg& leg : read.legs) leg.turn_radps = Vec3(0.0);
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
