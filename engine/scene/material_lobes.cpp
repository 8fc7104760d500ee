#include "engine/scene/material_lobes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/scene/fragment_noise.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {
namespace {

constexpr int deepest = 64;  ///< Depth limit of a tree; deeper parts are black.

bool is_black(const Lobe& lobe) { return lobe.color == glm::vec3(0.0f); }

Lobes plain(const glm::vec3& color, NodeId image = no_node) {
  Lobes lobes;
  lobes.plain = {color, image};
  return lobes;
}

/// True where one image can stand for a combination of both.
bool share_an_image(const Lobe& x, const Lobe& y) { return x.image == y.image || is_black(x) || is_black(y); }

/// Combines the lobes one by one; of two images the first stays.
template <class Combine>
Lobes combined(const Lobes& a, const Lobes& b, Combine combine) {
  Lobes result;
  const auto one = [&](const Lobe& x, const Lobe& y) {
    result.exact = result.exact && share_an_image(x, y);
    return Lobe{combine(x.color, y.color), x.image != no_node ? x.image : y.image};
  };
  result.exact = a.exact && b.exact;
  result.plain = one(a.plain, b.plain);
  result.lit = one(a.lit, b.lit);
  result.mirror = one(a.mirror, b.mirror);
  result.through = one(a.through, b.through);
  result.refraction_index = a.through.color != glm::vec3(0.0f) ? a.refraction_index : b.refraction_index;
  result.alpha = std::min(a.alpha, b.alpha);
  return result;
}

Lobes scaled(const Lobes& lobes, const Lobe& by) {
  Lobes result = lobes;
  for (Lobe* lobe : {&result.plain, &result.lit, &result.mirror, &result.through}) {
    const bool empty = is_black(*lobe);
    if (!empty && lobe->image != no_node && by.image != no_node) result.exact = false;
    lobe->color *= by.color;
    if (lobe->image == no_node && !empty) lobe->image = by.image;
  }
  return result;
}

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
  explicit Evaluation(const MaterialData& material) {
    known_.reserve(material.fragments.size());
    for (const auto& [id, fragment] : material.fragments) known_.push_back({id, &fragment});
    for (const Known& known : known_)
      if (const auto* output = std::get_if<OutputFragment>(known.fragment); output && output->label == "color") {
        output_ = output;
        return;
      }
  }

  /// Of the output; `place` null: of the surface as a whole.
  Lobes evaluate(const SurfacePlace* place) {
    if (!output_) {
      Lobes grey;
      grey.lit.color = SurfaceMaterial{}.base_color;
      return grey;
    }
    place_ = place;
    ++round_;
    Lobes lobes = at(output_->front);
    // Opacity, and the share of lit and mirror, are numbers of the whole surface.
    const bool shares_vary = (lobes.through.image != no_node && !is_black(lobes.through)) ||
                             (!is_black(lobes.mirror) && !is_black(lobes.lit) && lobes.mirror.image != lobes.lit.image);
    lobes.exact = lobes.exact && !shares_vary;
    return lobes;
  }

