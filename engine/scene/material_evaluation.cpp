#include "engine/scene/material_evaluation.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace septet::scene {
namespace {

constexpr int deepest = 64;  ///< Depth limit of a tree; deeper parts are black.

float mean(const glm::vec3& color) { return (color.r + color.g + color.b) / 3.0f; }

/// One share of a surface's light to the eye: a colour, times an image where there is one.
struct Lobe {
  glm::vec3 color{0.0f};
  NodeId image = no_node;
};

struct Lobes {
  Lobe plain;  ///< Light of its own.
  Lobe lit;    ///< Light in proportion to the light that falls on it.
  Lobe mirror;
  Lobe through;
  float refraction_index = 1.5f;

  bool is_plain() const {
    return lit.color == glm::vec3(0.0f) && mirror.color == glm::vec3(0.0f) && through.color == glm::vec3(0.0f);
  }
};

Lobes plain(const glm::vec3& color, NodeId image = no_node) {
  Lobes lobes;
  lobes.plain = {color, image};
  return lobes;
}

/// Combines the lobes one by one; of two images the first stays.
template <class Combine>
Lobes combined(const Lobes& a, const Lobes& b, Combine combine) {
  const auto one = [&](const Lobe& x, const Lobe& y) {
    return Lobe{combine(x.color, y.color), x.image != no_node ? x.image : y.image};
  };
  Lobes result{one(a.plain, b.plain), one(a.lit, b.lit), one(a.mirror, b.mirror), one(a.through, b.through)};
  result.refraction_index = a.through.color != glm::vec3(0.0f) ? a.refraction_index : b.refraction_index;
  return result;
}

Lobes scaled(const Lobes& lobes, const Lobe& by) {
  const auto one = [&](const Lobe& lobe) {
    const glm::vec3 color = lobe.color * by.color;
    const bool empty = lobe.color == glm::vec3(0.0f);
    return Lobe{color, lobe.image != no_node || empty ? lobe.image : by.image};
  };
  Lobes result{one(lobes.plain), one(lobes.lit), one(lobes.mirror), one(lobes.through)};
  result.refraction_index = lobes.refraction_index;
  return result;
}

float ramp_parameter(const RampFragment& ramp, const glm::vec3& color) { return color[static_cast<int>(ramp.channel)]; }

glm::vec3 ramp_color(const RampFragment& ramp, float at) {
  const auto& points = ramp.points;
  if (points.empty()) return glm::vec3(0.0f);
  const auto next = std::find_if(points.begin(), points.end(), [&](const RampPoint& p) { return p.position > at; });
  if (next == points.begin()) return points.front().color;
  if (next == points.end()) return points.back().color;
  const RampPoint& before = *(next - 1);
  float t = (at - before.position) / (next->position - before.position);
  if (ramp.kind == RampKind::square) t = 0.0f;
  if (ramp.kind == RampKind::smooth) t = t * t * (3.0f - 2.0f * t);
  return glm::mix(before.color, next->color, t);
}

class Evaluation {
 public:
  explicit Evaluation(const MaterialData& material) : material_(material) {}

  Lobes at(FragmentId id) {
    const auto fragment = material_.fragments.find(id);
    if (fragment == material_.fragments.end() || depth_ >= deepest) return {};
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    known_[id] = {};  // Value that a loop finds when it closes.
    ++depth_;
    const Lobes lobes = std::visit(*this, fragment->second);
    --depth_;
    return known_[id] = lobes;
  }

  Lobes operator()(const ColorFragment& f) { return plain(f.color); }
  Lobes operator()(const LightFragment& f) {
    Lobes lobes;
    if (f.kind == LightKind::direct || f.kind == LightKind::direct_and_ambient) lobes.lit.color = glm::vec3(1.0f);
    return lobes;
  }
  Lobes operator()(const ReflectionFragment&) {
    Lobes lobes;
    lobes.mirror.color = glm::vec3(1.0f);
    return lobes;
  }
  Lobes operator()(const TransparencyFragment& f) {
    Lobes lobes;
    lobes.through.color = glm::vec3(1.0f);
    lobes.refraction_index = f.refraction_index;
    return lobes;
  }
  Lobes operator()(const VolumeFragment& f) { return plain(f.color); }
  Lobes operator()(const ViewFragment&) { return plain(glm::vec3(0.5f)); }
  Lobes operator()(const GeometryFragment&) { return plain(glm::vec3(0.5f)); }
  Lobes operator()(const TextureFragment& f) { return plain(glm::vec3(1.0f), f.bitmap); }
  Lobes operator()(const NoiseFragment& f) {
    const bool positive = f.kind == NoiseKind::perlin_zero_to_one || f.kind == NoiseKind::point_zero_to_one;
    return plain(glm::vec3(positive ? 0.5f : 0.0f));
  }
  Lobes operator()(const BlenderFragment& f) {
    const Lobes a = at(f.a), b = at(f.b);
    switch (f.kind) {
      case BlendKind::fade: {
        const float t = std::clamp(mean(at(f.control).plain.color), 0.0f, 1.0f);
        return combined(a, b, [&](glm::vec3 x, glm::vec3 y) { return glm::mix(x, y, t); });
      }
      case BlendKind::add:
        return combined(a, b, [](glm::vec3 x, glm::vec3 y) { return x + y; });
      case BlendKind::subtract:
        return combined(a, b, [](glm::vec3 x, glm::vec3 y) { return glm::max(x - y, glm::vec3(0.0f)); });
      case BlendKind::multiply:
        return b.is_plain() ? scaled(a, b.plain) : scaled(b, a.plain);
      case BlendKind::divide: {
        const glm::vec3 by = b.plain.color;
        const auto over = [](float divisor) { return divisor == 0.0f ? 0.0f : 1.0f / divisor; };
        return scaled(a, {glm::vec3(over(by.r), over(by.g), over(by.b)), no_node});
      }
    }
    return {};
  }
  Lobes operator()(const ClampFragment& f) {
    Lobes lobes = at(f.data);
    lobes.plain.color = f.minimum ? glm::max(lobes.plain.color, f.limit) : glm::min(lobes.plain.color, f.limit);
    return lobes;
  }
  Lobes operator()(const MatrixFragment& f) {
    Lobes lobes = at(f.data);
    glm::vec3 result;
    for (int row = 0; row < 3; ++row) {
      const float* m = &f.matrix[static_cast<std::size_t>(row) * 4];
      result[row] = glm::dot(glm::vec3(m[0], m[1], m[2]), lobes.plain.color) + m[3];
    }
    lobes.plain.color = result;
    return lobes;
  }
  Lobes operator()(const RampFragment& f) {
    Lobes lobes = at(f.mapping);
    lobes.plain = {ramp_color(f, ramp_parameter(f, lobes.plain.color)), no_node};
    return lobes;
  }
  Lobes operator()(const AnimationFragment&) { return plain(glm::vec3(0.5f)); }
  Lobes operator()(const AlternativeFragment& f) { return at(material_.fragments.contains(f.a) ? f.a : f.b); }
  Lobes operator()(const OutputFragment& f) { return at(f.front); }

