#include "sim-client/screen/debris_drawing.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace septet::screen {
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

DebrisShape shape_of(const debris::Keyframe& keyframe) {
  return {keyframe.part, keyframe.material, keyframe.shards, keyframe.vertices_m, keyframe.triangles};
}

/// Moves the vertices that both have from `from` to `to`; beyond 1 it goes on in a straight line.
void move_between(std::vector<Vec3>& vertices, const std::vector<Vec3>& from, const std::vector<Vec3>& to, double share) {
  const std::size_t both = std::min({vertices.size(), from.size(), to.size()});
  for (std::size_t i = 0; i < both; ++i) vertices[i] = from[i] + share * (to[i] - from[i]);
}

glm::vec3 unit_or_up(const glm::vec3& v) {
  const float square = glm::dot(v, v);
  return square > 0.0f ? v / std::sqrt(square) : glm::vec3(0.0f, 0.0f, 1.0f);
}

}  // namespace

std::optional<DebrisShape> debris_at(const TimedDebris& earlier, const TimedDebris& before, const TimedDebris& after, double tick) {
  if (!before.keyframe && !after.keyframe) return std::nullopt;
  if (!before.keyframe) return shape_of(*after.keyframe);
  if (!after.keyframe) return shape_of(*before.keyframe);
  if (same_triangles(*before.keyframe, *after.keyframe)) {
    const double span = before.keyframe->asleep ? resting_span_ticks : longest_span_ticks;
    const double end = static_cast<double>(after.tick), begin = std::max(static_cast<double>(before.tick), end - span);
    DebrisShape shape = shape_of(*after.keyframe);
    const double share = end > begin ? std::clamp((tick - begin) / (end - begin), 0.0, 1.0) : 1.0;
    move_between(shape.vertices_m, before.keyframe->vertices_m, after.keyframe->vertices_m, share);
    return shape;
  }
  DebrisShape shape = shape_of(*before.keyframe);
  if (earlier.keyframe && earlier.tick < before.tick && same_triangles(*earlier.keyframe, *before.keyframe)) {
    const double share = (tick - static_cast<double>(earlier.tick)) / static_cast<double>(before.tick - earlier.tick);
    move_between(shape.vertices_m, earlier.keyframe->vertices_m, before.keyframe->vertices_m, std::clamp(share, 1.0, 3.0));
  }
  return shape;
}

render::DynamicMesh debris_mesh(const DebrisShape& shape) {
  render::DynamicMesh mesh;
  if (shape.vertices_m.empty()) return mesh;
  Vec3 low = shape.vertices_m.front(), high = low;
  for (const Vec3& v : shape.vertices_m) low = glm::min(low, v), high = glm::max(high, v);
  mesh.origin_m = 0.5 * (low + high);
  mesh.radius_m = static_cast<float>(0.5 * glm::length(high - low));
  std::vector<glm::vec3> vertices;
  vertices.reserve(shape.vertices_m.size());
  for (const Vec3& v : shape.vertices_m) vertices.emplace_back(v - mesh.origin_m);
  mesh.vertices.reserve(shape.triangles.size() * (shape.both_sides ? 6 : 3));
  for (const auto& [a, b, c] : shape.triangles) {
    const glm::vec3 &p = vertices[a], &q = vertices[b], &r = vertices[c];
    const glm::vec3 normal = unit_or_up(glm::cross(q - p, r - p));
    for (const glm::vec3& corner : {p, q, r}) mesh.vertices.push_back({corner, normal, {}});
    if (shape.both_sides)
      for (const glm::vec3& corner : {p, r, q}) mesh.vertices.push_back({corner, -normal, {}});
  }
  return mesh;
}

std::string_view debris_look(debris::Part part, debris::Material material) {
  switch (part) {
    case debris::Part::traffic_cone: return "debris/traffic-cone";
    case debris::Part::lamp: return "debris/lamp";
    case debris::Part::door: return "debris/door";
    default: break;
  }
  constexpr std::array<std::string_view, debris::material_count> looks{"debris/steel-sheet", "debris/bumper-plastic", "debris/glass",
                                                                       "debris/ice",         "debris/rubber",         "debris/concrete"};
  return looks[static_cast<std::size_t>(material)];
}

TimedDebris DebrisDrawing::decoded(const EffectKeyframe* effect) {
  if (!effect) return {};
  const auto [found, fresh] = decoded_.try_emplace({effect->id, effect->tick});
  Decoded& entry = found->second;
  if (fresh) {
    if (auto keyframe = debris::decode(effect->data))
      entry.keyframe = std::move(*keyframe);
    else
      ++refused_;
  }
  entry.used = true;
  return {entry.keyframe ? &*entry.keyframe : nullptr, effect->tick};
}

std::vector<render::DynamicMesh> DebrisDrawing::draw(std::span<const EffectMoment> moments, double tick,
                                                     const scene::ResolvedScene& scene) {
  std::vector<render::DynamicMesh> meshes;
  for (auto& [key, entry] : decoded_) entry.used = false;
  for (const EffectMoment& moment : moments) {
    const EffectKeyframe* any = moment.before ? moment.before : moment.after;
    if (!any || any->kind != debris::keyframe_kind) continue;
    const auto shape = debris_at(decoded(moment.earlier), decoded(moment.before), decoded(moment.after), tick);
    if (!shape) continue;
    const auto look = std::ranges::find(scene.prototypes, debris_look(shape->part, shape->material), &scene::Prototype::name);
    if (look == scene.prototypes.end()) continue;
    meshes.push_back(debris_mesh(*shape));
    meshes.back().prototype = static_cast<std::uint32_t>(look - scene.prototypes.begin());
  }
  std::erase_if(decoded_, [](const auto& entry) { return !entry.second.used; });
  return meshes;
}

}  // namespace septet::screen
