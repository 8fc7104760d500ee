/// Construction of a World from an instant: places, motions, and the lamps among them.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_inverse.hpp>

#include "engine/core/check.hpp"
#include "engine/instant/standing_lamps.hpp"
#include "engine/raytrace/world.hpp"

namespace septet::raytrace {
namespace {

constexpr float lamp_gap_m = 0.3f;  ///< Gap beyond which triangles are lamps of their own.

std::vector<scene::SurfaceVertex> as_soup(const ice::IceBody& body) {
  std::vector<scene::SurfaceVertex> vertices;
  vertices.reserve(body.vertices.size());
  for (const ice::IceVertex& vertex : body.vertices) vertices.push_back({vertex.position_m, vertex.normal, {}});
  return vertices;
}

/// Vertices at the later time, from the origin of now; empty where they are others.
std::vector<scene::SurfaceVertex> vertices_from(const Vec3& origin_m, std::size_t count, const Vec3& then_origin_m,
                                                std::span<const scene::SurfaceVertex> then) {
  const Vec3 way_m = then_origin_m - origin_m;
  if (then.size() != count || glm::length(way_m) > longest_way_m) return {};
  std::vector<scene::SurfaceVertex> vertices(then.begin(), then.end());
  for (scene::SurfaceVertex& vertex : vertices) vertex.position_m += glm::vec3(way_m);
  return vertices;
}

}  // namespace

void World::add_headlights(const instant::Instant* later) {
  std::vector<glm::vec3> ways_m(instant_.headlights.size(), glm::vec3(0.0f));
  if (later && later->headlights.size() == ways_m.size())
    for (std::size_t n = 0; n < ways_m.size(); ++n)
      if (const Vec3 way_m = later->headlights[n].position_m - instant_.headlights[n].position_m;
          glm::length(way_m) < longest_way_m)
        ways_m[n] = glm::vec3(way_m);
  headlights_ = HeadlightRow(instant_.headlights, ways_m, origin_m_);
}

/// Pairs the same part of the same participant in both instants.
void World::add_parts(std::vector<Place>& places, const instant::Instant* later) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const instant::PlacedMesh*>> then;
  if (later)
    for (const instant::PlacedMesh& part : later->parts) then[{part.mesh, part.number}].push_back(&part);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> met;
  for (const instant::PlacedMesh& part : instant_.parts) {
    const std::pair key{part.mesh, part.number};
    const auto found = then.find(key);
    const std::size_t which = met[key]++;
    const bool there = found != then.end() && which < found->second.size();
    add(places, part, false, scene_.instances.size() + part.mesh + 1, there ? found->second[which] : nullptr);
  }
}

void World::add(std::vector<Place>& places, const instant::PlacedMesh& placed, bool stands, std::size_t object,
                const instant::PlacedMesh* later) {
  if (placed.mesh >= scene_.meshes.size()) return;
  const double distance_m = glm::length(placed.origin_m - origin_m_);
  const instant::LevelFade fade =
      instant::fade_at(static_cast<float>(distance_m), placed.visible_from_m, placed.visible_to_m);
  if (fade.none()) return;
  const scene::SurfaceMesh& mesh = placed.reshaped ? *placed.reshaped : scene_.meshes[placed.mesh];
  std::uint32_t number = placed.mesh;
  std::span<const std::uint32_t> materials = index_.materials[placed.mesh];
  if (placed.reshaped) {
    const auto owner = reshaped_.find(placed.reshaped);
    SEPTET_CHECK(owner != reshaped_.end(), "nobody owns the mesh in the stead of {}", placed.mesh);
    geometry_.add_mesh(owner->second, index_.open[placed.mesh]);
    number = next_mesh_++;
    materials = reshaped_materials_.emplace_back(triangle_materials(mesh));
  }
  const glm::vec3 origin(placed.origin_m - origin_m_);
  std::optional<Motion> motion;
  if (later && glm::length(later->origin_m - placed.origin_m) < longest_way_m) {
    const Stand from{origin, placed.world_from_object},
        to{glm::vec3(later->origin_m - origin_m_), later->world_from_object};
    if (!(from == to)) motion.emplace(from, to);
  }
  places.push_back({number, origin, placed.world_from_object, placed.seen, motion, fade, placed.casts_shadow});
  placed_.push_back({mesh.vertices,
                     mesh.indices,
                     mesh.parts,
                     placed.world_from_object,
                     glm::inverseTranspose(placed.world_from_object),
                     origin,
                     placed.tint,
                     placed.share_of_sky,
                     placed.snowed_on,
                     placed.number,
                     stands,
                     materials,
                     {},
                     nullptr,
                     static_cast<std::uint32_t>(object)});
  placed_.back().motion = motion;
  placed_.back().lights_around = placed.lights_around;
}

