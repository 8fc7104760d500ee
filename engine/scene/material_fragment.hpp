#pragma once
/// The sixteen kinds of fragment of which a material node's shading tree is built.
///
/// Verse describes a material from scratch as a tree of simple operations (Brink, Steenberg and Svensson 2006, §2.5.2).
/// A fragment refers to others of its node by `FragmentId`, to bitmaps by node id and to geometry layers by name. A
/// reference may point at an object that does not exist (yet); evaluation then takes the neutral value that
/// CONVENTIONS.md gives. Colours are linear Rec. 709. Every number must be finite; the store refuses others.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

namespace septet::scene {

using NodeId = std::uint32_t;
inline constexpr NodeId no_node = 0xFFFFFFFFu;

using FragmentId = std::uint16_t;
inline constexpr FragmentId no_fragment = 0xFFFF;

struct ColorFragment {
  glm::vec3 color{0.0f};
  bool operator==(const ColorFragment&) const = default;
};

enum class LightKind : std::uint8_t {
  direct,
  ambient,
  direct_and_ambient,
  back_direct,
  back_ambient,
  back_direct_and_ambient
};
struct LightFragment {
  LightKind kind = LightKind::direct_and_ambient;
  float normal_falloff = 1.0f;
  NodeId brdf_bitmap = no_node;
  std::string brdf_red, brdf_green, brdf_blue;  ///< Layers of the bitmap.
  bool operator==(const LightFragment&) const = default;
};

struct ReflectionFragment {
  float normal_falloff = 1.0f;
  bool operator==(const ReflectionFragment&) const = default;
};

struct TransparencyFragment {
  float normal_falloff = 1.0f;
  float refraction_index = 1.0f;
  bool operator==(const TransparencyFragment&) const = default;
};

struct VolumeFragment {
  float diffusion = 0.0f;
  glm::vec3 color{1.0f};
  bool operator==(const VolumeFragment&) const = default;
};

struct ViewFragment {
  bool operator==(const ViewFragment&) const = default;
};

/// Reads three layers of the geometry (for example "map_u", "map_v").
struct GeometryFragment {
  std::string layer_x, layer_y, layer_z;
  bool operator==(const GeometryFragment&) const = default;
};

struct TextureFragment {
  NodeId bitmap = no_node;
  std::string layer_red, layer_green, layer_blue;  ///< Layers of the bitmap.
  bool filtered = true;
  FragmentId mapping = no_fragment;
  bool operator==(const TextureFragment&) const = default;
};

enum class NoiseKind : std::uint8_t {
  perlin_zero_to_one,
  perlin_minus_one_to_one,
  point_zero_to_one,
  point_minus_one_to_one
};
struct NoiseFragment {
  NoiseKind kind = NoiseKind::perlin_zero_to_one;
  FragmentId mapping = no_fragment;
  bool operator==(const NoiseFragment&) const = default;
};

enum class BlendKind : std::uint8_t { fade, add, subtract, multiply, divide };
struct BlenderFragment {
  BlendKind kind = BlendKind::fade;
  FragmentId a = no_fragment, b = no_fragment;
  FragmentId control = no_fragment;  ///< Control of a fade: 0 shows a, 1 shows b.
  bool operator==(const BlenderFragment&) const = default;
};

struct ClampFragment {
  bool minimum = false;  ///< The limit is a floor; otherwise a ceiling.
  glm::vec3 limit{1.0f};
  FragmentId data = no_fragment;
  bool operator==(const ClampFragment&) const = default;
};

struct MatrixFragment {
  std::array<float, 16> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  ///< Row by row.
  FragmentId data = no_fragment;
  bool operator==(const MatrixFragment&) const = default;
};

enum class RampKind : std::uint8_t { square, linear, smooth };
enum class RampChannel : std::uint8_t { red, green, blue };
struct RampPoint {
  float position = 0.0f;
  glm::vec3 color{0.0f};
  bool operator==(const RampPoint&) const = default;
};
struct RampFragment {
  static constexpr std::size_t max_points = 48;
  RampKind kind = RampKind::linear;
  RampChannel channel = RampChannel::red;  ///< Channel of `mapping` that runs along the ramp.
  FragmentId mapping = no_fragment;
  std::vector<RampPoint> points;  ///< Points, at least one; positions rise.
  bool operator==(const RampFragment&) const = default;
};

struct AnimationFragment {
  std::string label;  ///< Label of the object's link to a curve node.
  bool operator==(const AnimationFragment&) const = default;
};

/// Either of two trees of equal appearance; a renderer takes the one that it can draw best.
struct AlternativeFragment {
  FragmentId a = no_fragment, b = no_fragment;
  bool operator==(const AlternativeFragment&) const = default;
};

struct OutputFragment {
  std::string label;  ///< "color", "displacement", …
  FragmentId front = no_fragment, back = no_fragment;
  bool operator==(const OutputFragment&) const = default;
};

using Fragment =
    std::variant<ColorFragment, LightFragment, ReflectionFragment, TransparencyFragment, VolumeFragment, ViewFragment,
                 GeometryFragment, TextureFragment, NoiseFragment, BlenderFragment, ClampFragment, MatrixFragment,
                 RampFragment, AnimationFragment, AlternativeFragment, OutputFragment>;

}  // namespace septet::scene
