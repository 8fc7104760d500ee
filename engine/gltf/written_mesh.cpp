#include "engine/gltf/written_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace septet::gltf {
namespace {

constexpr std::uint32_t white_color = 0xFFFFFFFFu;

/// A unit vector, as the format wants it, that is packed to the same code again.
glm::vec4 written_tangent(std::uint32_t code) {
  const glm::vec4 packed = glm::unpackSnorm4x8(code);
  constexpr float half_step = 0.49f / 127.0f;
  glm::vec3 along(packed);
  for (int turn = 0; turn < 16 && glm::length(along) > 0.0f; ++turn) {
    along = glm::normalize(along);
    if (glm::packSnorm4x8(glm::vec4(along, packed.w)) == code) break;
    along = glm::clamp(along, glm::vec3(packed) - half_step, glm::vec3(packed) + half_step);
  }
  const float length = glm::length(along);
  return {file_axes(length > 0.0f ? along / length : glm::vec3(1.0f, 0.0f, 0.0f)), packed.w < 0.0f ? -1.0f : 1.0f};
}

template <class Value>
std::size_t written_rows(const std::vector<Value>& rows, const char* type, WrittenBuffer& buffer) {
  return buffer.accessor({.view = buffer.view(rows, WrittenBuffer::vertex_data),
                          .numbers = WrittenBuffer::floats,
                          .count = rows.size(),
                          .type = type});
}

}  // namespace

Json written_mesh(const DrawnMesh& mesh, WrittenBuffer& buffer) {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs, second_uvs;
  std::vector<glm::vec4> tangents;
  std::vector<std::uint32_t> colors;
  glm::vec3 least(std::numeric_limits<float>::max()), most(std::numeric_limits<float>::lowest());
  bool has_colors = false, has_second_uvs = false, has_tangents = false;
  for (const DrawnVertex& vertex : mesh.vertices) {
    positions.push_back(file_axes(vertex.position_m));
    least = glm::min(least, positions.back());
    most = glm::max(most, positions.back());
    const float length = glm::length(vertex.normal);
    normals.push_back(length > 0.0f ? file_axes(vertex.normal) / length : glm::vec3(0.0f, 1.0f, 0.0f));
    uvs.push_back(vertex.uv);
    second_uvs.push_back(vertex.second_uv);
    colors.push_back(vertex.color);
    tangents.push_back(written_tangent(vertex.tangent));
    has_colors |= vertex.color != white_color;
    has_second_uvs |= vertex.second_uv != glm::vec2(0.0f);
    has_tangents |= vertex.tangent != 0;
  }
  const std::size_t position = buffer.accessor({.view = buffer.view(positions, WrittenBuffer::vertex_data),
                                                .numbers = WrittenBuffer::floats,
                                                .count = positions.size(),
                                                .type = "VEC3",
                                                .least = {least.x, least.y, least.z},
                                                .most = {most.x, most.y, most.z}});
  Json attributes = {{"POSITION", position},
                     {"NORMAL", written_rows(normals, "VEC3", buffer)},
                     {"TEXCOORD_0", written_rows(uvs, "VEC2", buffer)}};
  if (has_second_uvs) attributes["TEXCOORD_1"] = written_rows(second_uvs, "VEC2", buffer);
  if (has_colors)
    attributes["COLOR_0"] = buffer.accessor({.view = buffer.view(colors, WrittenBuffer::vertex_data),
                                             .numbers = WrittenBuffer::unsigned_bytes,
                                             .count = colors.size(),
                                             .type = "VEC4",
                                             .is_normalized = true});
  Json with_tangents = attributes;
  if (has_tangents) with_tangents["TANGENT"] = written_rows(tangents, "VEC4", buffer);
  const std::size_t indices = buffer.view(mesh.indices, WrittenBuffer::index_data);
  Json primitives = Json::array();
  for (const DrawnRun& run : mesh.runs) {
    const auto corners = std::span(mesh.indices).subspan(run.first_index, run.index_count);
    const bool all_have_tangents =
        std::ranges::all_of(corners, [&](std::uint32_t vertex) { return mesh.vertices[vertex].tangent != 0; });
    primitives.push_back({{"attributes", all_have_tangents ? with_tangents : attributes},
                          {"indices", buffer.accessor({.view = indices,
                                                       .numbers = WrittenBuffer::unsigned_ints,
                                                       .count = run.index_count,
                                                       .offset = sizeof(std::uint32_t) * run.first_index})},
                          {"material", run.look}});
  }
  return {{"primitives", std::move(primitives)}};
}

}  // namespace septet::gltf
