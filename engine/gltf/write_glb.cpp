#include "engine/gltf/write_glb.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/gltf/container.hpp"
#include "engine/gltf/written_buffer.hpp"
#include "engine/gltf/written_mesh.hpp"
#include "engine/gltf/written_motion.hpp"
#include "engine/image/png.hpp"

namespace septet::gltf {
namespace {

bool has_holes(const image::Image& picture) {
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] < 255) return true;
  return false;
}

Json written_look(const Look& look, const std::vector<Picture>& pictures, Json& extensions_used) {
  Json base = {{"baseColorFactor", {look.base_color.r, look.base_color.g, look.base_color.b, look.opacity}},
               {"metallicFactor", look.metallic},
               {"roughnessFactor", look.roughness}};
  Json material = {{"name", look.name}, {"doubleSided", look.two_sided}};
  if (look.opacity < 1.0f) material["alphaMode"] = "BLEND";
  const auto texture = [&](std::int32_t picture, std::uint32_t bit) {
    Json json = {{"index", picture}};
    if ((look.by_second_uv & bit) != 0) json["texCoord"] = 1;
    return json;
  };
  if (look.picture >= 0) {
    base["baseColorTexture"] = {{"index", look.picture}};
    if (look.opacity >= 1.0f && has_holes(pictures[static_cast<std::size_t>(look.picture)]))
      material["alphaMode"] = "MASK";
  }
  if (look.properties_picture >= 0)
    base["metallicRoughnessTexture"] = material["occlusionTexture"] =
        texture(look.properties_picture, Look::properties_bit);
  if (look.emission_picture >= 0) material["emissiveTexture"] = texture(look.emission_picture, Look::emission_bit);
  if (look.normal_picture >= 0) material["normalTexture"] = texture(look.normal_picture, Look::normal_bit);
  material["pbrMetallicRoughness"] = std::move(base);
  const float strength = std::max({look.emission.r, look.emission.g, look.emission.b});
  if (strength > 0.0f) material["emissiveFactor"] = json_list(look.emission / std::max(strength, 1.0f));
  if (strength > 1.0f) {
    constexpr const char* extension = "KHR_materials_emissive_strength";
    material["extensions"][extension] = {{"emissiveStrength", strength}};
    extensions_used = {extension};
  }
  return material;
}

Json written_sampler(const Picture& picture) {
  constexpr int nearest = 9728, linear = 9729, linear_of_two_levels = 9987, repeats = 10497, ends = 33071;
  return {{"magFilter", picture.is_sharp ? nearest : linear},
          {"minFilter", linear_of_two_levels},
          {"wrapS", picture.ends_u ? ends : repeats},
          {"wrapT", picture.ends_v ? ends : repeats}};
}

Json placed_node(const std::string& name, const RigidTransform& pose, const glm::vec3& scale) {
  const auto& turn = pose.orientation;
  return {{"name", name},
          {"translation", json_list(file_axes(glm::vec3(pose.position_m)))},
          {"rotation", {turn.y, turn.z, turn.x, turn.w}},
          {"scale", json_list(file_axes(scale))}};
}

Json written_extra(const ExtraValue& value) {
  if (const auto* list = std::get_if<glm::dvec3>(&value)) return {list->x, list->y, list->z};
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  return std::get<double>(value);
}

/// A thing that moves has a node for its motion, and one below it for its place in that.
void write_nodes(const std::vector<DrawnNode>& drawn, WrittenBuffer& buffer, Json& file) {
  Json roots = Json::array(), nodes = Json::array(), animation;
  for (const DrawnNode& node : drawn) {
    roots.push_back(nodes.size());
    if (!node.keys.empty()) {
      const PoseKey& rest = node.keys.front();
      add_written_keys(node.keys, nodes.size(), buffer, animation);
      nodes.push_back(placed_node(node.name, {Vec3(rest.position_m), Quat(rest.rotation)}, rest.scale));
      nodes.back()["children"] = {nodes.size()};
    }
    nodes.push_back(placed_node(node.name, node.model_from_node, node.scale));
    nodes.back()["mesh"] = node.mesh;
  }
  file["nodes"] = std::move(nodes);
  file["scenes"] = {{{"nodes", std::move(roots)}}};
  if (!animation.is_null()) file["animations"].push_back(std::move(animation));
}

}  // namespace

Expected<Bytes> write_glb(const Drawing& drawing, const std::string& where) {
  if (drawing.nodes.empty()) return failure("nothing of it is drawn", where, "name a thing that has a shape");
  Json file = {{"asset", {{"version", "2.0"}, {"generator", "Septet"}}}, {"scene", 0}};
  WrittenBuffer buffer;
  for (const DrawnMesh& mesh : drawing.meshes) file["meshes"].push_back(written_mesh(mesh, buffer));
  write_nodes(drawing.nodes, buffer, file);
  for (const Extra& extra : drawing.extras) file["nodes"][0]["extras"][extra.name] = written_extra(extra.value);
  Json extensions_used;
  for (const Look& look : drawing.looks)
    file["materials"].push_back(written_look(look, drawing.pictures, extensions_used));
  if (!extensions_used.is_null()) file["extensionsUsed"] = std::move(extensions_used);
  for (std::size_t i = 0; i < drawing.pictures.size(); ++i) {
    const auto png = image::encode_png(drawing.pictures[i]);
    file["images"].push_back({{"bufferView", buffer.view(png, WrittenBuffer::no_target)}, {"mimeType", "image/png"}});
    file["textures"].push_back({{"source", i}, {"sampler", i}});
    file["samplers"].push_back(written_sampler(drawing.pictures[i]));
  }
  const Bytes binary = buffer.finish(file);
  std::string text = file.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize(whole_words(text.size()), ' ');
  const std::size_t size = 12 + 8 + text.size() + 8 + binary.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    return failure(fmt::format("it has {} bytes, more than a .glb holds", size), where, "export parts of it");
  Bytes glb;
  glb.reserve(size);
  ByteWriter file_bytes(glb);
  const auto put_text = [&](std::string_view part) { file_bytes.put_bytes(std::as_bytes(std::span(part))); };
  const auto put_number = [&](std::size_t number) { file_bytes.put(static_cast<std::uint32_t>(number)); };
  put_text("glTF");  // The container: 4.4.
  put_number(2);
  put_number(size);
  put_number(text.size());
  put_text("JSON");
  put_text(text);
  put_number(binary.size());
  put_text({"BIN\0", 4});
  file_bytes.put_bytes(binary);
  return glb;
}

}  // namespace septet::gltf
