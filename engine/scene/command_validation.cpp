#include "engine/scene/command_validation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/core.h>

#include "engine/scene/command_codec.hpp"
#include "engine/scene/motion_reach.hpp"
#include "engine/scene/world_bounds.hpp"

namespace septet::scene {
namespace {

bool finite(double value) { return std::isfinite(value); }
bool finite(const glm::vec3& v) { return finite(v.x) && finite(v.y) && finite(v.z); }
bool finite(const Vec3& v) { return finite(v.x) && finite(v.y) && finite(v.z); }
bool finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}
template <class Enumeration>
bool in_range(Enumeration value, Enumeration last) {
  return value <= last;
}

struct Problem {
  constexpr Problem(const char* is_wrong = nullptr, const char* to_do = "send values within COMMANDS.md")
      : what(is_wrong), remedy(to_do) {}
  explicit operator bool() const { return what != nullptr; }

  const char* what;
  const char* remedy;
};
constexpr Problem none;
constexpr Problem not_finite = "a number is not finite";
constexpr Problem too_far{"a place lies more than 250,000 km from the origin, or is no number",
                          "give metres: no world is as large"};
constexpr Problem vertex_too_far{"a vertex lies more than 250,000 km from its object's origin, or is no number",
                                 "give metres: no world is as large"};
constexpr Problem leaves_world{"a motion leaves the world before its last leg: 250,000 km from the origin",
                               "let its legs be slower or shorter"};
constexpr Problem scaled_too_far{"a scale is over 10,000, or is no number", "give the shape itself another size"};
constexpr Problem large_value{"a value of a layer is over 1e9, or is no number", "send values within COMMANDS.md"};
static_assert(farthest_m == 250e6 && largest_scale == 1e4 && largest_layer_value == 1e9 && max_motion_rate == 1e4 &&
              latest_leg_s == 1e9);
constexpr Problem long_name = "a name is longer than 255 bytes";
constexpr Problem bad_kind = "a kind is out of range";
constexpr Problem bad_run = "a run is empty or too long";

Problem check_name(std::string_view name) { return name.size() > max_name_bytes ? long_name : none; }
Problem first_of(std::initializer_list<Problem> problems) {
  for (const Problem problem : problems)
    if (problem) return problem;
  return none;
}

struct FragmentCheck {
  Problem operator()(const ColorFragment& f) const { return finite(f.color) ? none : not_finite; }
  Problem operator()(const LightFragment& f) const {
    return first_of({in_range(f.kind, LightKind::back_direct_and_ambient) ? none : bad_kind,
                     finite(f.normal_falloff) ? none : not_finite, check_name(f.brdf_red), check_name(f.brdf_green),
                     check_name(f.brdf_blue)});
  }
  Problem operator()(const ReflectionFragment& f) const { return finite(f.normal_falloff) ? none : not_finite; }
  Problem operator()(const TransparencyFragment& f) const {
    return finite(f.normal_falloff) && finite(f.refraction_index) ? none : not_finite;
  }
  Problem operator()(const VolumeFragment& f) const {
    return finite(f.diffusion) && finite(f.color) ? none : not_finite;
  }
  Problem operator()(const ViewFragment&) const { return none; }
  Problem operator()(const GeometryFragment& f) const {
    return first_of({check_name(f.layer_x), check_name(f.layer_y), check_name(f.layer_z)});
  }
  Problem operator()(const TextureFragment& f) const {
    return first_of({check_name(f.layer_red), check_name(f.layer_green), check_name(f.layer_blue)});
  }
  Problem operator()(const NoiseFragment& f) const {
    return in_range(f.kind, NoiseKind::point_minus_one_to_one) ? none : bad_kind;
  }
  Problem operator()(const BlenderFragment& f) const { return in_range(f.kind, BlendKind::divide) ? none : bad_kind; }
  Problem operator()(const ClampFragment& f) const { return finite(f.limit) ? none : not_finite; }
  Problem operator()(const MatrixFragment& f) const { return finite(f.matrix) ? none : not_finite; }
  Problem operator()(const RampFragment& f) const {
    if (!in_range(f.kind, RampKind::smooth) || !in_range(f.channel, RampChannel::blue)) return bad_kind;
    if (f.points.empty() || f.points.size() > RampFragment::max_points) return "a ramp has 1 to 48 points";
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      if (!finite(f.points[i].position) || !finite(f.points[i].color)) return not_finite;
      if (i > 0 && f.points[i].position < f.points[i - 1].position) return "a ramp's positions fall";
    }
    return none;
  }
  Problem operator()(const AnimationFragment& f) const { return check_name(f.label); }
  Problem operator()(const AlternativeFragment&) const { return none; }
  Problem operator()(const OutputFragment& f) const { return check_name(f.label); }
};

struct TagValueCheck {
  Problem operator()(bool) const { return none; }
  Problem operator()(std::uint32_t) const { return none; }
  Problem operator()(double value) const { return finite(value) ? none : not_finite; }
  Problem operator()(const std::string& text) const {
    return text.size() > max_tag_string_bytes ? "a tag's text is longer than 4096 bytes" : none;
  }
  Problem operator()(const Vec3& value) const { return finite(value) ? none : not_finite; }
  Problem operator()(NodeReference) const { return none; }
  Problem operator()(const Blob& blob) const {
    return blob.size() > max_tag_blob_bytes ? "a tag's blob is longer than 4096 bytes" : none;
  }
};

