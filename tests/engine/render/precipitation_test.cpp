#include "engine/render/passes/precipitation_pass.hpp"

#include <algorithm>
#include <memory>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet::render {
namespace {

/// Precipitation as seen by a driver who looks straight ahead out of a car that drives along x.
std::vector<StreakRecord> seen(double rain_mm_per_h, double car_mps, float share_of_sky = 1.0f) {
  static const auto light = std::make_shared<const SkyLight>();
  Instant instant;
  instant.light = light;
  instant.share_of_sky = share_of_sky;
  instant.simulated_time_s = 12.0;
  instant.environment.rain_mm_per_h = rain_mm_per_h;
  instant.environment.temperature_k = 283.0;
  instant.environment.wind_speed_mps = 0.0;
  FrameView view;
  view.projection = *off_axis_view({{2, 2, -1}, {2, -2, -1}, {2, 2, 3}}, {0.5, 0.37, 1.15});
  view.viewport = {0, 0, 640, 640};
  view.velocity_mps = {car_mps, 0.0, 0.0};
  return streak_records(instant, view, world_eye(view));
}

}  // namespace

TEST_CASE("rain falls where the sky is seen and not under a roof, and more of it where it rains harder") {
  CHECK(seen(0.0, 0.0).empty());
  CHECK(seen(4.0, 0.0, 0.3f).empty());
  CHECK(seen(4.0, 0.0).size() > 20);
  CHECK(seen(8.0, 0.0).size() > 1.4 * static_cast<double>(seen(4.0, 0.0).size()));
}

TEST_CASE("a streak is the way of its drop past the eye in a sixtieth of a second") {
  for (const double car_mps : {0.0, 12.0, 30.0})
    for (const StreakRecord& record : seen(4.0, car_mps)) {
      const glm::vec3 mps = 60.0f * glm::vec3(record.along_opacity);
      CHECK(mps.x == doctest::Approx(-car_mps).scale(1.0).epsilon(1e-4));
      CHECK(mps.y == doctest::Approx(0.0));
      CHECK(mps.z < -3.0f);
      CHECK(mps.z > -9.7f);
    }
}

TEST_CASE("no rain falls within the car of whoever looks") {
  const Vec3 eye_m(0.5, 0.37, 1.15);
  int ahead = 0;
  for (const StreakRecord& record : seen(12.0, 0.0)) {
    const Vec3 at = Vec3(record.from_width) + 0.5 * Vec3(record.along_opacity) + eye_m;
    CHECK_FALSE((at.x > -1.4 && at.x < 4.2 && std::abs(at.y) < 1.0 && at.z < 1.6));
    ahead += at.x > 4.2;
  }
  CHECK(ahead > 5);
}

}  // namespace septet::render
