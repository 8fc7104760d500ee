#include "engine/gltf/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/animation.hpp"
#include "engine/gltf/bent_meshes.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/extras.hpp"
#include "engine/gltf/growing_part.hpp"
#include "engine/gltf/looks.hpp"
#include "engine/gltf/morph.hpp"
#include "engine/gltf/nodes.hpp"
#include "engine/gltf/passed_over.hpp"
#include "engine/gltf/primitive.hpp"
#include "engine/gltf/skin.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {
namespace {

/// Where a node's contents go.
struct Place {
  std::size_t part = 0;
  glm::mat4 part_from_parent{1.0f};  ///< Of a part with keys.
};

class Reader {
 public:
  Reader(const Container& container, const std::function<bool(std::string_view)>& begins_part)
      : container_(container), begins_part_(begins_part), nodes_(list_of(*container.json, "nodes")) {}

  Expected<Model> read() {
    if (auto known = check_required_extensions(container_); !known) return tl::unexpected(known.error());
    if (auto looks = read_looks(container_, model_); !looks) return tl::unexpected(looks.error());
    plain_look_ = static_cast<std::int64_t>(model_.looks.size()) - 1;
    growing_.emplace_back();
    auto placed = place_nodes(container_);
    if (!placed) return tl::unexpected(placed.error());
    placed_ = std::move(*placed);
    auto animations = read_animations(container_, model_.left_out);
    if (!animations) return tl::unexpected(animations.error());
    animations_ = std::move(*animations);
    bent_ = find_bent_meshes(container_, animations_, placed_);
    for (const std::int64_t root : placed_.roots)
      if (auto added = add_node(root, {}); !added) return tl::unexpected(added.error());
    finish();
    if (model_.parts.empty())
      return failure("it has no triangle in its scene", container_.where, "export what is to be seen");
    return std::move(model_);
  }

 private:
  std::string node_place(std::int64_t index) const { return fmt::format("{}, node {}", container_.where, index); }

  /// `index`: a placed node's.
  Expected<void> add_node(std::int64_t index, Place place) {
    const Json& node = nodes_[static_cast<std::size_t>(index)];
    add_extras(node, model_.extras, model_.left_out);
    chain_.push_back(index);
    const glm::mat4& model_from_node = *placed_.model_from_node[static_cast<std::size_t>(index)];
    place.part_from_parent = place.part_from_parent * parent_from_node(node);
    const std::string name = text_in(node, "name");
    const bool is_animated = animations_.move(index);
    if (!name.empty() && begins_part_(name)) {
      if (growing_.size() >= most_parts)
        return failure(fmt::format("more than {} parts begin", most_parts), node_place(index), "join some");
      if (is_animated || !growing_[place.part].part.keys.empty()) unmoved_.insert(printable(name, 80));
      place.part = growing_.size();
      growing_.emplace_back();
      growing_.back().part.name = name;
      const glm::vec3 origin = our_axes(glm::vec3(model_from_node[3]));
      if (!is_near(origin)) return far_away(index);
      growing_.back().part.origin_m = origin;
    } else if (is_animated && has_rigid_mesh(node)) {
      if (auto begun = begin_moving(index, place); !begun) return begun;
    }
    if (node.is_object() && node.contains("mesh"))
      if (auto added = add_mesh(index_in(node, "mesh"), index, model_from_node, place); !added) return added;
    for (const Json& child : list_of(node, "children"))
      if (auto added = add_node(node_index(*container_.json, child), place); !added) return added;
    chain_.pop_back();
    return {};
  }

  /// True if the node, or one below it that no animation moves itself, has a mesh that no joints place.
  bool has_rigid_mesh(const Json& node) const {
    if (node.is_object() && node.contains("mesh") && !node.contains("skin")) return true;
    const Json& children = list_of(node, "children");
    return std::ranges::any_of(children, [&](const Json& child) {
      const std::int64_t index = node_index(*container_.json, child);
      return !animations_.move(index) && has_rigid_mesh(nodes_[static_cast<std::size_t>(index)]);
    });
  }

