#include "engine/raytrace/world.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/instant/glass_cover.hpp"
#include "engine/instant/standing_lamps.hpp"
#include "engine/instant/wet_road.hpp"
#include "engine/light/crack.hpp"
#include "engine/light/fresnel.hpp"
#include "engine/light/frost.hpp"
#include "engine/light/lamplight.hpp"
#include "engine/light/microfacets.hpp"
#include "engine/light/ruts.hpp"
#include "engine/light/snow.hpp"
#include "engine/light/soot.hpp"
#include "engine/light/wet_road.hpp"
#include "engine/raytrace/facing_viewer.hpp"
#include "engine/scene/image_reading.hpp"

namespace septet::raytrace {

World::World(const scene::ResolvedScene& scene, const SceneIndex& index, const instant::Instant& instant,
             const instant::Instant* later, std::span<const ClearBody> bodies,
             std::span<const std::uint8_t> cloud_noise, Geometry& geometry)
    : scene_(scene),
      index_(index),
      instant_(instant),
      geometry_(geometry),
      sky_(*instant.light),
      cloud_noise_(cloud_noise),
      cloud_drift_m_(instant::cloud_drift_m(instant.environment, instant.simulated_time_s)),
      origin_m_(instant::world_eye(instant.views.front())),
      smoke_(instant.smoke, origin_m_),
      nothing_lies_on_it_(!(instant.environment.snow_cover > 0.0) && instant.soot.cover.empty()) {
  if (instant.environment.rain_mm_per_h > 0.0 && instant.environment.road_wetness > 0.0)
    ripples_ = instant::ripple_slopes(instant.environment.rain_mm_per_h, instant.simulated_time_s);
  geometry_.keep(scene.meshes.size());
  next_mesh_ = static_cast<std::uint32_t>(scene.meshes.size());
  for (const auto& parts : instant.reshaped)
    for (const auto& mesh : *parts)
      if (mesh) reshaped_.emplace(mesh.get(), mesh);
  std::vector<Place> places;
  for (std::size_t n = 0; n < scene.instances.size(); ++n) {
    const scene::Instance& instance = scene.instances[n];
    if (instance.mesh >= scene.meshes.size()) continue;
    const scene::SurfaceMesh& mesh = scene.meshes[instance.mesh];
    add(places, instant::place(instance, {mesh.bounds_min_m, mesh.bounds_max_m}, instance.world_from_object), true,
        n + 1);
  }
  add_parts(places, later);
  add_soups(places, later, bodies);
  add_headlights(later);
  geometry_.place(places, this);
  add_lamps(places);
  add_matt_faces();
}

World::Corners World::corners(const PlacedSurface& placed, std::uint32_t triangle) const {
  const std::uint32_t* index = &placed.indices[std::size_t{3} * triangle];
  return {&placed.vertices[index[0]], &placed.vertices[index[1]], &placed.vertices[index[2]]};
}

const scene::SurfaceMaterial& World::material_of(const PlacedSurface& placed, std::uint32_t triangle) const {
  if (placed.materials.empty()) return no_material_;
  const std::uint32_t material = placed.materials[placed.materials.size() > 1 ? triangle : 0];
  return material < scene_.materials.size() ? scene_.materials[material] : no_material_;
}

bool World::shows_back(const scene::SurfaceMaterial& material) const {
  return &material == &no_material_ || index_.shows_back[static_cast<std::size_t>(&material - scene_.materials.data())];
}

glm::vec2 World::in_image(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec2& uv) {
  const std::uint32_t columns = std::max(1u, material.picture_columns), rows = std::max(1u, material.picture_rows);
  const std::uint32_t picture = placed.number % (columns * rows);
  return (uv + glm::vec2(picture % columns, picture / columns)) / glm::vec2(columns, rows);
}

const scene::TextureImage* World::image_at(std::int32_t index) const {
  if (index < 0 || static_cast<std::size_t>(index) >= scene_.images.size()) return nullptr;
  const scene::TextureImage& image = scene_.images[static_cast<std::size_t>(index)];
  return image.width > 0 && image.height > 0 ? &image : nullptr;
}

glm::vec4 World::texel(const scene::TextureImage* source, const glm::vec2& uv) const {
  return source ? scene::read_image(*source, uv, true) : glm::vec4(1.0f);
}

/// Share of a surface's light that the soot on it takes, interpolated between the eight cells around.
float World::soot(const glm::vec3& position_m) const {
  const instant::SootField& field = instant_.soot;
  const glm::vec3 at((inverse(field.world_from_field) * (origin_m_ + Vec3(position_m))) / field.cell_m - 0.5);
  const glm::vec3 floored = glm::floor(at), share = at - floored;
  const glm::ivec3 low(floored), size(field.nx, field.ny, field.nz);
  if (!light::in_soot(low, size)) return 0.0f;
  float sum = 0.0f;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 corner = light::soot_corner(n);
    const int index = light::soot_index(low + corner, size);
    sum +=
        light::soot_weight(share, corner) * static_cast<float>(field.cover[static_cast<std::size_t>(index)]) / 255.0f;
  }
  return sum;
}

