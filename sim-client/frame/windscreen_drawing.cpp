#include "sim-client/frame/windscreen_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/random.hpp"
#include "engine/world/instrument_panel.hpp"
#include "engine/world/windscreen.hpp"
#include "sim-client/frame/prototype_of.hpp"

namespace septet::frame {
namespace {

constexpr double pi = std::numbers::pi, freezing_rain_k = 274.65;

struct Stroke {
  double every_s, lasts_s;
};
Stroke stroke_in(double rain_mm_per_h) {
  if (rain_mm_per_h < 1.5) return {4.0, 4.0 / 3.0};
  return rain_mm_per_h < 8.0 ? Stroke{4.0 / 3.0, 4.0 / 3.0} : Stroke{1.0, 1.0};
}

/// Glass in the vehicle's frame.
struct Glass {
  Vec3 foot_m, right, up, normal;
  double height_m, foot_half_m, head_half_m;
};
Glass glass() {
  using namespace windscreen;
  const Vec3 foot(foot_left_m.x, 0.0, foot_left_m.z), head(head_left_m.x, 0.0, head_left_m.z);
  Glass result;
  result.foot_m = foot;
  result.right = Vec3(0, -1, 0);
  result.height_m = glm::length(head - foot);
  result.up = (head - foot) / result.height_m;
  result.normal = glm::cross(result.right, result.up);  // Towards the driver.
  result.foot_half_m = foot_left_m.y;
  result.head_half_m = head_left_m.y;
  return result;
}

/// Mesh on the glass of one car, along the world's axes.
class GlassPen {
 public:
  GlassPen(const Participant& car, std::uint32_t prototype)
      : turn_(glm::mat3_cast(car.world_from_vehicle.orientation)) {
    mesh_.prototype = prototype;
    mesh_.origin_m = car.world_from_vehicle * glass_.foot_m;
    mesh_.radius_m = 1.3f;
  }
  void corner(const glm::dvec2& place_m, double lift_m, const glm::dvec2& lean, const glm::vec2& uv) {
    const Vec3 at = place_m.x * glass_.right + place_m.y * glass_.up + lift_m * glass_.normal;
    const Vec3 normal = glm::normalize(lean.x * glass_.right + lean.y * glass_.up + glass_.normal);
    mesh_.vertices.push_back({glm::vec3(turn_ * at), glm::vec3(turn_ * normal), uv});
  }
  instant::DynamicMesh take() { return std::move(mesh_); }

