#include "engine/gltf/skin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "engine/gltf/gltf.hpp"

namespace septet::gltf {
namespace {

constexpr std::size_t most_joints = 1024, most_sets = 4;

glm::mat4 matrix_of(const Rows& rows, std::size_t row) {
  glm::mat4 matrix(1.0f);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = rows.numbers[row * 16 + static_cast<std::size_t>(i)];
  return matrix;
}

}  // namespace

Expected<Skin> read_skin(const Container& container, std::int64_t skin, const PlacedNodes& nodes,
                         const std::string& where) {
  const Json& skins = list_of(*container.json, "skins");
  if (skin < 0 || static_cast<std::uint64_t>(skin) >= skins.size())
    return failure(fmt::format("its skin is none of the file's {}", skins.size()), where, export_anew);
  const std::string place = fmt::format("{}, skin {}", container.where, skin);
  const Json& json = skins[static_cast<std::size_t>(skin)];
  const Json& joints = list_of(json, "joints");
  if (joints.empty() || joints.size() > most_joints)
    return failure(fmt::format("it has {} joints, not 1 to {}", joints.size(), most_joints), place,
                   "bind the mesh to fewer bones");
  Rows matrices;
  if (json.contains("inverseBindMatrices")) {
    auto read = read_rows(container, index_in(json, "inverseBindMatrices"), 16, 16, most_joints);
    if (!read) return tl::unexpected(read.error());
    matrices = std::move(*read);
    if (matrices.count < joints.size())
      return failure(fmt::format("it has {} inverse bind matrices of {} joints", matrices.count, joints.size()), place,
                     export_anew);
  }
  Skin placed;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::int64_t node = node_index(*container.json, joints[i]);
    if (node < 0 || !nodes.model_from_node[static_cast<std::size_t>(node)])
      return failure(fmt::format("its joint {} is no node of the scene", i), place, export_anew);
    const glm::mat4& model_from_joint = *nodes.model_from_node[static_cast<std::size_t>(node)];
    placed.model_from_bound.push_back(matrices.count > 0 ? model_from_joint * matrix_of(matrices, i)
                                                         : model_from_joint);
  }
  return placed;
}

Expected<bool> place_by_skin(const Container& container, const Json& attributes, const Skin& skin, Rows& positions,
                             const std::string& where) {
  std::vector<glm::mat4> sums(positions.count, glm::mat4(0.0f));
  std::vector<float> weight_sums(positions.count, 0.0f);
  std::vector<std::size_t> first_joints(positions.count, 0);
  for (std::size_t set = 0; set < most_sets; ++set) {
    const std::string joint_name = fmt::format("JOINTS_{}", set), weight_name = fmt::format("WEIGHTS_{}", set);
    if (set > 0 && !attributes.contains(joint_name)) break;
    const auto joints = read_rows(container, index_in(attributes, joint_name.c_str()), 4, 4, most_vertices);
    if (!joints) return tl::unexpected(joints.error());
    const auto weights = read_rows(container, index_in(attributes, weight_name.c_str()), 4, 4, most_vertices);
    if (!weights) return tl::unexpected(weights.error());
    if (joints->count != positions.count || weights->count != positions.count)
      return failure(fmt::format("{} has {} rows, {} {} and POSITION {}", joint_name, joints->count, weight_name,
                                 weights->count, positions.count),
                     where, export_anew);
    for (std::size_t i = 0; i < joints->numbers.size(); ++i) {
      const float number = joints->numbers[i];
      if (!(number >= 0.0f && number < static_cast<float>(skin.model_from_bound.size())))
        return failure(fmt::format("a vertex follows joint {} of {}", number, skin.model_from_bound.size()), where,
                       export_anew);
      const auto joint = static_cast<std::size_t>(number);
      const std::size_t vertex = i / 4;
      if (set == 0 && i % 4 == 0) first_joints[vertex] = joint;
      const float weight = std::max(weights->numbers[i], 0.0f);
      sums[vertex] += weight * skin.model_from_bound[joint];
      weight_sums[vertex] += weight;
    }
  }
  bool mirrors = false;
  for (std::size_t vertex = 0; vertex < positions.count; ++vertex) {
    constexpr float least_sum = 1e-6f;
    const glm::mat4 model_from_bound = weight_sums[vertex] > least_sum ? sums[vertex] / weight_sums[vertex]
                                                                       : skin.model_from_bound[first_joints[vertex]];
    if (vertex == 0) mirrors = glm::determinant(glm::mat3(model_from_bound)) < 0.0f;
    float* p = &positions.numbers[vertex * 3];
    const glm::vec3 placed(model_from_bound * glm::vec4(p[0], p[1], p[2], 1.0f));
    for (int k = 0; k < 3; ++k) p[k] = placed[k];
  }
  return mirrors;
}

}  // namespace septet::gltf