/// Sets the position and orientation of a hit and returns the normal interpolated between the corners' own, towards the
/// viewer.
glm::vec3 World::stand(const PlacedSurface& placed, const Ray& ray, const Hit& hit, SurfacePoint& point) const {
  const Corners at = corners(placed, hit.triangle);
  const float w = 1.0f - hit.u - hit.v;
  glm::vec3 a = at.a->position_m, b = at.b->position_m, c = at.c->position_m;
  glm::vec3 normal = w * at.a->normal + hit.u * at.b->normal + hit.v * at.c->normal;
  if (!placed.later.empty()) {
    const std::uint32_t* index = &placed.indices[std::size_t{3} * hit.triangle];
    const scene::SurfaceVertex &then_a = placed.later[index[0]], &then_b = placed.later[index[1]],
                               &then_c = placed.later[index[2]];
    a = glm::mix(a, then_a.position_m, ray.time), b = glm::mix(b, then_b.position_m, ray.time);
    c = glm::mix(c, then_c.position_m, ray.time);
    // Of a flat face the normal is exactly that of the triangle at that time (Parus et al., eq. 1).
    const bool is_flat = !placed.body && at.a->normal == at.b->normal && at.b->normal == at.c->normal;
    normal = is_flat ? glm::cross(b - a, c - a)
                     : glm::mix(normal, w * then_a.normal + hit.u * then_b.normal + hit.v * then_c.normal, ray.time);
  }
  // Computed from the corners, not along the ray: a far hit's distance has fewer digits.
  point.position_m = w * a + hit.u * b + hit.v * c;
  point.flat_normal = glm::cross(b - a, c - a);
  if (placed.motion) {
    const Stand now = placed.motion->at(ray.time);
    const glm::mat3 normal_turn = glm::inverseTranspose(now.turn);
    point.position_m = now.origin_m + now.turn * point.position_m;
    point.flat_normal = normal_turn * point.flat_normal;
    normal = normal_turn * normal;
  } else {
    point.position_m = placed.origin_m + placed.turned(point.position_m);
    if (placed.is_turned) {
      point.flat_normal = placed.normal_turn * point.flat_normal;
      normal = placed.normal_turn * normal;
    }
  }
  const float area = glm::length(point.flat_normal);
  point.flat_normal = area > 0.0f ? point.flat_normal * (1.0f / area) : -ray.direction;
  const float length = glm::length(normal);
  normal = length > 1e-12f ? normal * (1.0f / length) : point.flat_normal;
  point.from_front = glm::dot(point.flat_normal, ray.direction) < 0.0f;
  if (!point.from_front) {
    point.flat_normal = -point.flat_normal;
    normal = -normal;
  }
  return facing_viewer(normal, ray.direction);
}

