#pragma once
/// A part under construction: triangles of primitives, their vertices joined where place and normal agree.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/gltf/primitive.hpp"

namespace septet::gltf {

/// glTF's x is left, y up, z forward; ours x forward, y left, z up.
inline glm::vec3 our_axes(const glm::vec3& p) { return {p.z, p.x, p.y}; }

/// Joins vertices of the same place and normal.
struct JoinedCorner {
  std::array<float, 6> numbers;
  bool operator==(const JoinedCorner&) const = default;
};
struct JoinedCornerHash {
  std::size_t operator()(const JoinedCorner& corner) const {
    std::size_t hash = 0;
    for (const float number : corner.numbers) hash = hash * 1000003u ^ std::hash<float>{}(number);
    return hash;
  }
};

struct GrowingPart {
  Part part;
  std::unordered_map<JoinedCorner, std::uint32_t, JoinedCornerHash> known;
  bool has_uvs = false, has_second_uvs = false, has_colors = false, has_tangents = false;
};

/// False for a place further than `furthest_m` along an axis.
bool is_near(const glm::vec3& p);

/// Adds a primitive's triangles. `look`: Model::looks at `look_index`. `takes_colors`: their vertices' colours are
/// added. False: a vertex is far away.
bool add_triangles(const Primitive& primitive, const Look& look, std::uint32_t look_index, bool takes_colors,
                   const glm::mat4& model_from_node, GrowingPart& growing);

/// The part, without the layers that it does not need.
Part finished(GrowingPart growing);

}  // namespace septet::gltf