 private:
  const MaterialData& material_;
  std::map<FragmentId, Lobes> known_;
  int depth_ = 0;
};

Lobes evaluate_output(const MaterialData& material) {
  for (const auto& [id, fragment] : material.fragments)
    if (const auto* output = std::get_if<OutputFragment>(&fragment); output && output->label == "color")
      return Evaluation(material).at(output->front);
  Lobes grey;
  grey.lit.color = SurfaceMaterial{}.base_color;
  return grey;
}

template <class T>
T tag_or(const Node& node, const char* name, T otherwise) {
  const TagValue* value = find_tag(node, "surface", name);
  const T* typed = value ? std::get_if<T>(value) : nullptr;
  return typed ? *typed : otherwise;
}

/// Finite and moderate numbers for a renderer, for any tree.
glm::vec3 moderate(const glm::vec3& color, float most) {
  const auto one = [&](float value) { return value > 0.0f ? std::min(value, most) : 0.0f; };
  return {one(color.r), one(color.g), one(color.b)};
}

}  // namespace

SurfaceMaterial evaluate_material(const Node& node, const std::function<std::int32_t(NodeId)>& image_of) {
  const auto* data = std::get_if<MaterialData>(&node.data);
  SurfaceMaterial material;
  if (!data) return material;
  const Lobes lobes = evaluate_output(*data);

  const float through = std::clamp(mean(lobes.through.color), 0.0f, 1.0f);
  const float mirror = mean(lobes.mirror.color), lit = mean(lobes.lit.color);
  const Lobe& base = lit > 0.0f ? lobes.lit : lobes.mirror;
  const float opaque = 1.0f - through;
  material.base_color = moderate(opaque > 0.0f ? base.color / opaque : base.color, 1.0f);
  if (base.image != no_node) material.base_color_image = image_of(base.image);
  material.opacity = opaque;
  material.refraction_index = std::clamp(lobes.refraction_index, 1.0f, 4.0f);
  material.emission = moderate(lobes.plain.color, 1e6f);
  const bool polished = mirror > 0.0f;
  const double metallic = polished ? std::clamp(mirror / (mirror + std::max(lit, 0.0f)), 0.0f, 1.0f) : 0.0;
  const double roughness = polished ? 0.1 : material.roughness;
  material.metallic = static_cast<float>(std::clamp(tag_or(node, "metallic", metallic), 0.0, 1.0));
  material.roughness = static_cast<float>(std::clamp(tag_or(node, "roughness", roughness), 0.0, 1.0));
  material.takes_paint = tag_or(node, "takes_paint", false);
  material.wettable = tag_or(node, "wettable", false);
  material.stripe = tag_or(node, "stripe", false);
  material.retroreflection = static_cast<float>(std::clamp(tag_or(node, "retroreflection", 0.0), 0.0, 1e4));
  material.picture_columns = std::clamp(tag_or(node, "picture_columns", 1u), 1u, 64u);
  material.picture_rows = std::clamp(tag_or(node, "picture_rows", 1u), 1u, 64u);
  material.clear_coat = static_cast<float>(std::clamp(tag_or(node, "clear_coat", 0.0), 0.0, 1.0));
  material.share_of_sky = static_cast<float>(std::clamp(tag_or(node, "share_of_sky", 1.0), 0.0, 1.0));
  material.two_sided = tag_or(node, "two_sided", false);
  material.ambient_share = static_cast<float>(std::clamp(tag_or(node, "ambient_share", 1.0), 0.0, 1.0));
  material.lit_by_night = tag_or(node, "lit_by_night", false);
  material.in_street = tag_or(node, "in_street", false);
  for (std::size_t map = 0; map < surface_map_count; ++map)
    if (const NodeId bitmap = tag_or(node, surface_map_tags[map], NodeReference{}).node; bitmap != no_node)
      material.maps.values[map] = image_of(bitmap);
  material.by_second_uv = tag_or(node, "by_second_uv", 0u) & ((1u << surface_map_count) - 1u);
  return material;
}

}  // namespace septet::scene