struct CommandCheck {
  Problem operator()(const NodeCreate& c) const { return in_range(c.type, NodeType::bitmap) ? none : bad_kind; }
  Problem operator()(const PartSubscribe& c) const { return in_range(c.kind, PartKind::layer) ? none : bad_kind; }
  Problem operator()(const NodeNameSet& c) const { return check_name(c.name); }
  Problem operator()(const TagGroupSet& c) const { return check_name(c.name); }
  Problem operator()(const TagSet& c) const {
    return first_of({check_name(c.value.name), std::visit(TagValueCheck{}, c.value.value)});
  }
  Problem operator()(const TransformSet& c) const {
    const Transform& t = c.transform;
    if (!is_in_world(t.position_m)) return too_far;
    if (!is_within(t.scale, largest_scale)) return scaled_too_far;
    const double length = glm::dot(t.rotation, t.rotation);
    return length > 0.99 && length < 1.01 ? none : "the rotation is not a unit quaternion";
  }
  Problem operator()(const MotionSet& c) const {
    const Motion& m = c.motion;
    const double length = glm::dot(m.rotation, m.rotation);
    if (!is_in_world(m.position_m)) return too_far;
    if (!(length > 0.99 && length < 1.01)) return "the rotation is not a unit quaternion";
    if (m.legs.size() > max_motion_legs) return "a motion has at most 16 legs";
    for (std::size_t i = 0; i < m.legs.size(); ++i) {
      const MotionLeg& leg = m.legs[i];
      if (!(leg.from_s >= 0.0 && leg.from_s <= latest_leg_s))
        return "a leg of a motion does not begin between 0 and 1e9 s";
      if (i > 0 && leg.from_s < m.legs[i - 1].from_s) return "the legs of a motion do not begin one after the other";
      const auto is_slow = [](const Vec3& rate) { return glm::dot(rate, rate) <= max_motion_rate * max_motion_rate; };
      if (!is_slow(leg.velocity_mps)) return "a motion is faster than 10 km/s";
      if (!is_slow(leg.acceleration_mps2)) return "a motion is accelerated by more than 10 km/s²";
      if (!is_slow(leg.turn_radps)) return "a motion turns by more than 10,000 rad/s";
    }
    return farthest_coordinate_m(m) <= farthest_m ? none : leaves_world;
  }
  Problem operator()(const LinkSet& c) const { return check_name(c.value.label); }
  Problem operator()(const GeometryLayerSet& c) const {
    return first_of({check_name(c.name), in_range(c.type, LayerType::face_real) ? none : bad_kind,
                     std::abs(c.default_real) <= largest_layer_value ? none : large_value});
  }
  Problem operator()(const VerticesSet& c) const {
    const std::size_t count = c.positions_m.size();
    if (count == 0 || count > max_run_values / 3) return bad_run;
    const auto is_near = [](const glm::vec3& vertex_m) { return is_within(vertex_m, farthest_m); };
    return std::ranges::all_of(c.positions_m, is_near) ? none : vertex_too_far;
  }
  Problem operator()(const PolygonsSet& c) const {
    return c.polygons.empty() || c.polygons.size() > max_run_values / 4 ? bad_run : none;
  }
  Problem operator()(const LayerIntegersSet& c) const {
    return c.values.empty() || c.values.size() > max_run_values ? bad_run : none;
  }
  Problem operator()(const LayerRealsSet& c) const {
    if (c.values.empty() || c.values.size() > max_run_values) return bad_run;
    const auto is_moderate = [](float value) { return std::abs(value) <= largest_layer_value; };
    return std::ranges::all_of(c.values, is_moderate) ? none : large_value;
  }
  Problem operator()(const CreaseSet& c) const {
    return first_of({check_name(c.crease.layer), in_range(c.kind, CreaseKind::edge) ? none : bad_kind});
  }
  Problem operator()(const FragmentSet& c) const { return std::visit(FragmentCheck{}, c.value); }
  Problem operator()(const BitmapLayerSet& c) const {
    return first_of({check_name(c.name), in_range(c.type, PixelType::real64) ? none : bad_kind});
  }
  Problem operator()(const BitmapTilesSet& c) const {
    return c.tiles.empty() || c.tiles.size() > max_run_bytes ? bad_run : none;
  }
  template <class Other>
  Problem operator()(const Other&) const {
    return none;
  }
};

}  // namespace

NodeId node_of(const Command& command) {
  return std::visit(
      [](const auto& c) -> NodeId {
        if constexpr (requires { c.node; })
          return c.node;
        else
          return no_node;
      },
      command);
}

tl::unexpected<Error> refuse(const Command& command, std::string what, std::string remedy) {
  const NodeId id = node_of(command);
  const std::string node = id == no_node ? std::string() : fmt::format(" of node {}", id);
  return failure(std::move(what), fmt::format("command \"{}\"{}", name_of(command), node), std::move(remedy));
}

Expected<void> validate(const Command& command) {
  if (const Problem problem = std::visit(CommandCheck{}, command)) return refuse(command, problem.what, problem.remedy);
  return {};
}

}  // namespace septet::scene
