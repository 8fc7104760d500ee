#include "engine/editor/shapes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "engine/image/font.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/model_size.hpp"
#include "engine/scenery/own_models.hpp"

namespace septet::editor {
namespace {

/// What a builder does in a store of its own, whose next id is `first`.
Made built(scene::NodeId first, const std::function<void(scene::SceneBuilder&)>& build) {
  scene::Store store;
  Made made{{}, first};
  (void)store.apply(scene::NodeCreate{first - 1, scene::NodeType::object});
  scene::SceneBuilder builder(store, [&](const scene::Command& command) { made.commands.push_back(command); });
  build(builder);
  made.next = store.assign_id();
  return made;
}

/// An author's properties as tags of the group "extras".
void add_tags(scene::SceneBuilder& builder, scene::NodeId object, const std::vector<gltf::Extra>& extras) {
  constexpr scene::PartId group = 7;
  if (!extras.empty()) builder.apply(scene::TagGroupSet{object, group, "extras"});
  scene::PartId id = 0;
  for (const gltf::Extra& extra : extras)
    builder.apply(
        scene::TagSet{object,
                      group,
                      id++,
                      {extra.name, std::visit([](const auto& value) { return scene::TagValue(value); }, extra.value)}});
}

/// A link by which an object wears a material.
struct Worn {
  scene::NodeId object = scene::no_node;
  scene::PartId link = 0;
  std::uint32_t index = 0;  ///< Of the material in the object's geometry.
};

/// The links of an object and of those below it, each object's of the first index first.
void find_worn(const scene::Store& store, scene::NodeId id, std::set<scene::NodeId>& seen, std::vector<Worn>& worn) {
  const scene::Node* node = store.find(id);
  const auto* object = node ? std::get_if<scene::ObjectData>(&node->data) : nullptr;
  if (!object || !seen.insert(id).second) return;
  const auto first = static_cast<std::ptrdiff_t>(worn.size());
  for (const auto& [link_id, link] : object->links)
    if (link.label == "material") worn.push_back({id, link_id, link.target_id});
  std::stable_sort(worn.begin() + first, worn.end(), [](const Worn& a, const Worn& b) { return a.index < b.index; });
  for (const auto& [link_id, link] : object->links)
    if (link.label == "child") find_worn(store, link.target, seen, worn);
}

std::vector<Worn> worn_by(const scene::Store& store, scene::NodeId object) {
  std::vector<Worn> worn;
  std::set<scene::NodeId> seen;
  find_worn(store, object, seen, worn);
  // One of the same batch: a board, whose first link is to its geometry.
  if (worn.empty()) worn.push_back({object, 1, 0});
  return worn;
}

void wear(Made& made, const Worn& worn, scene::NodeId material) {
  made.commands.emplace_back(scene::LinkSet{worn.object, worn.link, {"material", material, worn.index}});
}

}  // namespace

Expected<Made> make_model(const std::string& name, const std::filesystem::path& file, const scene::Transform& transform,
                          scene::NodeId first) {
  auto model = scenery::read_own_model(file);
  if (!model) return tl::unexpected(model.error());
  std::vector<std::string> told{scenery::told_size(*model)};
  if (const auto doubt = scenery::doubted_size(*model))
    told.push_back(fmt::format("{}; {}", doubt->what, doubt->remedy));
  told.insert(told.end(), model->left_out.begin(), model->left_out.end());
  const std::vector<gltf::Extra> extras = std::move(model->extras);
  // A name of the scene holds both this one and the look's.
  for (gltf::Look& look : model->looks) look.name.resize(std::min<std::size_t>(look.name.size(), 50));
  scenery::OwnModels models;
  // The object's name is the root's alone.
  const std::string part = name + "/part";
  models.emplace(part, std::move(*model));
  Made made = built(first, [&](scene::SceneBuilder& builder) {
    const scene::NodeId root = builder.add_object(name, {});
    builder.apply(scene::TransformSet{root, transform});
    add_tags(builder, root, extras);
    scenery::OwnShapes(builder, &models).place(part, {}, root);
  });
  made.messages = std::move(told);
  return made;
}

Made make_board(const std::string& name, double width_m, double height_m, const scene::Transform& transform,
                scene::NodeId first) {
  return built(first, [&](scene::SceneBuilder& builder) {
    const auto half = static_cast<float>(width_m / 2), up = static_cast<float>(height_m / 2);
    geometry::PolygonMesh mesh;
    mesh.vertices_m = {{0, -half, -up}, {0, half, -up}, {0, half, up}, {0, -half, up}};
    mesh.polygons.push_back({0, 1, 2, 3});
    mesh.corner_uvs.push_back({glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)});
    scene::MaterialParameters white;
    white.two_sided = true;
    const scene::NodeId shape = builder.add_mesh(name, mesh), material = builder.add_material(name, white);
    const scene::NodeId board = builder.add_object(name, {.geometry = shape, .materials = {material}});
    builder.apply(scene::TransformSet{board, transform});
  });
}

Made make_picture(const scene::Store& store, scene::NodeId object, const image::Image& picture, scene::NodeId first) {
  scene::NodeId material = scene::no_node;
  Made made = built(first, [&](scene::SceneBuilder& builder) {
    scene::MaterialParameters look;
    look.base_color = glm::vec3(0.85f);
    look.base_color_bitmap = builder.add_bitmap("", picture.width, picture.height, picture.rgba);
    look.two_sided = true;
    material = builder.add_material("", look);
  });
  wear(made, worn_by(store, object).front(), material);
  return made;
}

Made make_colour(const scene::Store& store, scene::NodeId object, glm::vec3 linear_rgb, scene::NodeId first) {
  scene::NodeId material = scene::no_node;
  Made made = built(first, [&](scene::SceneBuilder& builder) {
    scene::MaterialParameters look;
    look.base_color = linear_rgb;
    look.two_sided = true;
    material = builder.add_material("", look);
  });
  for (const Worn& worn : worn_by(store, object)) wear(made, worn, material);
  return made;
}

Expected<image::Image> painted_text(const std::string& text, image::Color ink, image::Color ground) {
  const auto font = image::Font::find(image::FontStyle::bold);
  if (!font) return tl::unexpected(font.error());
  constexpr double height_px = 256.0, margin_px = 24.0, most_px = 4.0 * height_px;
  double size_px = 180.0;
  if (const double width_px = font->width_px(text, size_px); width_px > most_px) size_px *= most_px / width_px;
  const double width_px = font->width_px(text, size_px) + 2.0 * margin_px;
  image::Image picture(static_cast<std::uint32_t>(std::clamp(width_px, height_px, most_px + 2.0 * margin_px)),
                       static_cast<std::uint32_t>(height_px), ground);
  font->draw_centred(picture, 0.5 * picture.width, 0.5 * (height_px + font->capital_height_px(size_px)), text, size_px,
                     ink);
  return picture;
}

}  // namespace septet::editor
