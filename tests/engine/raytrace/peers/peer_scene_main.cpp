/// Draws a scene by Septet and writes it for another path tracer, which draws the same (mitsuba_peer.py):
///
///     septet-peer-scene noon|night|tunnel|smoke FOLDER SAMPLES
///
/// FOLDER/traced.pfm is Septet's picture, linear; scene.json names meshes (PLY), images, sky, camera and exposure. What every path
/// tracer means by its words is kept: diffuse surfaces with images and holes, lamps, sky, sun or moon, smoke in cells. Gloss, sheets
/// of glass, retroreflection, headlights and fog, whose formulas are Septet's own, are left out on both sides; closed forms hold
/// them in the tests beside. A lamp lights as bright as it is seen.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "engine/raytrace/smoke.hpp"
#include "tests/engine/raytrace/cornell_box.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet::raytrace {
namespace {

struct PeerScene {
  scene::ResolvedScene scene;
  instant::Instant instant;
  TraceSettings settings;
};

/// What all path tracers have.
void simplify(scene::ResolvedScene& scene) {
  for (scene::SurfaceMaterial& material : scene.materials) {
    material.roughness = 1.0f;
    material.metallic = material.retroreflection = 0.0f;
    material.wettable = false;
    // As World says: what lights a roofed place is as many times as bright for what it lights.
    material.emission *= 6.0f + (1.0f - 6.0f) * material.share_of_sky;
    if (material.emission != glm::vec3(0.0f)) material.share_of_sky = 1.0f;
  }
  for (scene::SurfaceMesh& mesh : scene.meshes)
    for (scene::MeshPart& part : mesh.parts)
      if (scene.materials[part.material].opacity < 0.999f) part.index_count = 0;
  // What no part names any more is no surface either.
  for (scene::SurfaceMesh& mesh : scene.meshes) {
    std::vector<std::uint32_t> kept;
    for (scene::MeshPart& part : mesh.parts) {
      const auto from = mesh.indices.begin() + part.first_index;
      part.first_index = static_cast<std::uint32_t>(kept.size());
      kept.insert(kept.end(), from, from + part.index_count);
    }
    mesh.indices = std::move(kept);
  }
}

PeerScene motorway(std::string_view name) {
  const Motorway world;
  PeerScene peer{world.scene(), {}, {.filter = Filter::box}};
  simplify(peer.scene);
  instant::FrameInput input = world.frame({"", name == "tunnel" ? 3350.0 : 800.0, 0.0, name == "night", false});
  input.environment.cloud_cover = 0.0;
  input.participants.pop_back();  // The driver's own car is not seen.
  peer.instant = instant::describe(std::move(input), instant::summarise(peer.scene));
  peer.instant.headlights.clear();
  peer.instant.extinction_per_m = 0.0f;
  for (instant::PlacedMesh& part : peer.instant.parts) part.share_of_sky = 1.0f;
  peer.settings.paths = {.longest = 8, .roulette_from = 100};
  return peer;
}

/// A puff in the middle of the Cornell box.
PeerScene smoke_box() {
  PeerScene peer{cornell_box(), before_cornell_box(192), cornell_settings(0)};
  peer.instant.smoke.push_back({{0.0, 0.0, 0.1}, 0.15f, 0.5f, glm::vec3(0.9f, 0.8f, 0.7f), 0.0f, 0});
  peer.settings.paths.longest = 12;
  return peer;
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) std::fprintf(stderr, "%s cannot be written\n", path.c_str()), std::exit(1);
}

template <class Pixel>
void write_pfm(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height, const Pixel& pixel) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
  for (std::uint32_t row = height; row-- > 0;)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::vec3 color = pixel(x, row);
      bytes.append(reinterpret_cast<const char*>(&color), sizeof(color));
    }
  write(path, bytes);
}

/// Triangles of one look.
struct Group {
  std::vector<scene::SurfaceVertex> vertices;
  glm::vec3 color{0.0f}, emission{0.0f};
  std::int32_t image = -1;
};

