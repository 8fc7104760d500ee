#include "sim-client/frame/debris_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/effects/ice/cracks.hpp"
#include "engine/effects/ice/still_ice.hpp"
#include "engine/world/paint.hpp"
#include "sim-client/frame/ice_looks.hpp"
#include "sim-client/frame/torn_vehicle.hpp"

namespace septet::frame {
namespace {

/// A piece that rested starts to move within its last interval, whenever its keyframe at rest was made.
constexpr double resting_span_ticks = 4.0, longest_span_ticks = 12.0;

/// Shards are only ever added, so the longer list begins with the shorter one.
bool same_triangles(const debris::Keyframe& a, const debris::Keyframe& b) {
  if (a.shards != b.shards) return false;
  if (!a.shards) return a.vertices_m.size() == b.vertices_m.size() && a.triangles == b.triangles;
  const std::size_t both = std::min(a.triangles.size(), b.triangles.size());
  return std::equal(a.triangles.begin(), a.triangles.begin() + static_cast<std::ptrdiff_t>(both), b.triangles.begin());
}

/// Places of the vertices of both; a vertex of only one stands still.
std::vector<Vec3> places_of(const debris::Keyframe& keyframe, const debris::Keyframe& other) {
  std::vector<Vec3> places = keyframe.vertices_m;
  for (std::size_t i = places.size(); i < other.vertices_m.size(); ++i) places.push_back(other.vertices_m[i]);
  return places;
}

/// Faces relative to one of their corners at its own instant: a normal needs the edges alone, and so loses no digits
/// far out.
std::vector<MovingFace> faces_of(std::span<const Vec3> from, std::span<const Vec3> to,
                                 std::span<const std::array<std::uint16_t, 3>> triangles) {
  std::vector<MovingFace> faces(triangles.size());
  for (std::size_t n = 0; n < faces.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) {
      faces[n].from[c] = glm::vec3(from[triangles[n][c]] - from[triangles[n][0]]);
      faces[n].to[c] = glm::vec3(to[triangles[n][c]] - to[triangles[n][0]]);
    }
  return faces;
}

}  // namespace

std::optional<DebrisInstant> debris_instant(const TimedDebris& earlier, const TimedDebris& before,
                                            const TimedDebris& after, double tick) {
  if (!before.keyframe && !after.keyframe) return std::nullopt;
  if (!before.keyframe) return DebrisInstant{after, after, 0.0};
  if (!after.keyframe) return DebrisInstant{before, before, 0.0};
  if (same_triangles(*before.keyframe, *after.keyframe)) {
    const double span = before.keyframe->asleep ? resting_span_ticks : longest_span_ticks;
    const double end = static_cast<double>(after.tick), begin = std::max(static_cast<double>(before.tick), end - span);
    return DebrisInstant{before, after, end > begin ? std::clamp((tick - begin) / (end - begin), 0.0, 1.0) : 1.0};
  }
  if (earlier.keyframe && earlier.tick < before.tick && same_triangles(*earlier.keyframe, *before.keyframe)) {
    const double share = (tick - static_cast<double>(earlier.tick)) / static_cast<double>(before.tick - earlier.tick);
    return DebrisInstant{earlier, before, std::clamp(share, 1.0, 3.0)};
  }
  return DebrisInstant{before, before, 0.0};
}

namespace {

/// Axes through three points: from the first to the second, and in their plane.
glm::dmat3 axes_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 x = glm::normalize(b - a), z = glm::normalize(glm::cross(x, c - a));
  return {x, glm::cross(z, x), z};
}

/// Rotation of a body that hardly deforms: from its three vertices that span about the widest triangle. Empty for a
/// body without width.
std::optional<glm::dmat3> turn_from_rest(std::span<const Vec3> rest_m, std::span<const Vec3> places) {
  std::size_t b = 0, c = 0;
  double widest = 0.0;
  for (std::size_t i = 1; i < rest_m.size(); ++i)
    if (const double away = glm::length(rest_m[i] - rest_m[0]); away > widest) widest = away, b = i;
  double area = 0.0;
  for (std::size_t i = 1; i < rest_m.size(); ++i)
    if (const double size = glm::length(glm::cross(rest_m[b] - rest_m[0], rest_m[i] - rest_m[0])); size > area)
      area = size, c = i;
  if (area < 1e-6 || glm::length(glm::cross(places[b] - places[0], places[c] - places[0])) < 1e-6) return std::nullopt;
  return axes_of(places[0], places[b], places[c]) * glm::transpose(axes_of(rest_m[0], rest_m[b], rest_m[c]));
}

/// Adds cracks, as faces that have partly separated: they move with the body however it bends.
void add_cracks(std::span<const debris::Keyframe::Crack> cracks, std::span<const Vec3> rest_m,
                std::span<const Vec3> places, std::vector<ice::IceVertex>& inside) {
  for (const debris::Keyframe::Crack& crack : cracks) {
    const double reach = crack.reach / 255.0;
    std::array<ice::IceVertex, 3> corners;
    const std::uint16_t a = crack.corners[0], b = crack.corners[1], c = crack.corners[2];
    const Vec3 normal = glm::cross(places[b] - places[a], places[c] - places[a]);
    if (!(glm::length(normal) > 1e-9)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint16_t corner = crack.corners[i];
      const auto between = [&](std::span<const Vec3> of) { return of[a] + reach * (of[corner] - of[a]); };
      corners[i].position_m = glm::vec3(between(places));
      corners[i].normal = glm::vec3(glm::normalize(normal));
      const Vec3 rest = between(rest_m);
      corners[i].rest_m = {static_cast<float>(rest.x - 0.7 * rest.y), static_cast<float>(rest.y + 2.0 * rest.z),
                           static_cast<float>(ice::InsideKind::crack)};
    }
    inside.insert(inside.end(), corners.begin(), corners.end());
  }
}

}  // namespace

