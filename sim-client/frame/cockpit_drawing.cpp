#include "sim-client/frame/cockpit_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scenery/vehicles/fittings.hpp"
#include "engine/world/instrument_panel.hpp"
#include "sim-client/frame/prototype_of.hpp"

namespace septet::frame {
namespace {

namespace face = instrument_panel;
using face::Sign;

/// Draws on the panel, in its own metres; later strokes lie a little nearer to the driver.
class PanelPen {
 public:
  /// `share` of the sign's picture across, so that digits stand close.
  void sign(Sign sign, const face::Place& place, double share = 1.0) {
    const double half = 0.5 * place.height_m, across = share * half;
    const glm::dvec2 low = place.middle_m - glm::dvec2(across, half), high = place.middle_m + glm::dvec2(across, half);
    const glm::vec2 cell(face::cell_of(sign)), cells(face::columns, face::rows);
    const auto inset = static_cast<float>(0.5 - 0.5 * share);
    const glm::vec2 from = (cell + glm::vec2(inset, 0.0f)) / cells, to = (cell + glm::vec2(1.0f - inset, 1.0f)) / cells;
    quad({low, {high.x, low.y}, high, {low.x, high.y}}, {glm::vec2(from.x, to.y), to, glm::vec2(to.x, from.y), from});
  }
  /// Draws a plain quad, in the colour in the middle of a sign's picture.
  void plain(Sign sign, const std::array<glm::dvec2, 4>& corners) {
    const glm::vec2 at = face::uv_of_middle(sign);
    quad(corners, {at, at, at, at});
  }
  void needle(const face::Dial& dial, double reading) {
    const double angle = face::needle_rad(dial, reading);
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), beside(-along.y, along.x);
    const glm::dvec2 root = dial.middle_m - 0.06 * dial.radius_m * along,
                     tip = dial.middle_m + 0.90 * dial.radius_m * along;
    constexpr double root_m = 0.0019, tip_m = 0.0011;
    plain(Sign::needle, {root - root_m * beside, tip - tip_m * beside, tip + tip_m * beside, root + root_m * beside});
    constexpr int facets = 6;
    for (int i = 0; i < facets; ++i) {
      const auto on_hub = [&](double k) {
        const double a = std::numbers::pi * k / facets;
        return dial.middle_m + 0.11 * dial.radius_m * glm::dvec2(std::cos(a), std::sin(a));
      };
      plain(Sign::hub, {dial.middle_m, on_hub(2 * i), on_hub(2 * i + 1), on_hub(2 * i + 2)});
    }
  }
  std::vector<scene::SurfaceVertex> take() { return std::move(vertices_); }

 private:
  void quad(const std::array<glm::dvec2, 4>& corners, const std::array<glm::vec2, 4>& uvs) {
    lift_m_ += 2e-5;
    for (const std::size_t i : {0, 1, 2, 0, 2, 3}) {
      const Vec3 at = corners[i].x * face::right + corners[i].y * face::up + lift_m_ * face::normal;
      vertices_.push_back({glm::vec3(at), glm::vec3(face::normal), uvs[i]});
    }
  }
  double lift_m_ = 0.002;
  std::vector<scene::SurfaceVertex> vertices_;
};

}  // namespace

bool is_stalled(const DriverCar& car) {
  constexpr double stalled_below_radps = 15.0;
  return car.engine_radps < stalled_below_radps;
}

Readings readings_of(const Snapshot& shown, const Participant& car) {
  Readings readings;
  readings.lamps = car.lamps;
  if (car.id == shown.driver_car.participant) {
    readings.speed_mps = shown.driver_car.speed_mps;
    readings.engine_radps = shown.driver_car.engine_radps;
    readings.gear = shown.driver_car.gear;
    readings.has_gear = true;
    readings.stalled = is_stalled(shown.driver_car);
  } else {
    constexpr double idle_radps = 85.0, radps_per_mps = 6.5;  // Engine speed in a long gear.
    readings.speed_mps = glm::dot(car.velocity_mps, car.world_from_vehicle.orientation * Vec3(1, 0, 0));
    readings.engine_radps = std::max(idle_radps, radps_per_mps * std::abs(readings.speed_mps));
  }
  return readings;
}

