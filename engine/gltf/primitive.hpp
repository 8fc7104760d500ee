#pragma once
/// A mesh's primitive (glTF 2.0, 3.7.2): its triangles, and what their corners carry, in one pose of its joints and
/// morph targets.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/gltf/skin.hpp"

namespace septet::gltf {

/// Rows by vertex, or none.
struct Primitive {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Counter-clockwise seen from the front.
  Rows positions, normals, uvs, second_uvs;
  Rows colors;    ///< The first set.
  Rows tangents;  ///< Of a mesh that neither joints nor targets bend, where the look has a picture of normals.
  std::size_t indices = 0;
};

/// Where joints and targets are; without a skin the node places the mesh.
struct MeshPose {
  const Skin* skin = nullptr;
  std::vector<float> weights{};
};

/// True for lists, strips and fans of triangles; points and lines are not drawn.
bool is_of_triangles(const Json& primitive);

/// The number of its triangles or of its vertices, whichever is larger, as its accessors say; a damaged file may lie.
std::size_t size_of(const Container& container, const Json& primitive);

/// `look`: of its material. Error: rows that are missing, damaged or of unequal number.
Expected<Primitive> read_primitive(const Container& container, const Json& primitive, const Look& look,
                                   const MeshPose& pose, const std::string& where);

}  // namespace septet::gltf