 private:
  Glass glass_ = glass();
  glm::dmat3 turn_;
  instant::DynamicMesh mesh_;
};

void add_bar(GlassPen& pen, const glm::dvec2& a, const glm::dvec2& b, double half_m, double lift_m) {
  const glm::vec2 uv = instrument_panel::uv_of_middle(instrument_panel::Sign::hub);  // Dull black.
  const glm::dvec2 along = glm::normalize(b - a), beside = half_m * glm::dvec2(-along.y, along.x);
  const std::array<glm::dvec2, 4> corners{a - beside, b - beside, b + beside, a + beside};
  for (const std::size_t i : {0, 1, 2, 0, 2, 3}) pen.corner(corners[i], lift_m, {0.0, 0.0}, uv);
}

}  // namespace

const std::vector<Wiper> wipers{{{-0.50, 0.02}, 0.10, 0.64, 0.05, 1.62}, {{0.14, 0.02}, 0.10, 0.58, 0.05, 1.62}};

double wiper_share(double rain_mm_per_h, double time_s) {
  if (!(rain_mm_per_h > 0.0)) return 0.0;
  const Stroke stroke = stroke_in(rain_mm_per_h);
  const double phase = (time_s - stroke.every_s * std::floor(time_s / stroke.every_s)) / stroke.lasts_s;
  return phase < 1.0 ? 0.5 - 0.5 * std::cos(2.0 * pi * phase) : 0.0;
}

std::optional<double> last_passed_s(double rain_mm_per_h, double share, double time_s) {
  if (!(rain_mm_per_h > 0.0)) return std::nullopt;
  const Stroke stroke = stroke_in(rain_mm_per_h);
  const double begun_s = stroke.every_s * std::floor(time_s / stroke.every_s);
  const double up_s = stroke.lasts_s * std::acos(1.0 - 2.0 * share) / (2.0 * pi), down_s = stroke.lasts_s - up_s;
  const double into_s = time_s - begun_s;
  if (into_s >= down_s) return begun_s + down_s;
  if (into_s >= up_s) return begun_s + up_s;
  return begun_s - stroke.every_s + down_s;
}

std::optional<double> swept_share(const glm::dvec2& place_m) {
  for (const Wiper& wiper : wipers) {
    const glm::dvec2 from_pivot = place_m - wiper.pivot_m;
    const double distance_m = glm::length(from_pivot);
    const double share = (std::atan2(from_pivot.y, from_pivot.x) - wiper.rest_rad) / wiper.turn_rad;
    if (distance_m > wiper.from_m && distance_m < wiper.to_m && share > 0.0 && share < 1.0) return share;
  }
  return std::nullopt;
}

glm::dvec2 place_on_wiper(const Wiper& wiper, double reach_m, double share) {
  const double angle = wiper.rest_rad + share * wiper.turn_rad;
  const double down = std::max(0.0, 1.0 - share / rises_by_share);
  return wiper.pivot_m + reach_m * glm::dvec2(std::cos(angle), std::sin(angle)) - glm::dvec2(0.0, parked_m * down);
}

std::vector<GlassDrop> drops_on_glass(const Environment& environment, double time_s) {
  std::vector<GlassDrop> drops;
  const double rain = environment.rain_mm_per_h;
  if (!(rain > 0.0) || environment.temperature_k < freezing_rain_k) return drops;
  constexpr int places = 900;
  // A drop falls at each place at a fixed interval; places that no wiper clears are always wet.
  const double every_s = std::clamp(14.0 / rain, 1.2, 30.0);
  const Glass on = glass();
  Random random(7);
  for (int i = 0; i < places; ++i) {
    const double up = random.uniform(), half_m = std::lerp(on.foot_half_m, on.head_half_m, up);
    const glm::dvec2 place_m(random.uniform(-half_m, half_m), up * on.height_m);
    const double radius_m = random.uniform(0.0012, 0.0030), phase_s = every_s * random.uniform();
    const auto share = swept_share(place_m);
    if (share) {
      const double fell_s = phase_s + every_s * std::floor((time_s - phase_s) / every_s);
      if (const auto passed_s = last_passed_s(rain, *share, time_s); passed_s && fell_s < *passed_s) continue;
    }
    drops.push_back({place_m, radius_m});
  }
  return drops;
}

void add_windscreen(instant::FrameInput& frame, const Snapshot& shown, const Participant& car,
                    const scene::ResolvedScene& scene) {
  const auto water = prototype_of(scene, "cockpit/water"), black = prototype_of(scene, "cockpit/signs");
  if (!water || !black) return;
  const Environment& environment = shown.environment;
  const double share = wiper_share(environment.rain_mm_per_h, shown.simulated_time_s);
  // Wipers at rest lie below the cowl's line, where dashboard and bonnet hide them from every eye.
  if (share > 0.0) {
    GlassPen blades(car, *black);
    for (const Wiper& wiper : wipers) {
      const auto at = [&](double reach_m) { return place_on_wiper(wiper, reach_m, share); };
      add_bar(blades, at(wiper.from_m), at(wiper.to_m), 0.006, -0.006);
      add_bar(blades, at(-0.03), at(0.5 * (wiper.from_m + wiper.to_m)), 0.009, -0.012);
    }
    frame.meshes.push_back(blades.take());
  }
  const std::vector<GlassDrop> drops = drops_on_glass(environment, shown.simulated_time_s);
  if (drops.empty()) return;
  GlassPen pen(car, *water);
  // A drop inverts the picture behind it: the sky appears in its lower half.
  constexpr std::size_t sides = 6;
  std::array<glm::dvec2, sides> rim{};
  for (std::size_t k = 0; k < sides; ++k) {
    const double a = 2.0 * pi * (static_cast<double>(k) + 0.5) / sides;
    rim[k] = {std::cos(a), 1.25 * std::sin(a)};
  }
  for (const GlassDrop& drop : drops)
    for (std::size_t k = 1; k + 1 < sides; ++k)
      for (const std::size_t c : {std::size_t{0}, k, k + 1})
        pen.corner(drop.place_m + drop.radius_m * rim[c], -0.002, {0.0, -2.2 * rim[c].y}, {0.0f, 0.0f});
  frame.meshes.push_back(pen.take());
}

}  // namespace septet::frame
