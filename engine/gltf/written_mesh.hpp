#pragma once
/// A mesh as primitives of a file, one for each look (glTF 2.0, 3.7.2), with those layers of its vertices that say
/// something.

#include "engine/gltf/container.hpp"
#include "engine/gltf/write_glb.hpp"
#include "engine/gltf/written_buffer.hpp"

namespace septet::gltf {

Json written_mesh(const DrawnMesh& mesh, WrittenBuffer& buffer);

}  // namespace septet::gltf