DebrisWay::DebrisWay(const debris::Keyframe& from, const debris::Keyframe& to)
    : part_(to.part),
      material_(to.material),
      both_sides_(to.shards),
      rest_m_(to.rest_m.size() == std::max(from.vertices_m.size(), to.vertices_m.size()) ? to.rest_m
                                                                                         : std::vector<Vec3>()),
      inside_(cracks_between(rest_m_, slab_crack_cell_m)),
      cracks_(to.cracks),
      from_m_(places_of(from, to)),
      step_m_(places_of(to, from)),
      triangles_(to.triangles),
      normals_(NormalMethod::t_variant, faces_of(from_m_, step_m_, triangles_)) {
  for (std::size_t i = 0; i < step_m_.size(); ++i) step_m_[i] -= from_m_[i];
  if (!to.shards && rest_m_.empty()) bent_.emplace(triangles_, from_m_.size());
}

instant::DynamicMesh DebrisWay::at(double share) const {
  instant::DynamicMesh mesh;
  if (triangles_.empty()) return mesh;
  std::vector<Vec3> places(from_m_.size());
  Vec3 low(INFINITY), high(-INFINITY);
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = from_m_[i] + share * step_m_[i];
    low = glm::min(low, places[i]), high = glm::max(high, places[i]);
  }
  mesh.origin_m = 0.5 * (low + high);
  mesh.radius_m = static_cast<float>(0.5 * glm::length(high - low));
  FaceNormals faces;
  std::vector<glm::vec3> bent;
  if (bent_) {
    normals_.area_vectors_at(static_cast<float>(share), faces);
    bent = bent_->of_corners(triangles_, faces);
  } else {
    normals_.at(static_cast<float>(share), faces);
  }
  mesh.vertices.reserve(triangles_.size() * (both_sides_ ? 6 : 3));
  for (std::size_t n = 0; n < triangles_.size(); ++n) {
    std::array<glm::vec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::vec3(places[triangles_[n][c]] - mesh.origin_m);
    if (bent_) {
      for (std::size_t c = 0; c < 3; ++c) mesh.vertices.push_back({corners[c], bent[3 * n + c], {}});
      continue;
    }
    glm::vec3 normal(faces.x[n], faces.y[n], faces.z[n]);
    if (normal == glm::vec3(0.0f)) normal.z = 1.0f;  // A face without area is invisible, but its light must be finite.
    for (const glm::vec3& corner : corners) mesh.vertices.push_back({corner, normal, {}});
    if (both_sides_)
      for (const glm::vec3& corner : {corners[0], corners[2], corners[1]})
        mesh.vertices.push_back({corner, -normal, {}});
  }
  return mesh;
}

