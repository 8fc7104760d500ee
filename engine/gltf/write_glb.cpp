#include "engine/gltf/write_glb.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "engine/gltf/container.hpp"
#include "engine/image/png.hpp"

namespace septet::gltf {
namespace {

/// Numbers of the format (3.6.2.2, 3.6.1.2 and 5.18.2).
constexpr int float_numbers = 5126, unsigned_int_numbers = 5125, vertex_data = 34962, index_data = 34963;

glm::vec3 file_axes(const glm::vec3& v) { return {v.y, v.z, v.x}; }
Json list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Chunks and views begin at multiples of four bytes.
std::size_t whole_words(std::size_t size) { return (size + 3) / 4 * 4; }

/// The binary chunk, and what the file says of it.
class Buffer {
 public:
  template <class Value>
  std::size_t view(const std::vector<Value>& values, int target) {
    return view(std::as_bytes(std::span(values)), target);
  }
  std::size_t view(std::span<const std::byte> values, int target = 0) {
    bytes_.resize(whole_words(bytes_.size()));
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size()}};
    if (target != 0) view["target"] = target;
    ByteWriter(bytes_).put_bytes(values);
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }
  std::size_t accessor(std::size_t view, int numbers, std::size_t count, const char* type, std::size_t offset = 0) {
    accessors_.push_back({{"bufferView", view}, {"componentType", numbers}, {"count", count}, {"type", type}});
    if (offset > 0) accessors_.back()["byteOffset"] = offset;
    return accessors_.size() - 1;
  }
  Json& last_accessor() { return accessors_.back(); }
  Bytes finish(Json& file) {
    bytes_.resize(whole_words(bytes_.size()));
    file["buffers"] = {{{"byteLength", bytes_.size()}}};
    file["bufferViews"] = std::move(views_);
    file["accessors"] = std::move(accessors_);
    return std::move(bytes_);
  }

 private:
  Bytes bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

Json written_mesh(const DrawnMesh& mesh, Buffer& buffer) {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  positions.reserve(mesh.vertices.size());
  normals.reserve(mesh.vertices.size());
  uvs.reserve(mesh.vertices.size());
  glm::vec3 least(std::numeric_limits<float>::max()), most(std::numeric_limits<float>::lowest());
  for (const DrawnVertex& vertex : mesh.vertices) {
    positions.push_back(file_axes(vertex.position_m));
    least = glm::min(least, positions.back());
    most = glm::max(most, positions.back());
    const float length = glm::length(vertex.normal);
    normals.push_back(length > 0.0f ? file_axes(vertex.normal) / length : glm::vec3(0.0f, 1.0f, 0.0f));
    uvs.push_back(vertex.uv);
  }
  const std::size_t count = mesh.vertices.size();
  const std::size_t position = buffer.accessor(buffer.view(positions, vertex_data), float_numbers, count, "VEC3");
  buffer.last_accessor()["min"] = list(least);
  buffer.last_accessor()["max"] = list(most);
  const Json attributes = {
      {"POSITION", position},
      {"NORMAL", buffer.accessor(buffer.view(normals, vertex_data), float_numbers, count, "VEC3")},
      {"TEXCOORD_0", buffer.accessor(buffer.view(uvs, vertex_data), float_numbers, count, "VEC2")}};
  const std::size_t indices = buffer.view(mesh.indices, index_data);
  Json primitives = Json::array();
  for (const DrawnRun& run : mesh.runs)
    primitives.push_back({{"attributes", attributes},
                          {"indices", buffer.accessor(indices, unsigned_int_numbers, run.index_count, "SCALAR",
                                                      sizeof(std::uint32_t) * run.first_index)},
                          {"material", run.look}});
  return {{"primitives", std::move(primitives)}};
}

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
  if (look.picture >= 0) {
    base["baseColorTexture"] = {{"index", look.picture}};
    if (look.opacity >= 1.0f && has_holes(pictures[static_cast<std::size_t>(look.picture)]))
      material["alphaMode"] = "MASK";
  }
  if (look.properties_picture >= 0) {
    base["metallicRoughnessTexture"] = {{"index", look.properties_picture}};
    material["occlusionTexture"] = {{"index", look.properties_picture}};
  }
  if (look.emission_picture >= 0) material["emissiveTexture"] = {{"index", look.emission_picture}};
  if (look.normal_picture >= 0) material["normalTexture"] = {{"index", look.normal_picture}};
  material["pbrMetallicRoughness"] = std::move(base);
  const float strength = std::max({look.emission.r, look.emission.g, look.emission.b});
  if (strength > 0.0f) material["emissiveFactor"] = list(look.emission / std::max(strength, 1.0f));
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

}  // namespace

Expected<Bytes> write_glb(const Drawing& drawing, const std::string& where) {
  if (drawing.nodes.empty()) return failure("nothing of it is drawn", where, "name a thing that has a shape");
  Json file = {{"asset", {{"version", "2.0"}, {"generator", "Septet"}}}, {"scene", 0}};
  Buffer buffer;
  for (const DrawnMesh& mesh : drawing.meshes) file["meshes"].push_back(written_mesh(mesh, buffer));
  Json roots = Json::array();
  for (const DrawnNode& node : drawing.nodes) {
    const glm::vec3 place = file_axes(glm::vec3(node.model_from_node.position_m));
    const auto& turn = node.model_from_node.orientation;
    roots.push_back(roots.size());
    file["nodes"].push_back({{"name", node.name},
                             {"mesh", node.mesh},
                             {"translation", list(place)},
                             {"rotation", {turn.y, turn.z, turn.x, turn.w}},
                             {"scale", list(file_axes(node.scale))}});
  }
  file["scenes"] = {{{"nodes", std::move(roots)}}};
  Json extensions_used;
  for (const Look& look : drawing.looks)
    file["materials"].push_back(written_look(look, drawing.pictures, extensions_used));
  if (!extensions_used.is_null()) file["extensionsUsed"] = std::move(extensions_used);
  for (std::size_t i = 0; i < drawing.pictures.size(); ++i) {
    const auto png = image::encode_png(drawing.pictures[i]);
    file["images"].push_back({{"bufferView", buffer.view(std::as_bytes(std::span(png)))}, {"mimeType", "image/png"}});
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