  /// A part that moves by the animation of the last node of the chain and of those above it.
  Expected<void> begin_moving(std::int64_t node, Place& place) {
    constexpr std::size_t most_poses = 1'000'000;
    if (const std::string& role = growing_[place.part].part.name; !role.empty()) {
      unmoved_.insert(printable(role, 80));
      return {};
    }
    if (growing_.size() >= most_parts || poses_ > most_poses) {
      moves_too_much_ = true;
      place.part = 0;
      return {};
    }
    place = {growing_.size(), glm::mat4(1.0f)};
    GrowingPart& growing = growing_.emplace_back();
    growing.part.keys = keys_of_chain(container_, animations_, chain_);
    poses_ += growing.part.keys.size() * chain_.size();
    float largest = 0.0f;
    for (PoseKey& key : growing.part.keys) {
      key.position_m = our_axes(key.position_m);
      key.rotation = glm::quat(key.rotation.w, our_axes({key.rotation.x, key.rotation.y, key.rotation.z}));
      key.scale = our_axes(key.scale);
      if (!is_near(key.position_m)) return far_away(node);
      for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(key.scale[i]));
    }
    if (!(largest > 0.0f)) return {};

    // What mirrors is turned inside out once, with its triangles, and not by its keys.
    float least = 0.0f, most = 0.0f;
    for (const PoseKey& key : growing.part.keys) {
      least = std::min(least, key.scale.x * key.scale.y * key.scale.z);
      most = std::max(most, key.scale.x * key.scale.y * key.scale.z);
    }
    const bool mirrors = least < 0.0f && most <= 0.0f;
    const float size = mirrors ? -largest : largest;
    for (PoseKey& key : growing.part.keys) key.scale /= size;
    place.part_from_parent = glm::mat4(glm::mat3(size));
    return {};
  }

  tl::unexpected<Error> far_away(std::int64_t node) const {
    return failure(fmt::format("it lies further than {:.0f} m from the origin", furthest_m), node_place(node),
                   "give the model's lengths in metres and its place around the origin");
  }

  Expected<void> add_mesh(std::int64_t mesh, std::int64_t node, const glm::mat4& model_from_node, const Place& place) {
    const Json& meshes = list_of(*container_.json, "meshes");
    if (mesh < 0 || static_cast<std::uint64_t>(mesh) >= meshes.size())
      return failure(fmt::format("its mesh is none of the file's {}", meshes.size()), node_place(node), export_anew);
    const Json& json = nodes_[static_cast<std::size_t>(node)];
    const Json& mesh_json = meshes[static_cast<std::size_t>(mesh)];
    if (bent_.nodes.contains(node)) {
      const bool moves_by_name = !growing_[place.part].part.name.empty();
      if (placed_by_pose_.empty() && growing_.size() + bent_.poses > most_parts) bent_.poses = 0;
      if (!moves_by_name && bent_.poses > 1) return add_bent(mesh, node);
      (moves_by_name ? rigid_ : too_large_).insert(mesh);
    }
    MeshPose pose{nullptr, weights_of(json, mesh_json)};
    std::optional<Skin> skin;
    if (json.contains("skin")) {
      auto read = read_skin(container_, index_in(json, "skin"), placed_, node_place(node));
      if (!read) return tl::unexpected(read.error());
      skin = std::move(*read);
      pose.skin = &*skin;
    }
    const bool has_keys = !growing_[place.part].part.keys.empty();
    // The joints alone place a skinned mesh (3.7.3.3).
    const glm::mat4 model_from_mesh = skin ? glm::mat4(1.0f) : has_keys ? place.part_from_parent : model_from_node;
    return add_primitives(mesh, node, pose, model_from_mesh, skin && has_keys ? 0 : place.part, true);
  }