std::optional<ice::IceBody> DebrisWay::ice_of(const instant::DynamicMesh& mesh, float film) const {
  if (rest_m_.empty() || mesh.vertices.size() != 3 * triangles_.size()) return std::nullopt;
  ice::IceBody body;
  body.origin_m = mesh.origin_m;
  body.look = slab_look(film);
  body.vertices.reserve(mesh.vertices.size());
  std::vector<Vec3> places(rest_m_.size(), Vec3(0.0));
  Vec3 rest_middle(0.0), middle(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const std::uint16_t vertex = triangles_[i / 3][i % 3];
    places[vertex] = Vec3(mesh.vertices[i].position_m);
    rest_middle += rest_m_[vertex], middle += places[vertex], count += 1.0;
    body.vertices.push_back({mesh.vertices[i].position_m, mesh.vertices[i].normal, glm::vec3(rest_m_[vertex])});
  }
  add_cracks(cracks_, rest_m_, places, body.inside);
  const auto turn = turn_from_rest(rest_m_, places);
  if (!turn) return body;
  rest_middle /= count, middle /= count;
  const glm::mat3 turned(*turn);
  for (ice::IceVertex vertex : inside_) {
    vertex.position_m = glm::vec3(middle + *turn * (Vec3(vertex.position_m) - rest_middle));
    vertex.normal = turned * vertex.normal;
    body.inside.push_back(vertex);
  }
  return body;
}

std::string_view debris_look(debris::Part part, debris::Material material) {
  switch (part) {
    case debris::Part::traffic_cone:
      return "debris/traffic-cone";
    case debris::Part::lamp:
      return "debris/lamp";
    case debris::Part::door:
      return "debris/door";
    default:
      break;
  }
  constexpr std::array<std::string_view, debris::material_count> looks{
      "debris/steel-sheet", "debris/bumper-plastic", "debris/glass", "debris/ice",
      "debris/rubber",      "debris/concrete",       "debris/glass"};
  return looks[static_cast<std::size_t>(material)];
}

namespace {

/// A mesh of a panel as one of each material.
void add_clothed(const instant::DynamicMesh& whole, const Clothing& clothing, const debris::PieceOrigin& origin,
                 std::vector<instant::DynamicMesh>& meshes) {
  for (const ClothRun& run : clothing.runs()) {
    instant::DynamicMesh& mesh = meshes.emplace_back();
    mesh.origin_m = whole.origin_m;
    mesh.radius_m = whole.radius_m;
    mesh.paint = body_color(origin.paint);
    mesh.material = run.material;
    mesh.number = origin.vehicle;
    const std::size_t first = std::size_t{3} * run.first, end = first + std::size_t{3} * run.count;
    mesh.vertices.assign(whole.vertices.begin() + static_cast<std::ptrdiff_t>(first),
                         whole.vertices.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t i = first; i < end; ++i) mesh.vertices[i - first].uv = clothing.uvs()[i];
  }
}

}  // namespace

const Sheet& DebrisDrawing::panel(const debris::PieceOrigin& origin, const scene::ResolvedScene& scene) {
  const auto [found, fresh] = panels_.try_emplace({origin.model, origin.mount});
  if (fresh) found->second = panel_of(scene, vehicle_models()[origin.model], origin.mount);
  return found->second;
}

