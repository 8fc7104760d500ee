#pragma once
/// The fields of each command and fragment, in their order on every carrier: bytes (COMMANDS.md) and text (command_text.hpp).
///
/// `C` writes or reads: Writer and Reader of field_codec.hpp, and those of the text form.

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/scene/command.hpp"
#include "engine/scene/command_limits.hpp"
#include "engine/scene/field_codec.hpp"

namespace septet::scene {

// ---- fragments

template <class C>
void fields(C& c, Ref<C, ColorFragment> v) {
  vec3(c, v.color);
}
template <class C>
void fields(C& c, Ref<C, LightFragment> v) {
  c.kind(v.kind, LightKind::back_direct_and_ambient);
  c.real(v.normal_falloff);
  c.node(v.brdf_bitmap);
  c.text(v.brdf_red, max_name_bytes), c.text(v.brdf_green, max_name_bytes);
  c.text(v.brdf_blue, max_name_bytes);
}
template <class C>
void fields(C& c, Ref<C, ReflectionFragment> v) {
  c.real(v.normal_falloff);
}
template <class C>
void fields(C& c, Ref<C, TransparencyFragment> v) {
  c.real(v.normal_falloff), c.real(v.refraction_index);
}
template <class C>
void fields(C& c, Ref<C, VolumeFragment> v) {
  c.real(v.diffusion), vec3(c, v.color);
}
template <class C>
void fields(C&, Ref<C, ViewFragment>) {}
template <class C>
void fields(C& c, Ref<C, GeometryFragment> v) {
  c.text(v.layer_x, max_name_bytes), c.text(v.layer_y, max_name_bytes);
  c.text(v.layer_z, max_name_bytes);
}
template <class C>
void fields(C& c, Ref<C, TextureFragment> v) {
  c.node(v.bitmap);
  c.text(v.layer_red, max_name_bytes), c.text(v.layer_green, max_name_bytes);
  c.text(v.layer_blue, max_name_bytes);
  c.flag(v.filtered), c.fragment(v.mapping);
}
template <class C>
void fields(C& c, Ref<C, NoiseFragment> v) {
  c.kind(v.kind, NoiseKind::point_minus_one_to_one), c.fragment(v.mapping);
}
template <class C>
void fields(C& c, Ref<C, BlenderFragment> v) {
  c.kind(v.kind, BlendKind::divide), c.fragment(v.a), c.fragment(v.b), c.fragment(v.control);
}
template <class C>
void fields(C& c, Ref<C, ClampFragment> v) {
  c.flag(v.minimum), vec3(c, v.limit), c.fragment(v.data);
}
template <class C>
void fields(C& c, Ref<C, MatrixFragment> v) {
  for (auto& element : v.matrix) c.real(element);
  c.fragment(v.data);
}
template <class C>
void fields(C& c, Ref<C, RampFragment> v) {
  c.kind(v.kind, RampKind::smooth), c.kind(v.channel, RampChannel::blue), c.fragment(v.mapping);
  c.count(v.points, RampFragment::max_points);
  for (auto& point : v.points) c.real(point.position), vec3(c, point.color);
}
template <class C>
void fields(C& c, Ref<C, AnimationFragment> v) {
  c.text(v.label, max_name_bytes);
}
template <class C>
void fields(C& c, Ref<C, AlternativeFragment> v) {
  c.fragment(v.a), c.fragment(v.b);
}
template <class C>
void fields(C& c, Ref<C, OutputFragment> v) {
  c.text(v.label, max_name_bytes), c.fragment(v.front), c.fragment(v.back);
}

// ---- tag values

template <class C>
void fields(C& c, Ref<C, bool> v) {
  c.flag(v);
}
template <class C>
void fields(C& c, Ref<C, std::uint32_t> v) {
  c.number(v);
}
template <class C>
void fields(C& c, Ref<C, double> v) {
  c.real(v);
}
template <class C>
void fields(C& c, Ref<C, std::string> v) {
  c.text(v, max_tag_string_bytes);
}
template <class C>
void fields(C& c, Ref<C, Vec3> v) {
  vec3(c, v);
}
template <class C>
void fields(C& c, Ref<C, NodeReference> v) {
  c.node(v.node);
}
template <class C>
void fields(C& c, Ref<C, Blob> v) {
  c.bytes(v, max_tag_blob_bytes);
}

template <>
inline constexpr std::size_t free_code<Command> = 13;

/// A variant: which alternative, then its fields.
template <class C, class V>
void variant(C& c, V& value);

// ---- commands

template <class C>
void fields(C& c, Ref<C, NodeIndexSubscribe> v) {
  c.number(v.type_mask);
}
template <class C>
void fields(C& c, Ref<C, NodeSubscribe> v) {
  c.node(v.node), c.flag(v.subscribe);
}
template <class C>
void fields(C& c, Ref<C, PartSubscribe> v) {
  c.node(v.node), c.kind(v.kind, PartKind::layer), c.part(v.part), c.flag(v.subscribe);
}
template <class C>
void fields(C& c, Ref<C, NodeCreate> v) {
  c.node(v.node), c.kind(v.type, NodeType::bitmap);
}
template <class C>
void fields(C& c, Ref<C, NodeDestroy> v) {
  c.node(v.node);
}
template <class C>
void fields(C& c, Ref<C, NodeNameSet> v) {
  c.node(v.node), c.text(v.name, max_name_bytes);
}
template <class C>
void fields(C& c, Ref<C, TagGroupSet> v) {
  c.node(v.node), c.part(v.group), c.text(v.name, max_name_bytes);
}
template <class C>
void fields(C& c, Ref<C, TagGroupDestroy> v) {
  c.node(v.node), c.part(v.group);
}
template <class C>
void fields(C& c, Ref<C, TagSet> v) {
  c.node(v.node), c.part(v.group), c.part(v.tag), c.text(v.value.name, max_name_bytes);
  variant(c, v.value.value);
}
template <class C>
void fields(C& c, Ref<C, TagDestroy> v) {
  c.node(v.node), c.part(v.group), c.part(v.tag);
}
template <class C>
void fields(C& c, Ref<C, TransformSet> v) {
  auto& t = v.transform;
  c.node(v.node), vec3(c, t.position_m);
  bool turned = t.rotation != Quat(1.0, 0.0, 0.0, 0.0), scaled = t.scale != glm::vec3(1.0f);
  c.what_follows(turned, scaled);
  if (turned) c.real(t.rotation.w), c.real(t.rotation.x), c.real(t.rotation.y), c.real(t.rotation.z);
  if (scaled) vec3(c, t.scale);
}
template <class C>
void fields(C& c, Ref<C, LinkSet> v) {
  c.node(v.node), c.part(v.link), c.text(v.value.label, max_name_bytes);
  c.node(v.value.target), c.number(v.value.target_id);
}
template <class C>
void fields(C& c, Ref<C, LinkDestroy> v) {
  c.node(v.node), c.part(v.link);
}
template <class C>
void fields(C& c, Ref<C, HideSet> v) {
  c.node(v.node), c.flag(v.hidden);
}
template <class C>
void fields(C& c, Ref<C, GeometrySizeSet> v) {
  c.node(v.node), c.number(v.vertices), c.number(v.polygons);
}
template <class C>
void fields(C& c, Ref<C, GeometryLayerSet> v) {
  c.node(v.node), c.part(v.layer), c.text(v.name, max_name_bytes);
  c.kind(v.type, LayerType::face_real), c.number(v.default_integer), c.real(v.default_real);
}
template <class C>
void fields(C& c, Ref<C, GeometryLayerDestroy> v) {
  c.node(v.node), c.part(v.layer);
}
template <class C>
void fields(C& c, Ref<C, VerticesSet> v) {
  c.node(v.node), c.number(v.first);
  if (const std::size_t count = c.count(v.positions_m, max_run_values / 3))
    c.reals({&v.positions_m[0].x, count * 3}, 3);
}
template <class C>
void fields(C& c, Ref<C, PolygonsSet> v) {
  c.node(v.node), c.number(v.first), c.count(v.polygons, max_run_values / 4);
  c.corners(v.polygons);
}
template <class C>
void fields(C& c, Ref<C, LayerIntegersSet> v) {
  c.node(v.node), c.part(v.layer), c.number(v.first), c.count(v.values, max_run_values);
  c.integers(v.values);
}
template <class C>
void fields(C& c, Ref<C, LayerRealsSet> v) {
  c.node(v.node), c.part(v.layer), c.number(v.first), c.count(v.values, max_run_values);
  c.reals(v.values, 1);
}
template <class C>
void fields(C& c, Ref<C, CreaseSet> v) {
  c.node(v.node), c.kind(v.kind, CreaseKind::edge);
  c.text(v.crease.layer, max_name_bytes), c.number(v.crease.default_value);
}
template <class C>
void fields(C& c, Ref<C, FragmentSet> v) {
  c.node(v.node), c.part(v.fragment), variant(c, v.value);
}
template <class C>
void fields(C& c, Ref<C, FragmentDestroy> v) {
  c.node(v.node), c.part(v.fragment);
}
template <class C>
void fields(C& c, Ref<C, BitmapSizeSet> v) {
  c.node(v.node), c.number(v.width), c.number(v.height), c.number(v.depth);
}
template <class C>
void fields(C& c, Ref<C, BitmapLayerSet> v) {
  c.node(v.node), c.part(v.layer), c.text(v.name, max_name_bytes), c.kind(v.type, PixelType::real64);
}
template <class C>
void fields(C& c, Ref<C, BitmapLayerDestroy> v) {
  c.node(v.node), c.part(v.layer);
}
template <class C>
void fields(C& c, Ref<C, BitmapTilesSet> v) {
  c.node(v.node), c.part(v.layer), c.number(v.first_tile), c.bytes(v.tiles, max_run_bytes);
}

template <class C>
void fields(C& c, Ref<C, MotionSet> v) {
  auto& m = v.motion;
  c.node(v.node), c.flag(v.from_now), vec3(c, m.position_m);
  c.real(m.rotation.w), c.real(m.rotation.x), c.real(m.rotation.y), c.real(m.rotation.z);
  c.count(m.legs, max_motion_legs);
  for (auto& leg : m.legs)
    c.real(leg.from_s), vec3(c, leg.velocity_mps), vec3(c, leg.acceleration_mps2), vec3(c, leg.turn_radps);
}

// ---- a variant

template <class C, class V>
void variant(C& c, V& value) {
  using Variant = std::remove_const_t<V>;
  if constexpr (C::writes) {
    c.template alternative<Variant>(value.index());
    std::visit([&](const auto& chosen) { fields<C>(c, chosen); }, value);
  } else {
    const std::size_t index = c.template alternative<Variant>();
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (void)((index == i && (fields<C>(c, value.template emplace<i>()), true)) || ...);
    }
    (std::make_index_sequence<std::variant_size_v<Variant>>());
  }
}

}  // namespace septet::scene