  /// Until the next round.
  const Lobes& at(FragmentId id) {
    Known* known = find(id);
    if (!known || depth_ >= deepest) return black_;
    if (known->round == round_ || known->is_everywhere) {
      reads_place_ = reads_place_ || !known->is_everywhere;
      return known->lobes;
    }
    known->lobes = {};  // Value that a loop finds when it closes.
    known->round = round_;
    const bool read_before = std::exchange(reads_place_, false);
    ++depth_;
    known->lobes = std::visit(*this, *known->fragment);
    --depth_;
    known->is_everywhere = place_ && !reads_place_;
    reads_place_ = reads_place_ || read_before;
    return known->lobes;
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
  Lobes operator()(const GeometryFragment& f) {
    bool varies = false;
    const auto layer = [&](std::string_view name) {
      const bool is_u = name == "map_u", is_v = name == "map_v";
      varies = varies || is_u || is_v;
      if (name.empty()) return 0.0f;
      reads_place_ = reads_place_ || varies;
      return place_ && (is_u || is_v) ? (is_u ? place_->uv.x : place_->uv.y) : 0.5f;
    };
    Lobes lobes = plain({layer(f.layer_x), layer(f.layer_y), layer(f.layer_z)});
    lobes.exact = !varies;
    return lobes;
  }
  Lobes operator()(const TextureFragment& f) {
    if (!place_) {
      Lobes lobes = plain(glm::vec3(1.0f), f.bitmap);
      lobes.exact = f.filtered && is_surface(f.mapping) && is_named(f.layer_red, "color_r") &&
                    is_named(f.layer_green, "color_g") && is_named(f.layer_blue, "color_b");
      return lobes;
    }
    reads_place_ = true;
    const glm::vec4 read = place_->texture(f, glm::vec2(mapped(f.mapping)));
    Lobes lobes = plain(glm::vec3(read));
    lobes.alpha = read.a;
    return lobes;
  }
  Lobes operator()(const NoiseFragment& f) {
    reads_place_ = true;
    if (place_) return plain(glm::vec3(noise_at(f.kind, mapped(f.mapping))));
    const bool positive = f.kind == NoiseKind::perlin_zero_to_one || f.kind == NoiseKind::point_zero_to_one;
    Lobes lobes = plain(glm::vec3(positive ? 0.5f : 0.0f));
    lobes.exact = false;
    return lobes;
  }
  Lobes operator()(const BlenderFragment& f) {
    const Lobes &a = at(f.a), &b = at(f.b);
    switch (f.kind) {
      case BlendKind::fade: {
        const Lobes& control = at(f.control);
        const float t = std::clamp(mean_of_channels(control.plain.color), 0.0f, 1.0f);
        Lobes faded = combined(a, b, [&](glm::vec3 x, glm::vec3 y) { return glm::mix(x, y, t); });
        faded.exact = faded.exact && control.exact && control.plain.image == no_node;
        return faded;
      }
      case BlendKind::add:
        return combined(a, b, [](glm::vec3 x, glm::vec3 y) { return x + y; });
      case BlendKind::subtract:
        return combined(a, b, [](glm::vec3 x, glm::vec3 y) { return glm::max(x - y, glm::vec3(0.0f)); });
      case BlendKind::multiply:
        return multiplied(a, b);
      case BlendKind::divide: {
        const glm::vec3 by = b.plain.color;
        const auto over = [](float divisor) { return divisor == 0.0f ? 0.0f : 1.0f / divisor; };
        Lobes divided = scaled(a, {glm::vec3(over(by.r), over(by.g), over(by.b)), no_node});
        divided.exact = divided.exact && b.exact && b.plain.image == no_node;
        return divided;
      }
    }
    return {};
  }
  Lobes operator()(const ClampFragment& f) {
    Lobes lobes = without_image(at(f.data));
    lobes.plain.color = f.minimum ? glm::max(lobes.plain.color, f.limit) : glm::min(lobes.plain.color, f.limit);
    return lobes;
  }
  Lobes operator()(const MatrixFragment& f) {
    Lobes lobes = without_image(at(f.data));
    glm::vec3 result;
    for (int row = 0; row < 3; ++row) {
      const float* m = &f.matrix[static_cast<std::size_t>(row) * 4];
      result[row] = glm::dot(glm::vec3(m[0], m[1], m[2]), lobes.plain.color) + m[3];
    }
    lobes.plain.color = result;
    return lobes;
  }
  Lobes operator()(const RampFragment& f) {
    Lobes lobes = without_image(at(f.mapping));
    lobes.plain = {ramp_color(f, lobes.plain.color[static_cast<int>(f.channel)]), no_node};
    return lobes;
  }
  Lobes operator()(const AnimationFragment&) { return plain(glm::vec3(0.5f)); }
  Lobes operator()(const AlternativeFragment& f) { return at(find(f.a) ? f.a : f.b); }
  Lobes operator()(const OutputFragment& f) { return at(f.front); }

 private:
  static bool is_named(const std::string& name, std::string_view usual) { return name.empty() || name == usual; }

  /// True where a mapping is the surface's own coordinates.
  bool is_surface(FragmentId mapping) {
    const Known* found = find(mapping);
    if (!found) return true;
    const auto* geometry = std::get_if<GeometryFragment>(found->fragment);
    return geometry && geometry->layer_x == "map_u" && geometry->layer_y == "map_v";
  }

  /// A mapping that is missing is the surface's own coordinates.
  glm::vec3 mapped(FragmentId mapping) { return find(mapping) ? at(mapping).plain.color : glm::vec3(place_->uv, 0.0f); }

  static Lobes multiplied(const Lobes& a, const Lobes& b) {
    Lobes product = b.is_plain() ? scaled(a, b.plain) : scaled(b, a.plain);
    product.exact = product.exact && a.exact && b.exact;
    product.alpha = std::min(a.alpha, b.alpha);
    return product;
  }

  /// What is done to a picture's mean is not what would be done to the picture.
  static Lobes without_image(Lobes lobes) {
    lobes.exact = lobes.exact && lobes.plain.image == no_node;
    return lobes;
  }

  struct Known {
    FragmentId id = no_fragment;
    const Fragment* fragment = nullptr;
    Lobes lobes{};
    std::uint64_t round = 0;     ///< In which `lobes` were evaluated.
    bool is_everywhere = false;  ///< They are the same at all places.
  };
  Known* find(FragmentId id) {
    const auto found = std::ranges::lower_bound(known_, id, {}, &Known::id);
    return found != known_.end() && found->id == id ? &*found : nullptr;
  }

  const Lobes black_{};
  const OutputFragment* output_ = nullptr;
  const SurfacePlace* place_ = nullptr;
  std::vector<Known> known_;  ///< By id.
  std::uint64_t round_ = 0;
  int depth_ = 0;
  bool reads_place_ = false;  ///< What is being evaluated depends on the place.
};

}  // namespace

struct LobesAtPlaces::State {
  Evaluation evaluation;
};

LobesAtPlaces::LobesAtPlaces(const MaterialData& material)
    : state_(std::make_unique<State>(State{Evaluation(material)})) {}
LobesAtPlaces::~LobesAtPlaces() = default;

Lobes LobesAtPlaces::at(const SurfacePlace& place) { return state_->evaluation.evaluate(&place); }

Lobes evaluate_lobes(const MaterialData& material) { return Evaluation(material).evaluate(nullptr); }

}  // namespace septet::scene