std::string ply(const Group& group) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      "element face {}\nproperty list uchar int vertex_index\nend_header\n",
      group.vertices.size(), group.vertices.size() / 3);
  bytes.append(reinterpret_cast<const char*>(group.vertices.data()),
               group.vertices.size() * sizeof(scene::SurfaceVertex));
  for (std::uint32_t n = 0; n + 2 < group.vertices.size(); n += 3) {
    const std::uint32_t corners[3] = {n, n + 1, n + 2};
    bytes += '\3';
    bytes.append(reinterpret_cast<const char*>(corners), sizeof(corners));
  }
  return bytes;
}

/// All that is seen, from the first view's eye along the world's axes.
std::vector<Group> groups_of(const PeerScene& peer) {
  const Vec3 origin_m = instant::world_eye(peer.instant.views.front());
  std::map<std::tuple<std::uint32_t, float, float, float, bool>, Group> groups;
  const auto add = [&](const instant::PlacedMesh& placed) {
    const double distance_m = glm::length(placed.origin_m - origin_m);
    if (!placed.seen || distance_m < placed.visible_from_m || distance_m >= placed.visible_to_m) return;
    const scene::SurfaceMesh& mesh = peer.scene.meshes[placed.mesh];
    const glm::mat3 normals = glm::inverse(glm::transpose(placed.world_from_object));
    const glm::vec3 origin(placed.origin_m - origin_m);
    for (const scene::MeshPart& part : mesh.parts) {
      const scene::SurfaceMaterial& material = peer.scene.materials[part.material];
      const glm::vec3 paint = material.takes_paint ? glm::vec3(placed.tint) : glm::vec3(1.0f);
      const bool shines = placed.tint.w > 0.0f && material.emission != glm::vec3(0.0f);
      Group& group = groups[{part.material, paint.x, paint.y, paint.z, shines}];
      group.color = material.base_color * paint;
      group.image = material.base_color_image;
      if (shines) group.emission = material.emission * (placed.tint.w * peer.instant.emission_share);
      const std::uint32_t columns = material.picture_columns,
                          picture = placed.number % (columns * material.picture_rows);
      for (std::uint32_t n = part.first_index; n < part.first_index + part.index_count; ++n) {
        scene::SurfaceVertex vertex = mesh.vertices[mesh.indices[n]];
        vertex.position_m = origin + placed.world_from_object * vertex.position_m;
        vertex.normal = glm::normalize(normals * vertex.normal);
        vertex.uv =
            (vertex.uv + glm::vec2(picture % columns, picture / columns)) / glm::vec2(columns, material.picture_rows);
        group.vertices.push_back(vertex);
      }
    }
  };
  for (const scene::Instance& instance : peer.scene.instances) {
    const scene::SurfaceMesh& mesh = peer.scene.meshes[instance.mesh];
    add(instant::place(instance, {mesh.bounds_min_m, mesh.bounds_max_m}, instance.world_from_object));
  }
  for (const instant::PlacedMesh& part : peer.instant.parts) add(part);
  std::vector<Group> result;
  for (auto& [key, group] : groups)
    if (!group.vertices.empty()) result.push_back(std::move(group));
  return result;
}

std::string numbers(const glm::vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// Extinction and albedo in cells, as Septet's own cells have them: along each cell the light is weakened by its mean.
std::string write_smoke(const PeerScene& peer, const std::filesystem::path& folder) {
  if (peer.instant.smoke.empty()) return "null";
  const Smoke smoke(peer.instant.smoke, instant::world_eye(peer.instant.views.front()));
  const glm::vec3 middle(peer.instant.smoke[0].position_m - instant::world_eye(peer.instant.views.front()));
  const float half_m = 0.62f;  // Four deviations and no wall.
  constexpr int cells = 96;
  std::string bytes = "VOL\3";
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const int word : {1, cells, cells, cells, 1}) put(word);
  for (const float sign : {-1.0f, 1.0f})
    for (int axis = 0; axis < 3; ++axis) put(middle[axis] + sign * half_m);
  const float step_m = 2.0f * half_m / cells;
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        Ray ray;
        ray.origin_m = middle - half_m + step_m * (glm::vec3(x, y, z) + glm::vec3(0.0f, 0.5f, 0.5f));
        ray.direction = {1.0f, 0.0f, 0.0f};
        ray.to_m = step_m;
        put(smoke.optical_depth(ray) / step_m);
      }
  write(folder / "smoke.vol", bytes);
  return fmt::format("{{\"low_m\": {}, \"high_m\": {}, \"albedo\": {}}}", numbers(middle - half_m),
                     numbers(middle + half_m), numbers(peer.instant.smoke[0].albedo));
}

