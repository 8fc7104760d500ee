#pragma once
/// Device copy of a ResolvedScene: meshes, images with mip levels, materials as shader constants, placed instances.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/scene_summary.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/device_texture.hpp"
#include "engine/render/passes/draw_list.hpp"
#include "engine/render/passes/static_geometry.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

using light::MaterialConstants;

struct DeviceMaterial {
  MaterialConstants constants{};
  std::int32_t image = -1;                                ///< Index of its texture; −1: no texture.
  scene::SurfaceMapImages maps = scene::no_surface_maps;  ///< Indices of textures.
  /// Bits of shaders/surface.frag: the maps that there are, those by the second coordinates, and the images that hold
  /// square roots.
  std::uint32_t map_bits = 0, second_uv_bits = 0, square_root_bits = 1;
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

inline constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

struct DeviceScene {
  std::optional<std::uint64_t> revision;
  std::uint64_t whole_revision = 0;  ///< Of the last upload of everything.
  std::vector<DeviceMesh> meshes;
  std::vector<DeviceTexture> textures;
  std::vector<DeviceMaterial> materials;
  /// Meshes placed more than once, ordered by mesh, and behind them those that were edited; some are visible from nowhere.
  std::vector<PlacedMesh> placed;
  std::vector<std::uint32_t> placed_at;        ///< By instance: its index in `placed`, or nowhere.
  std::size_t vacated = 0;                     ///< Of `placed`: those that no instance has any more.
  StaticGeometry still;                        ///< Meshes placed once; their vertices are on the device.
  std::vector<vulkan::Buffer> still_vertices;  ///< One buffer a block.
  std::uint64_t still_hash = 0;
  std::vector<std::uint32_t> still_instance, still_piece;  ///< By mesh; nowhere: it is not still.
  std::vector<bool> edited;                                ///< By mesh: it is never still again.
  SceneSummary summary;                                    ///< Summary for descriptions of instants in this scene.
  std::uint64_t lamps_revision = 0;                        ///< Of the newest change of the summary's lamps.

  bool is_still(std::uint32_t mesh) const { return mesh < still_instance.size() && still_instance[mesh] != nowhere; }
};

/// Uploads meshes, images and materials with a new revision. No frame that uses the scene may be in flight. Parts,
/// instances and images that point outside their arrays are left out.
void upload_scene(DeviceScene& scene, const scene::ResolvedScene& source, const vulkan::Device& device,
                  vulkan::MemoryPool& memory);
void destroy_scene(DeviceScene& scene, vulkan::MemoryPool& memory);

/// The same for these changes alone, at the cost of what changed. A mesh of still geometry that is edited, or whose
/// instance is, leaves its block for good and is placed like the others. `wait` is called before anything on the device
/// is written: until then frames may be in flight.
void renew_scene(DeviceScene& scene, const scene::ResolvedScene& source,
                 std::span<const scene::ChangeList<scene::SceneChange>::Change> changes, const vulkan::Device& device,
                 vulkan::MemoryPool& memory, const std::function<void()>& wait);

// Parts of both.
void upload_mesh(DeviceMesh& target, const scene::SurfaceMesh& mesh, std::span<const DeviceMaterial> materials,
                 vulkan::Upload& upload);
DeviceMaterial device_material(const scene::SurfaceMaterial& material, std::span<const DeviceTexture> textures);
/// Places all instances of meshes that are not still, ordered by mesh.
void place_instances(DeviceScene& scene, const scene::ResolvedScene& source);

}  // namespace septet::render