/// Adds triangles of this instant alone.
void World::add_soups(std::vector<Place>& places, const instant::Instant* later, std::span<const ClearBody> bodies) {
  std::size_t longest = 0;
  for (const instant::LooseMesh& loose : instant_.loose) longest = std::max(longest, loose.mesh.vertices.size());
  for (const ClearBody& body : bodies) longest = std::max(longest, body.vertices.size());
  for (const ice::IceBody& pane : instant_.glass) longest = std::max(longest, pane.vertices.size());
  loose_indices_.resize(longest);
  std::iota(loose_indices_.begin(), loose_indices_.end(), 0u);
  loose_parts_.reserve(instant_.loose.size());
  later_soups_.reserve(instant_.loose.size());
  const auto add_soup = [&](const Vec3& origin_m, std::span<const scene::SurfaceVertex> vertices, bool seen,
                            std::span<const scene::SurfaceVertex> moved, bool open = false) -> PlacedSurface& {
    const glm::vec3 origin(origin_m - origin_m_);
    const std::span indices(loose_indices_.data(), vertices.size() / 3 * 3);
    geometry_.add_mesh(vertices, indices, open, moved);
    places.push_back({next_mesh_++, origin, glm::mat3(1.0f), seen});
    PlacedSurface soup;
    soup.vertices = vertices;
    soup.indices = indices;
    soup.origin_m = origin;
    soup.later = moved;
    return placed_.emplace_back(std::move(soup));
  };
  const bool same = later && later->loose.size() == instant_.loose.size();
  for (std::size_t n = 0; n < instant_.loose.size(); ++n) {
    const instant::LooseMesh& loose = instant_.loose[n];
    std::vector<scene::SurfaceVertex>& moved = later_soups_.emplace_back();
    if (same && later->loose[n].material == loose.material)
      moved = vertices_from(loose.mesh.origin_m, loose.mesh.vertices.size(), later->loose[n].mesh.origin_m,
                            later->loose[n].mesh.vertices);
    PlacedSurface& soup = add_soup(loose.mesh.origin_m, loose.mesh.vertices, loose.mesh.seen, moved);
    loose_parts_.push_back({{0, static_cast<std::uint32_t>(soup.indices.size()), loose.material}});
    soup.parts = loose_parts_.back();
    soup.materials = {&loose_parts_.back().front().material, 1};
    soup.tint = glm::vec4(loose.mesh.paint, 1.0f);
    soup.number = loose.mesh.number;
    soup.share_of_sky = loose.share_of_sky;
    soup.object = static_cast<std::uint32_t>(scene_.instances.size() + scene_.meshes.size() + loose.material + 1);
  }
  const std::size_t ice = scene_.instances.size() + scene_.meshes.size() + scene_.materials.size() + 1;
  for (const ClearBody& body : bodies) {
    PlacedSurface& soup = add_soup(body.origin_m, body.vertices, true, body.later);
    soup.body = &body;
    soup.object = static_cast<std::uint32_t>(ice);
  }
  const bool same_panes = later && later->glass.size() == instant_.glass.size();
  panes_.reserve(2 * instant_.glass.size());
  for (std::size_t n = 0; n < instant_.glass.size(); ++n) {
    const ice::IceBody& pane = instant_.glass[n];
    if (pane.look.on_glass == ice::OnGlass::nothing) continue;
    const auto& now = panes_.emplace_back(as_soup(pane));
    auto& then = panes_.emplace_back();
    if (same_panes) then = vertices_from(pane.origin_m, now.size(), later->glass[n].origin_m, as_soup(later->glass[n]));
    PlacedSurface& soup = add_soup(pane.origin_m, now, true, then, true);
    soup.on_glass = &pane;
    soup.share_of_sky = pane.look.share_of_sky;
    soup.object = static_cast<std::uint32_t>(ice + 1);
  }
}

std::vector<World::ClearBodySphere> World::clear_body_spheres() const {
  std::vector<ClearBodySphere> spheres;
  for (std::uint32_t place = 0; place < placed_.size(); ++place) {
    const PlacedSurface& placed = placed_[place];
    if (!placed.body || placed.vertices.empty()) continue;
    glm::vec3 low = placed.vertices.front().position_m, high = low;
    for (const auto vertices : {placed.vertices, placed.later})
      for (const scene::SurfaceVertex& vertex : vertices)
        low = glm::min(low, vertex.position_m), high = glm::max(high, vertex.position_m);
    const glm::vec3 middle = 0.5f * (low + high);
    float square = 0.0f;
    for (const auto vertices : {placed.vertices, placed.later})
      for (const scene::SurfaceVertex& vertex : vertices)
        square = std::max(square, glm::dot(vertex.position_m - middle, vertex.position_m - middle));
    // Enlarged for rounding: a vertex on the rim is within.
    const float radius_m = 1.0001f * std::sqrt(square);
    if (radius_m > 0.0f && std::isfinite(radius_m)) spheres.push_back({place, placed.origin_m + middle, radius_m});
  }
  return spheres;
}

/// True for a part of the scene in the open that shines down, where street lamps are lit.
bool World::is_street_lamp(const PlacedSurface& placed, const scene::SurfaceMaterial& material, bool looks_down) const {
  return instant_.light->street_lamps > 0.0f && placed.stands && looks_down &&
         material.share_of_sky * placed.share_of_sky >= 0.5f;
}

