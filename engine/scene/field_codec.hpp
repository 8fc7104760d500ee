#pragma once
/// The fields of commands in bytes (COMMANDS.md). Writer and Reader have the same functions, so that one description of
/// each command's fields serves both ways: command_fields.hpp.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/run_codec.hpp"

namespace septet::scene {

/// The code that no alternative of a variant has: codes are alternatives' indices, but for those from this one on.
template <class Variant>
inline constexpr std::size_t free_code = std::variant_npos;

/// Appends to the bytes given at construction.
struct Writer {
  static constexpr bool writes = true;
  ByteWriter out;

  void node(NodeId id) { out.put_varint(id + 1u); }
  void part(PartId id) { out.put_varint(id); }
  void fragment(FragmentId id) { out.put_varint(static_cast<FragmentId>(id + 1u)); }
  void number(std::uint32_t value) { out.put_varint(value); }
  void flag(bool value) { out.put(static_cast<std::uint8_t>(value)); }
  void real(float value) { out.put(value); }
  void real(double value) { out.put(value); }
  void text(const std::string& text, std::size_t) { out.put_string(text); }
  template <class Enumeration>
  void kind(Enumeration value, Enumeration) {
    out.put(static_cast<std::uint8_t>(value));
  }
  template <class T>
  std::size_t count(const std::vector<T>& values, std::size_t) {
    out.put_varint(values.size());
    return values.size();
  }
  void bytes(const std::vector<std::uint8_t>& bytes, std::size_t) {
    out.put_varint(bytes.size());
    out.put_bytes(std::as_bytes(std::span(bytes)));
  }
  void reals(std::span<const float> values, std::size_t stride) { put_reals(out, values, stride); }
  void integers(std::span<const std::uint32_t> values) { put_integers(out, values); }
  void corners(std::span<const PolygonCorners> polygons) { put_corners(out, polygons); }
  /// Of a transform.
  void what_follows(bool turned, bool scaled) {
    out.put(static_cast<std::uint8_t>((turned ? 1 : 0) | (scaled ? 2 : 0)));
  }
  template <class Variant>
  void alternative(std::size_t index) {
    out.put(static_cast<std::uint8_t>(index < free_code<Variant> ? index : index + 1));
  }
};

/// Values out of range put `in` into its failed state.
struct Reader {
  static constexpr bool writes = false;
  ByteReader& in;

  void node(NodeId& id) { id = static_cast<NodeId>(bounded(0xFFFFFFFFu) - 1u); }
  void part(PartId& id) { id = static_cast<PartId>(bounded(0xFFFF)); }
  void fragment(FragmentId& id) { id = static_cast<FragmentId>(bounded(0xFFFF) - 1u); }
  void number(std::uint32_t& value) { value = static_cast<std::uint32_t>(bounded(0xFFFFFFFFu)); }
  void flag(bool& value) {
    const auto byte = in.get<std::uint8_t>();
    if (byte > 1) in.fail();
    value = byte == 1;
  }
  void real(float& value) { value = in.get_float(); }
  void real(double& value) { value = in.get_double(); }
  void text(std::string& text, std::size_t limit) { text = in.get_string(limit); }
  template <class Enumeration>
  void kind(Enumeration& value, Enumeration last) {
    const auto byte = in.get<std::uint8_t>();
    if (byte > static_cast<std::uint8_t>(last)) return in.fail();
    value = static_cast<Enumeration>(byte);
  }
  /// Allocates the sender's claimed size only within the limit of one run.
  template <class T>
  std::size_t count(std::vector<T>& values, std::size_t limit) {
    values.resize(in.get_count(limit));
    return values.size();
  }
  void bytes(std::vector<std::uint8_t>& bytes, std::size_t limit) {
    const auto taken = in.take(in.get_count(limit));
    const auto* first = reinterpret_cast<const std::uint8_t*>(taken.data());
    bytes.assign(first, first + taken.size());
  }
  void reals(std::span<float> values, std::size_t stride) { get_reals(in, values, stride); }
  void integers(std::span<std::uint32_t> values) { get_integers(in, values); }
  void corners(std::span<PolygonCorners> polygons) { get_corners(in, polygons); }
  void what_follows(bool& turned, bool& scaled) {
    const auto flags = in.get<std::uint8_t>();
    if (flags > 3) in.fail();
    turned = flags & 1, scaled = flags & 2;
  }
  /// Its index; no alternative's after bad bytes.
  template <class Variant>
  std::size_t alternative() {
    const std::size_t code = in.get<std::uint8_t>();
    const std::size_t index = code < free_code<Variant> ? code : code - 1;
    if (code == free_code<Variant> || index >= std::variant_size_v<Variant>) in.fail();
    return in.ok() ? index : std::variant_npos;
  }

 private:
  std::uint64_t bounded(std::uint64_t largest) {
    const std::uint64_t value = in.get_varint();
    if (value > largest) in.fail();
    return value;
  }
};

/// A command to write, or one to read into.
template <class C, class T>
using Ref = std::conditional_t<C::writes, const T&, T&>;

template <class C>
void vec3(C& c, Ref<C, glm::vec3> v) {
  c.real(v.x), c.real(v.y), c.real(v.z);
}
template <class C>
void vec3(C& c, Ref<C, Vec3> v) {
  c.real(v.x), c.real(v.y), c.real(v.z);
}

}  // namespace septet::scene