  /// Adds a mesh that an animation bends, once for each pose.
  Expected<void> add_bent(std::int64_t mesh, std::int64_t node) {
    if (placed_by_pose_.empty()) begin_bent();
    const Json& json = nodes_[static_cast<std::size_t>(node)];
    shown_bent_.insert(mesh);
    for (std::size_t i = 0; i < bent_.poses; ++i) {
      const double time_s = bent_pose_time_s(i, bent_.poses, double{animations_.period_s});
      MeshPose pose{nullptr, weights_at(animations_, node, time_s)};
      if (pose.weights.empty())
        pose.weights = weights_of(json, list_of(*container_.json, "meshes")[static_cast<std::size_t>(mesh)]);
      std::optional<Skin> skin;
      if (json.contains("skin")) {
        auto read = read_skin(container_, index_in(json, "skin"), placed_by_pose_[i], node_place(node));
        if (!read) return tl::unexpected(read.error());
        skin = std::move(*read);
        pose.skin = &*skin;
      }
      const glm::mat4 model_from_mesh =
          skin ? glm::mat4(1.0f) : *placed_by_pose_[i].model_from_node[static_cast<std::size_t>(node)];
      if (auto added = add_primitives(mesh, node, pose, model_from_mesh, first_bent_ + i, i == 0); !added) return added;
    }
    return {};
  }

  /// The parts of all poses, with the first mesh that has any.
  void begin_bent() {
    first_bent_ = growing_.size();
    for (std::size_t i = 0; i < bent_.poses; ++i) {
      const double period_s = double{animations_.period_s};
      placed_by_pose_.push_back(
          placed_at(container_, animations_, placed_, bent_pose_time_s(i, bent_.poses, period_s)));
      growing_.emplace_back().part.keys = keys_of_bent_pose(i, bent_.poses, period_s);
    }
  }

  /// `counts`: towards the limit of triangles, as the first of several poses does.
  Expected<void> add_primitives(std::int64_t mesh, std::int64_t node, const MeshPose& pose,
                                const glm::mat4& model_from_mesh, std::size_t part, bool counts) {
    const Json& meshes = list_of(*container_.json, "meshes");
    for (const Json& primitive : list_of(meshes[static_cast<std::size_t>(mesh)], "primitives")) {
      if (!is_of_triangles(primitive)) continue;
      const std::int64_t material = index_in(primitive, "material", plain_look_);
      if (material < 0 || material > plain_look_)
        return failure("its material is none of the file's", node_place(node), export_anew);
      const auto read = read_primitive(container_, primitive, model_.looks[static_cast<std::size_t>(material)], pose,
                                       node_place(node));
      if (!read) return tl::unexpected(read.error());
      if (counts) triangles_ += read->triangles.size();
      if (counts) vertices_ += read->positions.count + read->indices;
      if (triangles_ > most_triangles || vertices_ > 6 * most_vertices)
        return failure(fmt::format("it draws more than {} triangles", most_triangles), container_.where,
                       "make the model of fewer triangles");
      note_unmapped(*read, mesh, material);
      const bool takes_colors = has_several_colors(*read, material);
      const std::uint32_t look = takes_colors ? static_cast<std::uint32_t>(material)
                                              : look_of(static_cast<std::size_t>(material), read->colors);
      if (!add_triangles(*read, model_.looks[look], look, takes_colors, model_from_mesh, growing_[part]))
        return far_away(node);
    }
    return {};
  }

  /// Notes a material whose pictures lie by coordinates that the mesh does not have.
  void note_unmapped(const Primitive& primitive, std::int64_t mesh, std::int64_t material) {
    const Look& look = model_.looks[static_cast<std::size_t>(material)];
    if (primitive.triangles.empty() || !look.has_picture()) return;
    if (primitive.uvs.count == 0) unmapped_[{material, look.mapping.uv_set}].insert(mesh);
    if (look.by_second_uv != 0 && primitive.second_uvs.count == 0)
      unmapped_[{material, look.second_mapping.uv_set}].insert(mesh);
  }