/// Factor of a lamp's light on other surfaces. Beacons and static lamps are drawn no brighter than a picture shows
/// them; a beacon lights its surroundings with all of its emission, and lamps that look down as brightly as the
/// rasteriser has it.
float World::lights_up(const PlacedSurface& placed, const scene::SurfaceMaterial& material, bool looks_down) const {
  if (placed.lights_around) return 1.0f / instant_.emission_share;
  if (!placed.stands) return 1.0f;
  const float open = looks_down ? instant::open_lamps_light_up(*instant_.light) / instant_.emission_share : 1.0f;
  return glm::mix(instant::roofed_lamps_light_up, open, material.share_of_sky * placed.share_of_sky);
}

/// Adds the triangles of an emissive part; consecutive ones that lie together make one lamp.
void World::add_lamps(std::uint32_t place, const scene::MeshPart& part) {
  const PlacedSurface& placed = placed_[place];
  if (part.material >= scene_.materials.size() || part.index_count < 3) return;
  const scene::SurfaceMaterial& material = scene_.materials[part.material];
  const glm::vec3 emission = index_.lamp_emission[part.material] * (placed.tint.w * instant_.emission_share);
  if (!(luminance(emission) > 0.0f) || material.lit_by_night) return;
  Lamp lamp;
  glm::vec3 low(0.0f), high(0.0f);
  const auto finish = [&] {
    lamp.middle_m = 0.5f * (low + high);
    lamp.radius_m = 0.5f * glm::length(high - low);
    if (lamp.triangle_count > 0) lamp.area_m2 = lamp.cumulative_area.back();
    lamp.axis /= std::max(lamp.area_m2, 1e-30f);
    lamp.spreads = is_street_lamp(placed, material, instant::looks_down(lamp.axis));
    lamp.emission = emission * lights_up(placed, material, instant::looks_down(lamp.axis));
    lamp.power = lamp.area_m2 * luminance(lamp.emission);
    if (lamp.power > 0.0f) lamps_.push_back(std::move(lamp));
  };
  for (std::uint32_t t = part.first_index / 3; t < (part.first_index + part.index_count) / 3; ++t) {
    const Corners at = corners(placed, t);
    std::array<glm::vec3, 3> c{at.a->position_m, at.b->position_m, at.c->position_m};
    for (glm::vec3& corner : c) corner = placed.origin_m + placed.turn * corner;
    const glm::vec3 lower = glm::min(c[0], glm::min(c[1], c[2])), upper = glm::max(c[0], glm::max(c[1], c[2]));
    const bool apart =
        glm::any(glm::greaterThan(lower, high + lamp_gap_m)) || glm::any(glm::lessThan(upper, low - lamp_gap_m));
    if (lamp.triangle_count == 0 || apart) {
      if (lamp.triangle_count > 0) finish();
      lamp = {};
      lamp.place = place, lamp.first_triangle = t;
      lamp.textured = material.maps[scene::SurfaceMap::emission] >= 0;
      if (placed.motion) lamp.way_m = placed.motion->keys()[1].origin_m - placed.motion->keys()[0].origin_m;
      low = lower, high = upper;
    }
    low = glm::min(low, lower), high = glm::max(high, upper);
    const float before = lamp.triangle_count > 0 ? lamp.cumulative_area.back() : 0.0f;
    const glm::vec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
    const float twice_area = glm::length(across);
    lamp.axis += 0.5f * across;
    lamp.cumulative_area.push_back(before + 0.5f * twice_area);
    lamp.triangles.push_back({c[0], c[1] - c[0], c[2] - c[0], across / std::max(twice_area, 1e-30f)});
    ++lamp.triangle_count;
  }
  finish();
}

void World::add_lamps(const std::vector<Place>& places) {
  // The level with the larger share lights for both.
  for (std::uint32_t n = 0; n < placed_.size(); ++n)
    if (placed_[n].tint.w > 0.0f && places[n].seen && places[n].fade.share() >= 0.5f)
      for (const scene::MeshPart& part : placed_[n].parts) add_lamps(n, part);
  // Others are met by chance alone; where there are so many they are far or weak.
  const auto weight = [](const Lamp& lamp) { return lamp.power / (1.0f + glm::dot(lamp.middle_m, lamp.middle_m)); };
  std::stable_sort(lamps_.begin(), lamps_.end(), [&](const Lamp& a, const Lamp& b) { return weight(a) > weight(b); });
  all_lamps_are_drawn_ = lamps_.size() <= LampWeights::most;
  if (!all_lamps_are_drawn_) lamps_.resize(LampWeights::most);
  lamp_row_ = LampRow(lamps_);
  lamps_alone_shine_ = !lamps_.empty() && !sky_.shines() && !sky_.has_sun() && instant_.headlights.empty();
  for (std::uint32_t n = 0; n < lamps_.size(); ++n) placed_[lamps_[n].place].lamps.push_back(n);
}

}  // namespace septet::raytrace