void World::point(const Ray& ray, const Hit& hit, SurfacePoint& point) const {
  const PlacedSurface& placed = placed_[hit.place];
  const scene::SurfaceMaterial& material = material_of(placed, hit.triangle);
  point = {};
  point.place = hit.place;
  Surface& surface = point.surface;
  surface.normal = stand(placed, ray, hit, point);
  if (placed.body) {
    point.dielectric = true;
    point.index = placed.body->index;
    point.absorption_per_m = placed.body->absorption_per_m;
    return;
  }
  if (placed.on_glass) return lie_on_glass(placed, ray, hit, point);
  point.share_of_sky = material.share_of_sky * placed.share_of_sky;
  if (!point.from_front && !shows_back(material)) {
    point.opacity = 0.0f;
    return;
  }
  glm::vec3 base = material.base_color * (material.takes_paint ? glm::vec3(placed.tint) : glm::vec3(1.0f));
  base *= vertex_color(corners(placed, hit.triangle), hit.u, hit.v);
  if (nothing_lies_on_it_ && &material != &no_material_ &&
      index_.plain[static_cast<std::size_t>(&material - scene_.materials.data())]) {
    surface.diffuse = base;
    return;
  }
  const Corners at = corners(placed, hit.triangle);
  glm::vec2 uv = (1.0f - hit.u - hit.v) * at.a->uv + hit.u * at.b->uv + hit.v * at.c->uv;
  if (material.picture_columns > 1 || material.picture_rows > 1) uv = in_image(placed, material, uv);
  point.opacity = material.opacity;
  if (material.base_color_image >= 0) {
    const glm::vec4 read = texel(image_at(material.base_color_image), uv);
    base *= glm::vec3(read);
    if (material.opacity < opaque_from) point.opacity *= read.a;
  }
  if (material.opacity >= opaque_from) point.opacity = 1.0f;
  const glm::vec3 seen = -ray.direction;
  Finish finish{material.roughness, material.metallic,
                material.roughness < rough_from || material.metallic > 0.2f || point.opacity < 1.0f};
  const glm::vec2 second_uv =
      (1.0f - hit.u - hit.v) * at.a->second_uv + hit.u * at.b->second_uv + hit.v * at.c->second_uv;
  const MapPlaces lies{uv, material.by_second_uv != 0 ? second_uv : uv, material.by_second_uv};
  if (material.maps != scene::no_surface_maps) apply_maps(placed, material, ray, hit, lies, point, finish);
  lay_weather(placed, material, finish, uv, base, seen, point);
  if ((point.from_front || material.two_sided) && placed.tint.w > 0.0f && material.emission != glm::vec3(0.0f)) {
    const scene::TextureImage* shining = image_at(material.maps[scene::SurfaceMap::emission]);
    const glm::vec3 color = shining ? glm::vec3(texel(shining, lies.of(scene::SurfaceMap::emission))) : glm::vec3(1.0f);
    give_off(placed, material, color, hit, seen, point);
  }
  if (!instant_.soot.cover.empty()) blacken(1.0f - soot(point.position_m), point);
}

