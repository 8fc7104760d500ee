/// Images of a material beside its base colour's, at a point that a ray has met.

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>

#include "engine/light/surface_maps.hpp"
#include "engine/raytrace/facing_viewer.hpp"
#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

glm::vec3 World::vertex_color(const Corners& at, float u, float v) {
  if ((at.a->color & at.b->color & at.c->color) == scene::white_vertex) return glm::vec3(1.0f);
  const auto color_of = [](const scene::SurfaceVertex* corner) {
    return glm::vec3(glm::unpackUnorm4x8(corner->color));
  };
  return (1.0f - u - v) * color_of(at.a) + u * color_of(at.b) + v * color_of(at.c);
}

void World::apply_maps(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const Ray& ray,
                       const Hit& hit, const MapPlaces& lies, SurfacePoint& point, Finish& finish) const {
  if (const scene::TextureImage* properties = image_at(material.maps[scene::SurfaceMap::properties])) {
    const glm::vec4 read = texel(properties, lies.of(scene::SurfaceMap::properties));
    point.from_around = read.r;
    finish.roughness = std::max(light::least_mapped_roughness, finish.roughness * read.g);
    finish.metallic *= read.b;
    finish.mirrors = true;  // Everywhere: a layer that ended at some roughness would draw a line there.
  }
  if (const scene::TextureImage* normals = image_at(material.maps[scene::SurfaceMap::normal])) {
    Surface& surface = point.surface;
    const glm::vec3 front = point.from_front ? surface.normal : -surface.normal;
    const bool by_second_uv = scene::has_map(material.by_second_uv, scene::SurfaceMap::normal);
    const glm::vec3 read(texel(normals, lies.of(scene::SurfaceMap::normal)));
    const glm::vec3 mapped = mapped_normal(placed, ray, hit, read, front, by_second_uv);
    surface.normal = facing_viewer(point.from_front ? mapped : -mapped, ray.direction);
  }
}

glm::vec3 World::mapped_normal(const PlacedSurface& placed, const Ray& ray, const Hit& hit, const glm::vec3& texel,
                               const glm::vec3& front, bool by_second_uv) const {
  const Corners at = corners(placed, hit.triangle);
  if ((at.a->tangent | at.b->tangent | at.c->tangent) != 0) {
    const glm::vec4 tangent = (1.0f - hit.u - hit.v) * glm::unpackSnorm4x8(at.a->tangent) +
                              hit.u * glm::unpackSnorm4x8(at.b->tangent) + hit.v * glm::unpackSnorm4x8(at.c->tangent);
    const glm::mat3 turn = placed.motion ? placed.motion->at(ray.time).turn : placed.turn;
    const glm::vec3 along_u = turn * glm::vec3(tangent);
    const float side = glm::determinant(turn) < 0.0f ? -tangent.w : tangent.w;
    if (side != 0.0f) return light::mapped_normal(texel, front, along_u, -side * glm::cross(front, along_u));
  }
  glm::vec3 second = at.b->position_m - at.a->position_m, third = at.c->position_m - at.a->position_m;
  if (!placed.later.empty()) {
    const std::uint32_t* index = &placed.indices[std::size_t{3} * hit.triangle];
    const glm::vec3 a = placed.later[index[0]].position_m;
    second = glm::mix(second, placed.later[index[1]].position_m - a, ray.time);
    third = glm::mix(third, placed.later[index[2]].position_m - a, ray.time);
  }
  const auto uv = by_second_uv ? &scene::SurfaceVertex::second_uv : &scene::SurfaceVertex::uv;
  const glm::vec2 to_second = at.b->*uv - at.a->*uv, to_third = at.c->*uv - at.a->*uv;
  const float side = to_second.x * to_third.y - to_third.x * to_second.y < 0.0f ? -1.0f : 1.0f;
  const glm::vec3 along_u = side * (to_third.y * second - to_second.y * third),
                  along_v = side * (to_second.x * third - to_third.x * second);
  if (!placed.motion) return light::mapped_normal(texel, front, placed.turned(along_u), placed.turned(along_v));
  const glm::mat3 turn = placed.motion->at(ray.time).turn;
  return light::mapped_normal(texel, front, turn * along_u, turn * along_v);
}

}  // namespace septet::raytrace
