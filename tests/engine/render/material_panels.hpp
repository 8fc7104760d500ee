#pragma once
/// Sixteen panels, one for each kind of fragment, that fill the view of plate_view, four by four; and what each has to
/// look like, by formulas that know nothing of the product's evaluation (but for noise, whose values are its own).

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/builder.hpp"
#include "engine/scene/fragment_noise.hpp"
#include "engine/scene/resolve.hpp"

namespace septet::render::fragments {

using namespace scene;

/// The quantity that a panel shows; `one` and `nothing` are the trees of its greatest and least value.
enum class Shows : std::uint8_t { emission, lit, mirrored, opacity };

struct Panel {
  std::string name;
  Shows shows = Shows::emission;
  std::vector<Fragment> tree;  ///< By their ids; the first is shown.
  std::function<glm::vec3(float u, float v)> reference;
};

inline glm::vec3 quarter_color(float u, float v) {
  const bool right = u - std::floor(u) >= 0.5f, below = v - std::floor(v) >= 0.5f;
  return {right ? 1.0f : 0.0f, below ? 1.0f : 0.0f, right == below ? 0.2f : 0.6f};
}

inline std::vector<Fragment> scaled_surface(Fragment first, FragmentId mapping, float factor) {
  MatrixFragment matrix;
  matrix.matrix = {factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  matrix.data = static_cast<FragmentId>(mapping + 1);
  return {std::move(first), matrix, GeometryFragment{"map_u", "map_v", ""}};
}

inline std::vector<Panel> panels(NodeId quarters) {
  const GeometryFragment uv{"map_u", "map_v", ""}, u_alone{"map_u", "map_u", "map_u"};
  const auto multiply = [](FragmentId a, FragmentId b) {
    return BlenderFragment{BlendKind::multiply, a, b, no_fragment};
  };
  const auto surface = [](float u, float v) { return glm::vec3(u, v, 0.0f); };
  const glm::vec3 orange(0.8f, 0.4f, 0.2f), red(1, 0, 0), blue(0, 0, 1);
  MatrixFragment turned;
  turned.matrix = {0, 1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 1};
  turned.data = 1;
  MatrixFragment thinning;  // From 0.1 to 1 along u.
  thinning.matrix = {0.9f, 0, 0, 0.1f, 0, 0.9f, 0, 0.1f, 0, 0, 0.9f, 0.1f, 0, 0, 0, 1};
  thinning.data = 4;
  const std::vector<RampPoint> points{{0.25f, red}, {0.75f, blue}};
  return {{"color", Shows::emission, {ColorFragment{orange}}, [=](float, float) { return orange; }},
          {"light", Shows::lit, {multiply(1, 2), uv, LightFragment{}}, surface},
          {"reflection", Shows::mirrored, {multiply(1, 2), uv, ReflectionFragment{}}, surface},
          {"transparency",
           Shows::opacity,
           {BlenderFragment{BlendKind::fade, 1, 2, 3}, LightFragment{}, TransparencyFragment{}, thinning, u_alone},
           [](float u, float) { return glm::vec3(1.0f - u); }},
          {"volume",
           Shows::emission,
           {multiply(1, 2), VolumeFragment{0.0f, orange}, uv},
           [=](float u, float v) { return orange * surface(u, v); }},
          {"view", Shows::emission, {ViewFragment{}}, [](float, float) { return glm::vec3(0.5f); }},
          {"geometry", Shows::emission, {uv}, surface},
          {"texture", Shows::emission,
           scaled_surface(TextureFragment{quarters, "color_b", "color_g", "color_r", false, 1}, 1, 2.0f),
           [](float u, float v) {
             const glm::vec3 color = quarter_color(2.0f * u, 2.0f * v);
             return glm::vec3(color.b, color.g, color.r);
           }},
          {"noise", Shows::emission, scaled_surface(NoiseFragment{NoiseKind::perlin_zero_to_one, 1}, 1, 2.0f),
           [](float u, float v) {
             return glm::vec3(noise_at(NoiseKind::perlin_zero_to_one, {2.0f * u, 2.0f * v, 0.0f}));
           }},
          {"blender",
           Shows::emission,
           {BlenderFragment{BlendKind::fade, 1, 2, 3}, ColorFragment{red}, ColorFragment{blue}, u_alone},
           [=](float u, float) { return glm::mix(red, blue, u); }},
          {"clamp",
           Shows::emission,
           {ClampFragment{true, glm::vec3(0.3f), 1}, uv},
           [=](float u, float v) { return glm::max(surface(u, v), glm::vec3(0.3f)); }},
          {"matrix", Shows::emission, {turned, uv}, [](float u, float v) { return glm::vec3(v, u, 1.0f - u); }},
          {"ramp",
           Shows::emission,
           {RampFragment{RampKind::linear, RampChannel::green, 1, points}, uv},
           [=](float, float v) { return glm::mix(red, blue, glm::clamp(2.0f * v - 0.5f, 0.0f, 1.0f)); }},
          {"animation",
           Shows::emission,
           {multiply(1, 2), AnimationFragment{}, uv},
           [=](float u, float v) { return 0.5f * surface(u, v); }},
          {"alternative",
           Shows::emission,
           {AlternativeFragment{77, 1},
            RampFragment{RampKind::square, RampChannel::red, 2, {{0.0f, red}, {0.5f, blue}}}, uv},
           [=](float u, float) { return u < 0.5f ? red : blue; }},
          {"output",
           Shows::emission,
           {OutputFragment{"other", 1, 2}, GeometryFragment{"map_v", "map_u", ""}, ColorFragment{blue}},
           [](float u, float v) { return glm::vec3(v, u, 0.0f); }}};
}

/// The tree whose every channel is as much as can be, or nothing, of what a panel shows.
inline std::vector<Fragment> even_tree(Shows shows, bool full) {
  switch (shows) {
    case Shows::emission:
      return {ColorFragment{glm::vec3(full ? 1.0f : 0.0f)}};
    case Shows::lit:
      if (full) return {LightFragment{}};
      return {ColorFragment{}};
    case Shows::mirrored:
      if (full) return {ReflectionFragment{}};
      return {ColorFragment{}};
    case Shows::opacity:
      // Panes of at most 0.9: what a pane mirrors adds to its opacity, up to 1, and opaque surfaces have less gloss.
      if (full)
        return {BlenderFragment{BlendKind::fade, 1, 2, 3}, LightFragment{}, TransparencyFragment{},
                ColorFragment{glm::vec3(0.1f)}};
      return {TransparencyFragment{}};
  }
  return {};
}

inline NodeId add_quarters(SceneBuilder& builder) {
  constexpr std::uint32_t side = 64;
  std::vector<std::uint8_t> rgba;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const glm::vec3 color =
          quarter_color((static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side);
      for (int c = 0; c < 3; ++c) rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0f * color[c])));
      rgba.push_back(255);
    }
  return builder.add_bitmap("quarters", side, side, rgba, false);
}