/// Applies snow, water and gloss to a surface of the colour `base`, seen along −`seen`.
void World::lay_weather(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const Finish& finish,
                        const glm::vec2& uv, const glm::vec3& base, const glm::vec3& seen, SurfacePoint& point) const {
  const Environment& weather = instant_.environment;
  Surface& surface = point.surface;
  const glm::vec3 normal = surface.normal;
  glm::vec3 albedo = base;
  const float snow_lies =
      weather.snow_cover > 0.0 ? lay_snow(placed, material, uv, normal.z, point.share_of_sky, albedo) : 0.0f;
  const float wet =
      material.wettable ? static_cast<float>(weather.road_wetness) * point.share_of_sky * (1.0f - snow_lies) : 0.0f;
  const Vec3 place_m = origin_m_ + Vec3(point.position_m);
  const float rut = material.base_color_image >= 0 ? light::rut_at(uv.x) : 0.0f;
  const float under_water = wet > 0.0f ? instant::puddle(cloud_noise_, place_m.x, place_m.y, rut, wet) : 0.0f;
  albedo = light::wet_albedo(albedo, wet, under_water);

  point.retroreflection = base * (material.retroreflection * (material.stripe ? light::wet_beads_return(wet) : 1.0f));
  surface.diffuse = albedo * (1.0f - finish.metallic);
  if (material.wettable) {
    // Water covers a share of a wet road, as in the rasteriser; the dry road between is rough.
    surface.coat = light::water_covers(wet, under_water);
    surface.coat_f0 = light::water_reflectance;
    const float roughness = light::water_roughness(under_water);
    surface.coat_alpha = roughness * roughness;
    if (under_water > 0.0f && !ripples_.empty())
      surface.normal = facing_viewer(
          glm::normalize(surface.normal - glm::vec3(under_water * ripple(point.position_m), 0.0f)), -seen);
  } else if (finish.mirrors) {
    const float index = (material.refraction_index - 1.0f) / (material.refraction_index + 1.0f);
    surface.alpha = std::max(1e-3f, finish.roughness * finish.roughness);
    surface.f0 = glm::mix(glm::vec3(index * index), albedo, finish.metallic);
  }
  if (material.clear_coat > 0.0f && !material.wettable) {
    surface.coat = material.clear_coat;
    surface.coat_f0 = light::coat_reflectance;
    surface.coat_alpha = light::coat_roughness * light::coat_roughness;
  }
  if (point.opacity < 1.0f)  // Mirroring reduces the view through glass.
    point.opacity = std::clamp(
        point.opacity + luminance(light::schlick(surface.f0, std::min(1.0f, glm::dot(normal, seen)))), 0.0f, 1.0f);
}

/// Sets the emission: the material's, times `color`.
void World::give_off(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec3& color,
                     const Hit& hit, const glm::vec3& seen, SurfacePoint& point) const {
  point.emission = material.emission * (placed.tint.w * instant_.emission_share) * color;
  point.lights_up = lights_up(placed, material, instant::looks_down(point.flat_normal));
  const float cosine = glm::dot(point.flat_normal, seen);
  if (cosine > 1e-6f && is_street_lamp(placed, material, instant::looks_down(point.flat_normal)))
    point.lights_up *= street_lamp::spread(cosine) / cosine;
  if (material.lit_by_night) point.emission *= instant_.light->night, point.lights_up = 0.0f;
  if (!point.from_front) return;  // Lamps are not sampled from behind.
  for (const std::uint32_t lamp : placed.lamps)
    if (hit.triangle - lamps_[lamp].first_triangle < lamps_[lamp].triangle_count) point.lamp = lamp;
}

/// Applies soot, which leaves this share of all light from a surface. A lamp's light on other surfaces stays: its lens
/// is drawn as a light of its own.
void World::blacken(float share, SurfacePoint& point) {
  point.surface.diffuse *= share;
  point.surface.mirrors = share;
  point.retroreflection *= share;
  point.emission *= share;
  if (share > 0.0f) point.lights_up /= share;
}

void World::lie_on_glass(const PlacedSurface& placed, const Ray& ray, const Hit& hit, SurfacePoint& point) const {
  const ice::IceVertex* corner = &placed.on_glass->vertices[std::size_t{3} * hit.triangle];
  const auto between = [&](glm::vec3 ice::IceVertex::*what) {
    return (1.0f - hit.u - hit.v) * corner[0].*what + hit.u * corner[1].*what + hit.v * corner[2].*what;
  };
  const glm::vec3 rest_m = between(&ice::IceVertex::rest_m);
  point.share_of_sky = placed.share_of_sky;
  point.surface.normal = point.flat_normal;
  if (placed.on_glass->look.on_glass == ice::OnGlass::frost) {
    point.opacity = instant::frost_hides(cloud_noise_, rest_m);
    point.translucent = true;
    point.surface.diffuse = glm::vec3(light::frost_albedo);
    return;
  }
  const instant::CrackSeen crack =
      instant::crack_seen(cloud_noise_, rest_m, glm::normalize(between(&ice::IceVertex::normal)));
  point.opacity = crack.hides;
  point.translucent = crack.crushed;
  point.face_in_sheet = !crack.crushed;
  if (crack.crushed) {
    point.surface.diffuse = glm::vec3(crack.albedo);
    return;
  }
  point.surface.normal = glm::dot(crack.normal, ray.direction) > 0.0f ? -crack.normal : crack.normal;
  point.surface.f0 = glm::vec3(1.0f);
  point.surface.alpha = light::crack_roughness * light::crack_roughness;
}