  /// True where vertices' colours differ, and colour what is lit; their alpha is told.
  bool has_several_colors(const Primitive& primitive, std::int64_t material) {
    const Rows& colors = primitive.colors;
    const Look& look = model_.looks[static_cast<std::size_t>(material)];
    glm::vec3 least(1.0f), most(0.0f);
    constexpr float seen = 0.02f;
    for (std::size_t i = 0; i < colors.count; ++i) {
      const float* c = &colors.numbers[i * colors.width];
      least = glm::min(least, glm::vec3(c[0], c[1], c[2]));
      most = glm::max(most, glm::vec3(c[0], c[1], c[2]));
      if (colors.width > 3 && c[3] < 1.0f - seen) see_through_.insert(look.name);
    }
    const bool several = glm::any(glm::greaterThan(most - least, glm::vec3(seen)));
    if (several && look.is_unlit) many_coloured_.insert(look.name);
    return several && !look.is_unlit;
  }

  /// The material in the mean of a primitive's vertex colours, where it has some.
  std::uint32_t look_of(std::size_t material, const Rows& colours) {
    if (colours.count == 0) return static_cast<std::uint32_t>(material);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < colours.count; ++i) {
      const float* c = &colours.numbers[i * colours.width];
      sum += glm::dvec3(c[0], c[1], c[2]);
    }
    const glm::dvec3 mean = glm::clamp(sum / static_cast<double>(colours.count), 0.0, 1.0);
    // In steps of a hundredth: parts of one colour share one look.
    const auto hundredths = [](double share) { return static_cast<int>(std::lround(share * 100.0)); };
    const std::array<int, 4> key{static_cast<int>(material), hundredths(mean.x), hundredths(mean.y),
                                 hundredths(mean.z)};
    const auto [known, is_new] = coloured_.try_emplace(key, static_cast<std::uint32_t>(model_.looks.size()));
    if (is_new) {
      if (coloured_.size() > most_materials) return static_cast<std::uint32_t>(material);
      Look look = model_.looks[material];
      look.base_color *= glm::vec3(mean);
      if (look.is_unlit) look.emission *= glm::vec3(mean);
      model_.looks.push_back(std::move(look));
    }
    return std::min(known->second, static_cast<std::uint32_t>(model_.looks.size() - 1));
  }

  /// The mesh's name, or its number where it has none.
  std::string mesh_name(std::int64_t mesh) const {
    const std::string name =
        printable(text_in(list_of(*container_.json, "meshes")[static_cast<std::size_t>(mesh)], "name"), 80);
    return name.empty() ? fmt::format("mesh {}", mesh) : fmt::format("mesh \"{}\"", name);
  }

  /// One sentence a material, however many meshes it is.
  void report_unmapped() {
    for (const auto& [laid, meshes] : unmapped_)
      model_.left_out.push_back(
          fmt::format("material \"{}\" lays its picture by TEXCOORD_{}, which {}{} does not have: one colour of the "
                      "picture is seen there",
                      model_.looks[static_cast<std::size_t>(laid.first)].name, laid.second, mesh_name(*meshes.begin()),
                      meshes.size() > 1 ? fmt::format(", one of {} such meshes,", meshes.size()) : ""));
  }

  std::string those(const std::set<std::int64_t>& meshes) const {
    return mesh_name(*meshes.begin()) + (meshes.size() > 1 ? fmt::format(" (and {} more)", meshes.size() - 1) : "");
  }

  void report_unmoved() {
    if (!shown_bent_.empty())
      model_.left_out.push_back(
          fmt::format("{} is bent by joints or morph targets: it moves in {} poses, one each {:.2g} s",
                      those(shown_bent_), bent_.poses, animations_.period_s / static_cast<float>(bent_.poses)));
    if (!too_large_.empty())
      model_.left_out.push_back(
          fmt::format("{} is bent by joints or morph targets, and too large to be kept in several poses: it stands as "
                      "it does in the file",
                      those(too_large_)));
    if (!rigid_.empty())
      model_.left_out.push_back(
          fmt::format("{} is bent by joints or morph targets below a part that moves by its name: it stands as it does "
                      "in the file",
                      those(rigid_)));
    for (const std::string& name : unmoved_)
      model_.left_out.push_back(fmt::format("node \"{}\" moves by its name, and no animation moves it", name));
    if (moves_too_much_)
      model_.left_out.push_back(
          fmt::format("more than {} parts are animated: the others stand as they do in the file", most_parts));
  }

  void finish() {
    for (std::string& sentence : passed_over(container_)) model_.left_out.push_back(std::move(sentence));
    report_unmapped();
    report_unmoved();
    for (const std::string& material : many_coloured_)
      model_.left_out.push_back(fmt::format(
          "unlit material \"{}\" lies on vertices of several colours, of which the mean is drawn", material));
    for (const std::string& material : see_through_)
      model_.left_out.push_back(
          fmt::format("material \"{}\" lies on vertices with alpha of their own, which is not drawn", material));
    for (GrowingPart& growing : growing_) {
      if (growing.part.mesh.polygons.empty()) continue;
      Part part = finished(std::move(growing));
      if (part.is_there_at_first())
        for (const glm::vec3& p : part.mesh.vertices_m) {
          const glm::vec3 at = part.keys.empty() ? part.origin_m + p
                                                 : part.keys.front().position_m +
                                                       part.keys.front().rotation * (part.keys.front().scale * p);
          model_.least_m = bounded_ ? glm::min(model_.least_m, at) : at;
          model_.most_m = bounded_ ? glm::max(model_.most_m, at) : at;
          bounded_ = true;
        }
      model_.parts.push_back(std::move(part));
    }
  }

  const Container& container_;
  const std::function<bool(std::string_view)>& begins_part_;
  const Json& nodes_;
  PlacedNodes placed_;
  Animations animations_;
  std::vector<std::int64_t> chain_;  ///< From the root to the node that is read.
  std::size_t poses_ = 0;            ///< Computed of animated nodes.
  bool moves_too_much_ = false;
  BentMeshes bent_;
  std::vector<PlacedNodes> placed_by_pose_;                ///< Empty until a bent mesh is added.
  std::size_t first_bent_ = 0;                             ///< Index in `growing_` of the first pose's part.
  std::set<std::int64_t> shown_bent_, too_large_, rigid_;  ///< Bent meshes by what becomes of them.
  std::int64_t plain_look_ = 0;                            ///< Index of the look of what has no material.
  std::set<std::string> unmoved_;  ///< Parts that move by their name, and would by an animation.
  Model model_;
  std::vector<GrowingPart> growing_;
  std::map<std::array<int, 4>, std::uint32_t> coloured_;
  /// Meshes without texture coordinates of their material, by both.
  std::map<std::pair<std::int64_t, std::uint32_t>, std::set<std::int64_t>> unmapped_;
  std::set<std::string> many_coloured_, see_through_;  ///< Materials whose vertices' colours are not drawn in full.
  std::size_t triangles_ = 0, vertices_ = 0;
  bool bounded_ = false;
};

}  // namespace

glm::dvec2 PictureMapping::operator()(const glm::dvec2& uv) const {
  const glm::dvec2 scaled = scale * uv;
  const double cosine = std::cos(rotation_rad), sine = std::sin(rotation_rad);
  const glm::dvec2 turned(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x);
  return share * (offset + turned);
}

Expected<Model> read_gltf(std::string_view bytes, std::string_view where,
                          const std::function<bool(std::string_view)>& begins_part) {
  auto container = open_container(bytes, where);
  if (!container) return tl::unexpected(container.error());
  return Reader(*container, begins_part).read();
}

}  // namespace septet::gltf