std::vector<scene::SurfaceVertex> lit_on_panel(const Readings& readings) {
  PanelPen pen;
  const auto digit = [](int value) { return static_cast<Sign>(std::clamp(value, 0, 9)); };
  const double kmh = std::abs(readings.speed_mps) * 3.6;
  const int whole_kmh = kmh < 999.0 ? static_cast<int>(std::lround(kmh)) : kmh > 0.0 ? 999 : 0;
  const std::string digits = std::to_string(whole_kmh);
  constexpr double narrow = 0.66;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    face::Place place = face::speed_digits;
    place.middle_m.x +=
        (static_cast<double>(i) - 0.5 * static_cast<double>(digits.size() - 1)) * narrow * place.height_m;
    pen.sign(digit(digits[i] - '0'), place, narrow);
  }
  if (readings.has_gear)
    pen.sign(readings.gear < 0 ? Sign::reverse : readings.gear == 0 ? Sign::neutral : digit(readings.gear), face::gear);
  const auto lamp = [&](Sign sign, bool lit) {
    if (lit) pen.sign(sign, face::place_of(sign));
  };
  const bool left = readings.lamps.has(Lamp::indicator_left), right = readings.lamps.has(Lamp::indicator_right);
  lamp(Sign::indicator_left, left);
  lamp(Sign::indicator_right, right);
  lamp(Sign::hazard, left && right);
  lamp(Sign::low_beam, readings.lamps.has(Lamp::low_beam));
  lamp(Sign::high_beam, readings.lamps.has(Lamp::high_beam));
  lamp(Sign::rear_fog, readings.lamps.has(Lamp::rear_fog));
  lamp(Sign::parking_brake, readings.lamps.has(Lamp::parking_brake));
  lamp(Sign::engine, readings.stalled);
  pen.needle(face::revolutions, std::abs(readings.engine_radps) * 30.0 / std::numbers::pi / 1000.0);
  pen.needle(face::speed, kmh);
  return pen.take();
}

void add_instruments(instant::FrameInput& frame, const Readings& readings, const Participant& car,
                     const scene::ResolvedScene& scene) {
  const auto prototype = prototype_of(scene, "cockpit/signs");
  if (!prototype) return;
  instant::DynamicMesh mesh;
  mesh.prototype = *prototype;
  mesh.origin_m = car.world_from_vehicle * face::middle_m;
  mesh.radius_m = static_cast<float>(face::width_m);
  mesh.vertices = lit_on_panel(readings);
  const glm::dmat3 turn = glm::mat3_cast(car.world_from_vehicle.orientation);
  for (scene::SurfaceVertex& vertex : mesh.vertices) {
    vertex.position_m = glm::vec3(turn * Vec3(vertex.position_m));
    vertex.normal = glm::vec3(turn * Vec3(vertex.normal));
  }
  frame.meshes.push_back(std::move(mesh));
}

void add_dials(instant::FrameInput& frame, const Readings& readings, const Participant& vehicle,
               const scene::ResolvedScene& scene) {
  const auto faces = prototype_of(scene, "cockpit/dials");
  const auto vehicle_from_panel = scenery::dials_in(vehicle_models()[vehicle.model]);
  if (!faces || !vehicle_from_panel) return;
  Participant panel = vehicle;
  panel.world_from_vehicle = vehicle.world_from_vehicle * *vehicle_from_panel;
  instant::DrawnParticipant drawn = instant::drawn_participant(panel, *faces);
  drawn.lamps = {};
  drawn.raises_spray = false;
  frame.participants.push_back(drawn);
  add_instruments(frame, readings, panel, scene);
}

double hands_rad(double steering_wheel_rad) {
  const double turned_rad = std::abs(steering_wheel_rad);
  if (!(turned_rad < 1e3)) return 0.0;
  const double in_grip_rad = std::fmod(turned_rad, hands_reach_rad + hands_back_in_rad);
  const double held_rad = in_grip_rad < hands_reach_rad
                              ? in_grip_rad
                              : hands_reach_rad * (1.0 - (in_grip_rad - hands_reach_rad) / hands_back_in_rad);
  return std::copysign(held_rad, steering_wheel_rad);
}

void add_hands(instant::FrameInput& frame, double steering_wheel_rad, const Participant& car,
               const scene::ResolvedScene& scene) {
  const auto prototype = prototype_of(scene, "cockpit/hands");
  if (!prototype) return;
  instant::DrawnParticipant hands = instant::drawn_participant(car, *prototype);
  hands.lamps = {};
  hands.steering_wheel_rad = hands_rad(steering_wheel_rad);
  frame.participants.push_back(hands);
}

}  // namespace septet::frame