glm::vec2 World::ripple(const glm::vec3& position_m) const {
  const Vec3 tiles = (origin_m_ + Vec3(position_m)) / double(light::ripple_tile_m);
  const auto texel = [](double tile) {
    const auto n = static_cast<std::uint32_t>((tile - std::floor(tile)) * instant::ripple_side);
    return std::size_t{std::min(n, instant::ripple_side - 1)};
  };
  return ripples_[texel(tiles.y) * instant::ripple_side + texel(tiles.x)];
}

glm::vec3 World::fog_radiance(const glm::vec3& direction, float from_share_of_sky, float to_share_of_sky) const {
  const float roofed = light::roofed_between(from_share_of_sky, to_share_of_sky);
  return glm::mix(open_fog_radiance(direction), light::roofed_haze, roofed);
}

glm::vec3 World::open_fog_radiance(const glm::vec3& direction) const {
  const float level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const float up = std::max(direction.z, 0.02f), across = std::sqrt(std::max(0.0f, 1.0f - up * up));
  if (level < 1e-4f) return sky_.radiance({across, 0.0f, up});
  return sky_.radiance({across * direction.x / level, across * direction.y / level, up});
}

/// Applies snow; headwind has blown it off vehicles, and clear glass stays clear. Returns the share of the point that
/// it covers.
float World::lay_snow(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec2& uv,
                      float up, float share_of_sky, glm::vec3& albedo) const {
  const auto cover = static_cast<float>(instant_.environment.snow_cover);
  const bool twigs =
      &material != &no_material_ && index_.cut[static_cast<std::size_t>(&material - scene_.materials.data())];
  if (twigs) albedo = light::withered(albedo, cover);
  if (!placed.snowed_on || material.opacity < opaque_from) return 0.0f;
  float snow = twigs ? light::twigs_hold_snow(up) : light::holds_snow(up);
  if (material.wettable && material.base_color_image >= 0) snow *= light::snow_beside_ruts(uv.x);
  const float lies = cover * share_of_sky * snow;
  albedo = light::snowy_albedo(albedo, lies);
  return lies;
}

bool World::is_hole(std::uint32_t place, std::uint32_t triangle, float u, float v) const {
  const PlacedSurface& placed = placed_[place];
  const scene::SurfaceMaterial& material = material_of(placed, triangle);
  if (material.base_color_image < 0 || material.opacity < opaque_from) return false;
  const Corners at = corners(placed, triangle);
  return texel(image_at(material.base_color_image),
               in_image(placed, material, (1.0f - u - v) * at.a->uv + u * at.b->uv + v * at.c->uv))
             .a < 0.5f;
}

float World::share_let_through(std::uint32_t place, std::uint32_t triangle, float u, float v,
                               const glm::vec3& direction) const {
  const PlacedSurface& placed = placed_[place];
  const scene::SurfaceMaterial& material = material_of(placed, triangle);
  if (material.opacity >= opaque_from && !placed.on_glass) return is_hole(place, triangle, u, v) ? 1.0f : 0.0f;
  Hit hit{0.0f, place, triangle, u, v};
  Ray ray;
  ray.direction = direction;
  SurfacePoint there;
  point(ray, hit, there);
  return 1.0f - there.opacity;
}

}  // namespace septet::raytrace
