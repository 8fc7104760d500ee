#include "engine/scene/material_constants.hpp"

#include <set>
#include <string_view>
#include <variant>

#include <fmt/format.h>

namespace septet::scene {
namespace {

struct ConstantOf {
  std::string_view operator()(const LightFragment& f) const {
    if (f.brdf_bitmap != no_node) return "light: its BRDF bitmap is left out; the surface is matt";
    if (f.kind != LightKind::direct && f.kind != LightKind::direct_and_ambient)
      return "light: from behind, and ambient light alone, are black";
    return f.normal_falloff != 1.0f ? "light: normal_falloff is 1" : "";
  }
  std::string_view operator()(const ReflectionFragment& f) const {
    return f.normal_falloff != 1.0f ? "reflection: normal_falloff is 1" : "";
  }
  std::string_view operator()(const TransparencyFragment& f) const {
    return f.normal_falloff != 1.0f ? "transparency: normal_falloff is 1" : "";
  }
  std::string_view operator()(const VolumeFragment& f) const {
    return f.diffusion != 0.0f ? "volume: its colour all over; diffusion is 0" : "volume: its colour all over";
  }
  std::string_view operator()(const ViewFragment&) const { return "view: 0.5 in each channel"; }
  std::string_view operator()(const AnimationFragment&) const { return "animation: 0.5 in each channel"; }
  std::string_view operator()(const GeometryFragment& f) const {
    for (const std::string& layer : {f.layer_x, f.layer_y, f.layer_z})
      if (!layer.empty() && layer != "map_u" && layer != "map_v")
        return "geometry: layers other than map_u and map_v are 0.5";
    return "";
  }
  std::string_view operator()(const OutputFragment& f) const {
    if (f.label == "displacement") return "output: displacement is left out";
    return f.back != no_fragment ? "output: back is left out; both sides show the front" : "";
  }
  template <class Other>
  std::string_view operator()(const Other&) const {
    return "";
  }
};

}  // namespace

std::string_view constant_of(const Fragment& fragment) { return std::visit(ConstantOf{}, fragment); }

std::vector<std::string> constant_fragments(const Node& material) {
  std::vector<std::string> sentences;
  const auto* data = std::get_if<MaterialData>(&material.data);
  if (!data) return sentences;
  std::set<std::string_view> said;
  for (const auto& [id, fragment] : data->fragments)
    if (const std::string_view constant = constant_of(fragment); !constant.empty() && said.insert(constant).second)
      sentences.push_back(fmt::format("fragment {}, {}", id, constant));
  return sentences;
}

}  // namespace septet::scene
