#pragma once
/// Device copy of a ResolvedScene: meshes, images with mip levels, materials as shader constants, placed instances.

#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/scene_summary.hpp"
#include "engine/light/records.hpp"
#include "engine/render/mip_chain.hpp"
#include "engine/render/passes/draw_list.hpp"
#include "engine/render/passes/static_geometry.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

using light::MaterialConstants;

struct DeviceMaterial {
  MaterialConstants constants{};
  std::int32_t image = -1;  ///< Index of its texture; −1: no texture.
  bool cut = false, blended = false, glossy = false, coated = false, wettable = false, stripe = false,
       two_sided = false, in_street = false;  ///< two_sided: opaque, and drawn from both sides.
};

struct DeviceMesh {
  std::uint64_t revision = 0;
  bool present = false;
  vulkan::Buffer buffer;  ///< Vertices, then indices.
  std::uint64_t indices_at = 0;
  std::vector<scene::MeshPart> parts;
};

struct DeviceTexture {
  std::uint64_t revision = 0;
  bool holes = false;
  vulkan::DeviceImage image;
};

struct DeviceScene {
  std::optional<std::uint64_t> revision;
  std::vector<DeviceMesh> meshes;
  std::vector<DeviceTexture> textures;
  std::vector<DeviceMaterial> materials;
  std::vector<PlacedMesh> placed;              ///< Meshes placed more than once, ordered by mesh.
  StaticGeometry still;                        ///< Meshes placed once; their vertices are on the device.
  std::vector<vulkan::Buffer> still_vertices;  ///< One buffer a block.
  std::uint64_t still_hash = 0;
  SceneSummary summary;  ///< Summary for descriptions of instants in this scene.
};

/// Uploads meshes, images and materials with a new revision. No frame that uses the scene may be in flight. Parts,
/// instances and images that point outside their arrays are left out.
void upload_scene(DeviceScene& scene, const scene::ResolvedScene& source, const vulkan::Device& device,
                  vulkan::MemoryPool& memory);
void destroy_scene(DeviceScene& scene, vulkan::MemoryPool& memory);

/// All levels of a texture as the device keeps them: the square root of linear light.
std::vector<MipLevel> texture_levels(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     bool srgb);

/// Creates a sampled image; the upload fills it with these levels.
vulkan::DeviceImage create_texture(vulkan::Upload& upload, std::span<const MipLevel> levels);

}  // namespace septet::render
