#pragma once
/// A drawing as a glTF 2.0 binary file (.glb): meshes placed by nodes, some of which move, materials with pictures.
///
/// Axes as in gltf.hpp: here x is forward, y left, z up, metres; the file has y up, z forward and x left (3.4).
/// Pictures are embedded as PNG. What read_gltf reads of the file is what was written, to the bits of a float.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/math/pose_keys.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::gltf {

struct DrawnVertex {
  glm::vec3 position_m, normal;
  glm::vec2 uv;
  std::uint32_t color = 0xFFFFFFFFu, tangent = 0;  ///< Packed as scene::SurfaceVertex has them.
  glm::vec2 second_uv{0.0f};                       ///< Of the pictures that Look::by_second_uv names.
};

/// Triangles of one look; `look` indexes Drawing::looks.
struct DrawnRun {
  std::uint32_t first_index = 0, index_count = 0, look = 0;
};

struct DrawnMesh {
  std::vector<DrawnVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< Counter-clockwise seen from the front.
  std::vector<DrawnRun> runs;
};

struct DrawnNode {
  std::string name;
  std::uint32_t mesh = 0;          ///< Indexes Drawing::meshes.
  RigidTransform model_from_node;  ///< Of one with keys: its place in what they move.
  glm::vec3 scale{1.0f};
  std::vector<PoseKey> keys{};  ///< Poses in the model; all nodes' begin again together. Empty: it stands.
};

struct Drawing {
  std::vector<DrawnMesh> meshes;
  std::vector<DrawnNode> nodes;
  std::vector<Look> looks;  ///< Of their mapping nothing is written.
  std::vector<Picture> pictures;
  std::vector<Extra> extras{};  ///< Of the first node.
};

/// Bytes of the file. Error: nothing is drawn, or more than a file holds. `where` names the drawing in errors.
Expected<Bytes> write_glb(const Drawing& drawing, const std::string& where);

}  // namespace septet::gltf