void run(std::string_view name, const std::filesystem::path& folder, std::uint32_t samples) {
  PeerScene peer = name == "smoke" ? smoke_box() : motorway(name);
  peer.settings.samples = samples;
  const instant::FrameView& view = peer.instant.views.front();
  const std::uint32_t width = view.viewport.width, height = view.viewport.height;
  auto tracer = RayTracer::create(peer.scene);
  if (!tracer) std::fprintf(stderr, "%s\n", describe(tracer.error()).c_str()), std::exit(1);
  tracer->begin(peer.instant, peer.settings);
  const std::clock_t began = std::clock();
  const TracedPicture picture = whole_picture(*tracer, width, height);
  const double processor_s = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  write_pfm(folder / "traced.pfm", width, height,
            [&](std::uint32_t x, std::uint32_t y) { return picture.at(x, y).radiance; });
  // Rows from the top, azimuth from +x towards +y.
  const instant::SkyLight& light = *peer.instant.light;
  write_pfm(folder / "sky.pfm", 2048, 1024, [&](std::uint32_t x, std::uint32_t y) {
    const double around = 2.0 * std::numbers::pi * (x + 0.5) / 2048.0, down = std::numbers::pi * (y + 0.5) / 1024.0;
    return instant::sky_radiance(light, glm::vec3(glm::dvec3(std::sin(down) * std::sin(around),
                                                             std::sin(down) * std::cos(around), std::cos(down))));
  });
  for (std::size_t n = 0; n < peer.scene.images.size(); ++n) {
    const scene::TextureImage& from = peer.scene.images[n];
    image::Image image(from.width, from.height);
    image.rgba = from.rgba;
    if (const auto done = image::write_png(folder / fmt::format("image{}.png", n), image, image::PngEffort::small);
        !done)
      std::fprintf(stderr, "%s\n", describe(done.error()).c_str()), std::exit(1);
  }
  std::string groups;
  const std::vector<Group> all = groups_of(peer);
  for (std::size_t n = 0; n < all.size(); ++n) {
    write(folder / fmt::format("mesh{}.ply", n), ply(all[n]));
    const bool srgb = all[n].image < 0 || peer.scene.images[static_cast<std::size_t>(all[n].image)].srgb;
    groups += fmt::format("{}{{\"color\": {}, \"emission\": {}, \"image\": {}, \"srgb\": {}}}", n ? ",\n  " : "",
                          numbers(all[n].color), numbers(all[n].emission), all[n].image, srgb);
  }
  const Quat turn = view.world_from_car.orientation;
  const instant::OffAxisView& p = view.projection;
  write(folder / "scene.json",
        fmt::format(
            "{{\"width\": {}, \"height\": {}, \"processor_s\": {}, \"horizontal_deg\": {}, \"ahead\": {}, \"up\": {},\n"
            " \"longest\": {}, \"exposure\": {}, \"sun_irradiance\": {}, \"to_sun\": {}, \"smoke\": {},\n"
            " \"groups\": [\n  {}]}}\n",
            width, height, processor_s, 2.0 * std::atan(p.right_slope) * 180.0 / std::numbers::pi,
            numbers(glm::vec3(turn * -p.back)), numbers(glm::vec3(turn * p.up)), peer.settings.paths.longest,
            peer.instant.exposure.scale(), numbers(light.light_irradiance), numbers(light.light_direction),
            write_smoke(peer, folder), groups));
}

}  // namespace
}  // namespace septet::raytrace

int main(int count, char** arguments) {
  if (count != 4) return std::fputs("septet-peer-scene noon|night|tunnel|smoke FOLDER SAMPLES\n", stderr), 2;
  septet::raytrace::run(arguments[1], arguments[2],
                        static_cast<std::uint32_t>(std::strtoul(arguments[3], nullptr, 10)));
}