std::shared_ptr<const Clothing> DebrisDrawing::clothing_of(std::uint32_t id, const debris::Keyframe& piece,
                                                           const scene::ResolvedScene& scene) {
  if (!piece.origin) return nullptr;
  Worn& worn = worn_[id];
  worn.used = true;
  if (!worn.clothing || !worn.clothing->fits(piece))
    worn.clothing = std::make_shared<const Clothing>(panel(*piece.origin, scene), piece);
  return worn.clothing->is_worn() ? worn.clothing : nullptr;
}

TimedDebris DebrisDrawing::decoded(const EffectKeyframe* effect, const scene::ResolvedScene& scene) {
  if (!effect) return {};
  const auto [found, fresh] = decoded_.try_emplace({effect->id, effect->tick});
  Decoded& entry = found->second;
  if (fresh) {
    if (auto keyframe = debris::decode(effect->data)) entry.keyframe = std::move(*keyframe);
    if (entry.keyframe) entry.clothing = clothing_of(effect->id, *entry.keyframe, scene);
    if (entry.clothing) entry.keyframe = entry.clothing->worn(*entry.keyframe);
  }
  entry.used = true;
  return {entry.keyframe ? &*entry.keyframe : nullptr, effect->tick, entry.clothing};
}

DrawnDebris DebrisDrawing::draw(std::span<const EffectMoment> moments, double tick, const scene::ResolvedScene& scene,
                                double temperature_k) {
  DrawnDebris drawn;
  std::vector<instant::DynamicMesh>& meshes = drawn.meshes;
  if (std::exchange(scene_revision_, scene::shape_revision(scene)) != scene::shape_revision(scene)) {
    decoded_.clear();
    ways_.clear();
    worn_.clear();
    panels_.clear();
  }
  for (auto& [key, entry] : decoded_) entry.used = false;
  for (auto& [key, entry] : ways_) entry.used = false;
  for (auto& [key, entry] : worn_) entry.used = false;
  for (const EffectMoment& moment : moments) {
    const EffectKeyframe* any = moment.before ? moment.before : moment.after;
    if (!any || any->kind != debris::keyframe_kind) continue;
    const auto instant = debris_instant(decoded(moment.earlier, scene), decoded(moment.before, scene),
                                        decoded(moment.after, scene), tick);
    if (!instant) continue;
    const WayKey key{any->id, instant->from.tick, instant->to.tick};
    auto found = ways_.find(key);
    if (found == ways_.end()) {
      found = ways_
                  .emplace(key, Prepared{DebrisWay(*instant->from.keyframe, *instant->to.keyframe),
                                         instant->to.keyframe->origin, instant->to.clothing})
                  .first;
      ++prepared_;
    }
    found->second.used = true;
    if (const auto worn = worn_.find(any->id); worn != worn_.end()) worn->second.used = true;
    const DebrisWay& way = found->second.way;
    if (const Prepared& prepared = found->second; prepared.clothing && prepared.origin) {
      add_clothed(way.at(instant->share), *prepared.clothing, *prepared.origin, meshes);
      continue;
    }
    const auto look =
        std::ranges::find(scene.prototypes, debris_look(way.part(), way.material()), &scene::Prototype::name);
    if (look == scene.prototypes.end()) continue;
    meshes.push_back(way.at(instant->share));
    meshes.back().prototype = static_cast<std::uint32_t>(look - scene.prototypes.begin());
    // Too small a splinter for the panel has the colour of its skin.
    if (const auto& origin = found->second.origin)
      if (const Sheet& sheet = panel(*origin, scene); !sheet.empty()) {
        meshes.back().material = sheet.front().material;
        meshes.back().paint = body_color(origin->paint);
      }
    if (auto body = way.ice_of(meshes.back(), static_cast<float>(ice::film(temperature_k)))) {
      meshes.back().seen = false;
      drawn.ice.push_back(std::move(*body));
    }
  }
  std::erase_if(decoded_, [](const auto& entry) { return !entry.second.used; });
  std::erase_if(ways_, [](const auto& entry) { return !entry.second.used; });
  std::erase_if(worn_, [](const auto& entry) { return !entry.second.used; });
  return drawn;
}

}  // namespace septet::frame
