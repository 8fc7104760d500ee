#include "engine/scenery/own_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/math/pose_keys.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/scene/part_role.hpp"

namespace septet::scenery {
namespace {

constexpr std::array<std::string_view, 12> things{"oak",        "birch",      "spruce",      "bush",
                                                  "red-farm",   "white-farm", "church",      "cottage",
                                                  "town-house", "town-block", "street-lamp", "sign-post"};

/// Removes the number that modelling programs append to equal names: "wheel_front_left.001" is a wheel.
std::string_view without_number(std::string_view name) { return name.substr(0, name.find('.')); }

/// The looks that its parts wear, with their pictures; in the places of others no_node.
Palette add_looks(scene::SceneBuilder& builder, std::string_view name, const gltf::Model& model) {
  std::vector<scene::NodeId> pictures(model.pictures.size(), scene::no_node);
  const auto bitmap = [&](std::int32_t index) {
    if (index < 0) return scene::no_node;
    scene::NodeId& made = pictures[static_cast<std::size_t>(index)];
    const gltf::Picture& picture = model.pictures[static_cast<std::size_t>(index)];
    if (made == scene::no_node)
      made = builder.add_bitmap(fmt::format("{} picture", name), picture.width, picture.height, picture.rgba,
                                !picture.is_linear, {picture.ends_u, picture.ends_v, picture.is_sharp});
    return made;
  };
  std::vector<bool> is_worn(model.looks.size());
  for (const gltf::Part& part : model.parts) {
    for (const std::uint32_t look : part.mesh.polygon_materials) is_worn.at(look) = true;
    if (part.mesh.polygon_materials.empty() && !is_worn.empty()) is_worn[0] = true;
  }
  Palette palette;
  for (std::size_t i = 0; i < model.looks.size(); ++i) {
    const gltf::Look& look = model.looks[i];
    palette.push_back(scene::no_node);
    if (!is_worn[i]) continue;
    scene::MaterialParameters material;
    material.base_color = look.base_color;
    material.base_color_bitmap = bitmap(look.picture);
    using scene::SurfaceMap;
    material.maps[SurfaceMap::emission] = bitmap(look.emission_picture);
    material.maps[SurfaceMap::properties] = bitmap(look.properties_picture);
    material.maps[SurfaceMap::normal] = bitmap(look.normal_picture);
    material.by_second_uv = look.by_second_uv;
    material.roughness = std::max(look.roughness, 0.05f);
    material.metallic = look.metallic;
    // Just see-through enough that alpha is an opacity.
    material.opacity = look.alpha_blends ? std::min(look.opacity, scene::opaque_from - 0.001f) : look.opacity;
    material.emission = look.emission;
    material.two_sided = look.two_sided;
    material.takes_paint = without_number(look.name) == "paint";
    palette.back() = builder.add_material(fmt::format("{}/{}", name, look.name), material);
  }
  return palette;
}

/// The keys of a part whose model is placed as a whole; empty for one that moves by a role or stands.
std::vector<PoseKey> keys_of(const gltf::Part& part, const Placement& placement) {
  std::vector<PoseKey> keys = part.keys;
  const scene::ScaledPose model{placement.parent_from_object, placement.scale};
  for (PoseKey& key : keys) {
    const auto placed = scene::child_of(model, {Vec3(key.position_m), Quat(key.rotation)}, key.scale);
    key = {key.at_s, glm::vec3(placed.pose.position_m), glm::quat(placed.pose.orientation), placed.scale};
  }
  return keys;
}

void add_keys(scene::SceneBuilder& builder, scene::NodeId object, const std::vector<PoseKey>& keys) {
  if (keys.empty()) return;
  // Of the group "draw", beside the tags of add_object.
  constexpr scene::PartId group = 0, first_tag = 16;
  builder.apply(scene::TagGroupSet{object, group, "draw"});
  scene::PartId id = first_tag;
  for (scene::Tag& tag : scene::tags_of_keys(keys)) builder.apply(scene::TagSet{object, group, id++, std::move(tag)});
}

}  // namespace

std::span<const std::string_view> replaceable_things() { return things; }

bool is_replaceable(std::string_view name) {
  return find_vehicle_model(name).has_value() || std::ranges::find(things, name) != things.end();
}

bool begins_own_part(std::string_view node_name) {
  return scene::part_role(without_number(node_name)) != scene::PartRole::fixed;
}

Expected<gltf::Model> read_own_model(const std::filesystem::path& file) {
  const auto bytes = read_regular_file(file, gltf::largest_file_bytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return gltf::read_gltf(*bytes, printable(file.string()), begins_own_part);
}

glm::dvec3 vehicle_from_own_model_m(const gltf::Model& own, const VehicleModel& vehicle) {
  const glm::dvec3 middle = 0.5 * (glm::dvec3(own.least_m) + glm::dvec3(own.most_m));
  return {vehicle.centre_x_m() - middle.x, -middle.y, 0.0};
}

std::optional<std::string> size_differs(const gltf::Model& own, const VehicleModel& vehicle) {
  const glm::dvec3 size = glm::dvec3(own.most_m - own.least_m);
  const glm::dvec3 wanted(vehicle.length_m, vehicle.width_m, vehicle.height_m);
  const auto differs = [](double a, double b) { return std::abs(a - b) > 0.1 * b + 0.05; };
  if (!differs(size.x, wanted.x) && !differs(size.y, wanted.y) && !differs(own.most_m.z, wanted.z)) return std::nullopt;
  return fmt::format(
      "it is {:.2f} m long, {:.2f} m wide and {:.2f} m high, and {} is {:.2f}, {:.2f} and {:.2f}: traffic keeps clear "
      "of that box, "
      "and what is drawn is another",
      size.x, size.y, own.most_m.z, vehicle.name, wanted.x, wanted.y, wanted.z);
}

const gltf::Model* OwnShapes::find(std::string_view name) const {
  if (!models_) return nullptr;
  const auto found = models_->find(name);
  return found == models_->end() ? nullptr : &found->second;
}

const std::vector<Shape>& OwnShapes::shapes_of(std::string_view name, const gltf::Model& model) {
  if (const auto known = shapes_.find(name); known != shapes_.end()) return known->second;
  const Palette palette = add_looks(builder_, name, model);
  std::vector<Shape> shapes;
  for (const gltf::Part& part : model.parts)
    shapes.push_back(add_shape(builder_, fmt::format("{}/shape", name), part.mesh, palette));
  return shapes_.emplace(name, std::move(shapes)).first->second;
}

bool OwnShapes::place(std::string_view name, const Placement& placement, scene::NodeId parent) {
  const gltf::Model* model = find(name);
  if (!model) return false;
  const std::vector<Shape>& shapes = shapes_of(name, *model);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const gltf::Part& part = model->parts[i];
    Placement placed = placement;
    placed.parent_from_object.position_m = placement.parent_from_object * Vec3(part.origin_m * placement.scale);
    placed.role = part.name.empty() ? scene::PartRole::fixed : scene::part_role(without_number(part.name));
    const std::vector<PoseKey> keys = keys_of(part, placement);
    if (!keys.empty()) {
      const PoseKey& rest = keys.front();
      placed.parent_from_object = {Vec3(rest.position_m), Quat(rest.rotation)};
      placed.scale = rest.scale;
    }
    add_keys(builder_, scenery::place(builder_, name, shapes[i], placed, parent), keys);
  }
  return true;
}

}  // namespace septet::scenery