enum class Trees : std::uint8_t { own, full, nothing };

/// The sixteen panels, upright 8 m east of the eye of plate_view.
inline ResolvedScene panel_scene(Trees trees) {
  Store store;
  SceneBuilder builder(store);
  const NodeId quarters = add_quarters(builder);
  const float half_m = 8.0f * std::tan(0.3f), side_m = half_m / 2.0f;
  geometry::PolygonMesh quad;
  quad.vertices_m = {{0, 0, 0}, {0, 0, -side_m}, {0, -side_m, -side_m}, {0, -side_m, 0}};
  quad.polygons = {{0, 1, 2, 3}};
  quad.corner_uvs = {{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}};
  const NodeId mesh = builder.add_mesh("panel", quad);
  const std::vector<Panel> all = panels(quarters);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const NodeId material = builder.add_material(all[i].name, {});
    const std::vector<Fragment> tree =
        trees == Trees::own ? all[i].tree : even_tree(all[i].shows, trees == Trees::full);
    const auto made = std::get<MaterialData>(store.find(material)->data).fragments;
    for (const auto& [id, fragment] : made) builder.apply(FragmentDestroy{material, id});
    for (FragmentId id = 0; id < tree.size(); ++id) builder.apply(FragmentSet{material, id, tree[id]});
    builder.apply(FragmentSet{material, 1000, OutputFragment{"color", 0, no_fragment}});
    // The tree says what the finish is.
    builder.apply(TagGroupDestroy{material, store.find(material)->tag_groups.begin()->first});
    ObjectParameters object;
    object.geometry = mesh;
    object.materials = {material};
    object.parent_from_object.position_m = {8.0, double(half_m) - double(side_m) * double(i % 4),
                                            1.2 + double(half_m) - double(side_m) * double(i / 4)};
    builder.add_object(all[i].name, object);
  }
  return resolve(store);
}

}  // namespace septet::render::fragments
