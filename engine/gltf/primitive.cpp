#include "engine/gltf/primitive.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/gltf/morph.hpp"

namespace septet::gltf {
namespace {

constexpr std::int64_t triangle_list = 4, triangle_strip = 5, triangle_fan = 6;

std::int64_t mode_of(const Json& primitive) { return index_in(primitive, "mode", triangle_list); }

/// Triangles as a primitive's own vertices (glTF 2.0, 3.7.2.1), in the winding of each mode.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<std::uint32_t>& indices, std::int64_t mode) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::size_t count = indices.size();
  if (mode == triangle_list)
    for (std::size_t i = 0; i + 2 < count; i += 3) triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (mode == triangle_strip) triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    if (mode == triangle_fan) triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
  }
  return triangles;
}

std::size_t count_of(const Container& container, std::int64_t accessor) {
  const Json& accessors = list_of(*container.json, "accessors");
  if (accessor < 0 || static_cast<std::uint64_t>(accessor) >= accessors.size()) return 0;
  return static_cast<std::size_t>(
      std::max<std::int64_t>(index_in(accessors[static_cast<std::size_t>(accessor)], "count", 0), 0));
}

const Json& attributes_of(const Json& primitive) { return member_of(primitive, "attributes"); }

}  // namespace

bool is_of_triangles(const Json& primitive) {
  const std::int64_t mode = mode_of(primitive);
  return mode >= triangle_list && mode <= triangle_fan;
}

std::size_t size_of(const Container& container, const Json& primitive) {
  if (!is_of_triangles(primitive)) return 0;
  const std::size_t vertices = count_of(container, index_in(attributes_of(primitive), "POSITION"));
  const std::size_t corners = count_of(container, index_in(primitive, "indices"));
  return std::max(vertices, mode_of(primitive) == triangle_list ? corners / 3 : corners);
}

Expected<Primitive> read_primitive(const Container& container, const Json& primitive, const Look& look,
                                   const MeshPose& pose, const std::string& where) {
  const Json& attributes = attributes_of(primitive);
  Primitive read;
  auto positions = read_rows(container, index_in(attributes, "POSITION"), 3, 3, most_vertices);
  if (!positions) return tl::unexpected(positions.error());
  read.positions = std::move(*positions);
  const auto add_rows = [&](const std::string& name, std::size_t least, std::size_t most, Rows& to) -> Expected<void> {
    if (!attributes.contains(name)) return {};
    auto rows = read_rows(container, index_in(attributes, name.c_str()), least, most, most_vertices);
    if (!rows) return tl::unexpected(rows.error());
    if (rows->count != read.positions.count)
      return failure(fmt::format("{} has {} rows and POSITION {}", name, rows->count, read.positions.count), where,
                     export_anew);
    to = std::move(*rows);
    return {};
  };
  if (auto added = add_rows("NORMAL", 3, 3, read.normals); !added) return tl::unexpected(added.error());
  if (auto added = add_targets(container, primitive, pose.weights, read.positions, read.normals, where); !added)
    return tl::unexpected(added.error());
  if (auto added = add_rows("COLOR_0", 3, 4, read.colors); !added) return tl::unexpected(added.error());
  const bool is_bent = pose.skin || std::ranges::any_of(pose.weights, [](float weight) { return weight != 0.0f; });
  if (look.normal_picture >= 0 && !is_bent)
    if (auto added = add_rows("TANGENT", 4, 4, read.tangents); !added) return tl::unexpected(added.error());
  if (auto added = add_rows(fmt::format("TEXCOORD_{}", look.mapping.uv_set), 2, 2, read.uvs); !added)
    return tl::unexpected(added.error());
  if (look.by_second_uv != 0)
    if (auto added = add_rows(fmt::format("TEXCOORD_{}", look.second_mapping.uv_set), 2, 2, read.second_uvs); !added)
      return tl::unexpected(added.error());
  std::vector<std::uint32_t> indices;
  if (primitive.contains("indices")) {
    auto numbers = read_indices(container, index_in(primitive, "indices"), 3 * most_triangles, read.positions.count);
    if (!numbers) return tl::unexpected(numbers.error());
    indices = std::move(*numbers);
  } else {
    for (std::uint32_t i = 0; i < read.positions.count; ++i) indices.push_back(i);
  }
  read.indices = indices.size();
  read.triangles = triangles_of(indices, mode_of(primitive));
  if (!pose.skin) return read;
  const auto mirrors = place_by_skin(container, attributes, *pose.skin, read.positions, where);
  if (!mirrors) return tl::unexpected(mirrors.error());
  if (*mirrors)
    for (auto& triangle : read.triangles) std::swap(triangle[1], triangle[2]);
  return read;
}

}  // namespace septet::gltf
