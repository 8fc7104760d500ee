#include "sim-client/frame/mirror_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scenery/vehicles/vehicle_mirrors.hpp"
#include "engine/world/instrument_panel.hpp"
#include "engine/world/vehicle_model.hpp"
#include "engine/world/windscreen.hpp"
#include "sim-client/frame/prototype_of.hpp"

namespace septet::frame {
namespace {

constexpr int sides = 32;

struct GlassFrame {
  Vec3 middle_m, right, up, back;
  glm::dvec2 half_m;
};

GlassFrame frame_of(const rig::Window& glass) {
  GlassFrame frame;
  frame.middle_m = 0.5 * (glass.lower_right_m + glass.upper_left_m);
  const Vec3 along = glass.lower_right_m - glass.lower_left_m, upward = glass.upper_left_m - glass.lower_left_m;
  frame.half_m = {0.5 * glm::length(along), 0.5 * glm::length(upward)};
  frame.right = glm::normalize(along);
  frame.back = glm::normalize(glm::cross(along, upward));
  frame.up = glm::cross(frame.back, frame.right);
  return frame;
}

/// Section of the housing: the glass's outline, widened by `wider_m` or narrowed by a share, at a distance towards the
/// eye.
struct Section {
  double wider_m, share, forward_m;
};

class HousingPen {
 public:
  void quad(const std::array<Vec3, 4>& corners) {
    const Vec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
    const double length = glm::length(normal);
    if (!(length > 1e-12)) return;
    const glm::vec2 uv = instrument_panel::uv_of_middle(instrument_panel::Sign::hub);  // Dull black.
    for (const std::size_t i : {0, 1, 2, 0, 2, 3})
      vertices_.push_back({glm::vec3(corners[i]), glm::vec3(normal / length), uv});
  }
  /// Draws a bar of four sides.
  void bar(const Vec3& from, const Vec3& to, double half_m) {
    const Vec3 along = glm::normalize(to - from);
    const Vec3 aside =
        half_m * glm::normalize(glm::cross(along, std::abs(along.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
    const Vec3 across = half_m * glm::cross(along, aside / half_m);
    const std::array<Vec3, 4> rim{aside, across, -aside, -across};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 &a = rim[i], &b = rim[(i + 1) % 4];
      quad({from + a, from + b, to + b, to + a});
    }
  }
  std::vector<scene::SurfaceVertex> take() { return std::move(vertices_); }

 private:
  std::vector<scene::SurfaceVertex> vertices_;
};

}  // namespace

std::vector<SeenMirror> seen_mirrors(const rig::Rig& rig, const rig::Screen& screen,
                                     const instant::OffAxisView& through, const instant::PixelRectangle& viewport) {
  std::vector<SeenMirror> mirrors;
  std::int32_t below_px = 0;
  for (std::size_t i = 0; i < rig.mirrors.size(); ++i) {
    const rig::Mirror& mirror = rig.mirrors[i];
    const bool has_inset = std::ranges::any_of(screen.views, [&](const rig::View& view) { return view.mirror == i; });
    const rig::Window& glass = mirror.glass;
    auto seen = instant::mirror_glass({glass.lower_left_m, glass.lower_right_m, glass.upper_left_m}, mirror.radius_m,
                                      through, viewport);
    if (!seen || (has_inset && !seen->wholly_seen)) continue;
    seen->picture.viewport.y = below_px;
    below_px += static_cast<std::int32_t>(seen->picture.viewport.height);
    mirrors.push_back({mirror, std::move(*seen)});
  }
  return mirrors;
}

std::vector<scene::SurfaceVertex> mirror_housing(const rig::Mirror& mirror) {
  const GlassFrame glass = frame_of(mirror.glass);
  const bool inside = std::abs(glass.middle_m.y) < 0.5;
  const double deep_m = inside ? 0.028 : 0.075;
  // The glass bulges back at its rim; the frame's lip covers that.
  const double sunk_m = mirror.radius_m > 0.0 ? glm::dot(glass.half_m, glass.half_m) / (2.0 * mirror.radius_m) : 0.0;
  const std::array<Section, 6> sections{{{-0.002, 1.0, -sunk_m - 0.001},
                                         {0.001, 1.0, 0.003},
                                         {0.006, 1.0, 0.003},
                                         {0.009, 1.0, -0.004},
                                         {0.006, 0.96, -0.6 * deep_m},
                                         {0.0, 0.55, -deep_m}}};
  const auto at = [&](const Section& section, int side) {
    const glm::dvec2 half = section.share * glass.half_m + section.wider_m;
    const glm::dvec2 place = instant::glass_outline(half, 2.0 * std::numbers::pi * side / sides);
    return place.x * glass.right + place.y * glass.up + section.forward_m * glass.back;
  };
  HousingPen pen;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i)
    for (int side = 0; side < sides; ++side)
      pen.quad(
          {at(sections[i], side), at(sections[i + 1], side), at(sections[i + 1], side + 1), at(sections[i], side + 1)});
  const Vec3 behind = -0.7 * deep_m * glass.back;
  if (inside) {
    // Stem to its foot on the windscreen's glass, above the mirror.
    const Vec3 &foot = windscreen::foot_left_m, &head = windscreen::head_left_m;
    const double z_m = glass.middle_m.z + glass.half_m.y + 0.045;
    const double x_m = foot.x + (head.x - foot.x) * (z_m - foot.z) / (head.z - foot.z);
    pen.bar(behind + 0.9 * glass.half_m.y * glass.up, Vec3(x_m - 0.004, 0.0, z_m) - glass.middle_m, 0.009);
  } else {
    const double side = glass.middle_m.y > 0.0 ? 1.0 : -1.0;
    const Vec3 door(glass.middle_m.x + 0.10, side * 0.79, glass.middle_m.z - glass.half_m.y - 0.005);
    pen.bar(behind - 0.7 * glass.half_m.y * glass.up, door - glass.middle_m, 0.016);
  }
  return pen.take();
}

void add_mirrors(instant::FrameInput& frame, const std::vector<SeenMirror>& mirrors,
                 const scene::ResolvedScene& scene) {
  const auto black = prototype_of(scene, "cockpit/signs");
  const RigidTransform& world_from_car = frame.views.front().world_from_car;
  const glm::dmat3 turn = glm::mat3_cast(world_from_car.orientation);
  for (const SeenMirror& seen : mirrors) {
    frame.mirrors.push_back(seen.glass);
    frame.mirrors.back().picture.world_from_car = world_from_car;
    frame.mirrors.back().picture.velocity_mps = frame.views.front().velocity_mps;
    if (!black) continue;
    instant::DynamicMesh housing;
    housing.prototype = *black;
    housing.origin_m = world_from_car * (0.5 * (seen.mirror.glass.lower_right_m + seen.mirror.glass.upper_left_m));
    housing.vertices = mirror_housing(seen.mirror);
    for (scene::SurfaceVertex& vertex : housing.vertices) {
      housing.radius_m = std::max(housing.radius_m, glm::length(vertex.position_m));
      vertex.position_m = glm::vec3(turn * Vec3(vertex.position_m));
      vertex.normal = glm::vec3(turn * Vec3(vertex.normal));
    }
    frame.meshes.push_back(std::move(housing));
  }
}

void add_vehicle_mirrors(instant::FrameInput& frame, const Participant& vehicle) {
  const instant::FrameView& through = frame.views.front();
  const RigidTransform views_from_vehicle = inverse(through.world_from_car) * vehicle.world_from_vehicle;
  std::int32_t below_px = 0;
  for (const scenery::VehicleMirror& mirror : scenery::vehicle_mirrors(vehicle_models()[vehicle.model])) {
    const auto corner = [&](double across, double upward) {
      return views_from_vehicle * (mirror.middle_m + across * 0.5 * mirror.width_m * mirror.right +
                                   upward * 0.5 * mirror.height_m * mirror.up());
    };
    auto seen = instant::mirror_glass({corner(-1, -1), corner(1, -1), corner(-1, 1)}, mirror.radius_m,
                                      through.projection, through.viewport);
    if (!seen) continue;
    seen->picture.viewport.y = below_px;
    below_px += static_cast<std::int32_t>(seen->picture.viewport.height);
    seen->picture.world_from_car = through.world_from_car;
    seen->picture.velocity_mps = through.velocity_mps;
    frame.mirrors.push_back(std::move(*seen));
  }
}

}  // namespace septet::frame
