/// Inside of the driver's car as pixels: its instruments agree with the snapshot.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "engine/world/instrument_panel.hpp"
#include "sim-client/frame/windscreen_drawing.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

namespace panel_of = instrument_panel;

Vec3 on_panel(const glm::dvec2& at_m) {
  return panel_of::middle_m + at_m.x * panel_of::right + at_m.y * panel_of::up + 0.003 * panel_of::normal;
}

/// The needle's drawn angle on its dial: the mean of the red pixels on a circle that it alone crosses.
double seen_needle_rad(const SeatPicture& picture, const panel_of::Dial& dial) {
  double weight = 0.0, sum = 0.0;
  for (int i = -40; i <= 1540; ++i) {
    const double angle = (1.25 - i / 1000.0) * std::numbers::pi;
    const glm::dvec2 place = dial.middle_m + 0.42 * dial.radius_m * glm::dvec2(std::cos(angle), std::sin(angle));
    const image::Color c = picture.at(picture.pixel(on_panel(place)));
    const double red = std::max(0.0, c.red - 1.0 * c.green - 25.0);
    weight += red, sum += red * angle;
  }
  REQUIRE(weight > 100.0);
  return sum / weight;
}

double brightness(const SeatPicture& picture, panel_of::Sign sign) {
  const panel_of::Place place = panel_of::place_of(sign);
  double most = 0.0;
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      const image::Color c =
          picture.at(picture.pixel(on_panel(place.middle_m + 0.1 * place.height_m * glm::dvec2(i, k))));
      most = std::max({most, double(c.red), double(c.green), double(c.blue)});
    }
  return most;
}

const rig::Screen& screen_with_dials(const rig::Rig& rig) { return rig::screen_ahead(rig); }

}  // namespace

TEST_CASE("needles point at the speed and the revolutions of the snapshot") {
  for (const char* name : {"desktop", "three-monitors"})
    for (const auto& reading : {std::pair{0.0, 800.0}, {50.0, 2000.0}, {117.0, 3300.0}, {400.0, 9000.0}}) {
      const double kmh = reading.first, rpm = reading.second;
      CAPTURE(name);
      CAPTURE(kmh);
      const rig::Rig rig = rig_called(name);
      const auto picture = seat_picture(in_the_seat(kmh, rpm), rig, screen_with_dials(rig),
                                        std::string("dials-") + name + "-" + std::to_string(int(kmh)));
      constexpr double degree = std::numbers::pi / 180.0;
      CHECK(std::abs(seen_needle_rad(picture, panel_of::speed) - needle_rad(panel_of::speed, kmh)) < 2.0 * degree);
      CHECK(std::abs(seen_needle_rad(picture, panel_of::revolutions) -
                     needle_rad(panel_of::revolutions, rpm / 1000.0)) < 2.0 * degree);
    }
}

TEST_CASE("each lamp among the instruments shines when its own is lit, by day and by night") {
  using panel_of::Sign;
  const rig::Rig rig = rig_called("desktop");
  const std::pair<Lamp, Sign> lamps[] = {{Lamp::indicator_left, Sign::indicator_left},
                                         {Lamp::indicator_right, Sign::indicator_right},
                                         {Lamp::low_beam, Sign::low_beam},
                                         {Lamp::high_beam, Sign::high_beam},
                                         {Lamp::rear_fog, Sign::rear_fog},
                                         {Lamp::parking_brake, Sign::parking_brake}};
  for (const bool night : {false, true}) {
    CAPTURE(night);
    Snapshot dark = in_the_seat();
    if (night) dark.environment.sun_elevation_rad = -0.4;
    const auto unlit = seat_picture(dark, rig, rig.screens[0], night ? "lamps-none-night" : "lamps-none");
    for (const auto& each : lamps) {
      const Lamp lamp = each.first;
      const Sign sign = each.second;
      CAPTURE(static_cast<int>(sign));
      Snapshot shown = dark;
      shown.participants[0].lamps.set(lamp, true);
      const auto lit = seat_picture(shown, rig, rig.screens[0],
                                    "lamp-" + std::to_string(static_cast<int>(sign)) + (night ? "-night" : ""));
      for (const auto& [other, other_sign] : lamps) {
        if (other == lamp)
          CHECK(brightness(lit, other_sign) > brightness(unlit, other_sign) + 80.0);
        else if (lamp != Lamp::low_beam && lamp != Lamp::high_beam)
          CHECK(std::abs(brightness(lit, other_sign) - brightness(unlit, other_sign)) < 12.0);
      }
    }
  }
}

TEST_CASE("a screen of instruments shows the dials of the snapshot as large as it can, and nothing of the road") {
  const std::string text = shipped_text("rigs/seven-screens.toml") + R"(
[[screen]]
name = "instruments"
shows = "instruments"
width_px = 640
height_px = 360
lower_left_m = [1.93, 0.52, 0.91]
lower_right_m = [1.93, 0.22, 0.91]
upper_left_m = [1.96, 0.52, 1.02]
)";
  const rig::Rig rig = *rig::read_rig(text, "rig with instruments");
  const rig::Screen& screen = rig.screens.back();
  const auto day = seat_picture(in_the_seat(87.0, 2500.0), rig, screen, "instrument-screen");
  Snapshot shown = in_the_seat(87.0, 2500.0);
  shown.environment.rain_mm_per_h = 20.0;
  shown.environment.visibility_m = 30.0;
  CHECK(seat_picture(shown, rig, screen, "instrument-screen-rain").image.rgba == day.image.rgba);
  shown.environment.sun_elevation_rad = -0.4;
  const auto night = seat_picture(shown, rig, screen, "instrument-screen-night");
  for (const SeatPicture* picture : {&day, &night}) {
    CHECK(std::abs(seen_needle_rad(*picture, panel_of::speed) - needle_rad(panel_of::speed, 87.0)) < 0.03);
    CHECK(std::abs(seen_needle_rad(*picture, panel_of::revolutions) - needle_rad(panel_of::revolutions, 2.5)) < 0.03);
    CHECK(picture->pixel(on_panel({-0.5 * panel_of::width_m, 0.0})).x == doctest::Approx(0.0).epsilon(0.01).scale(640));
    for (std::uint32_t x = 0; x < picture->image.width; x += 8) {
      const image::Color c = picture->image.at(x, 4);
      CHECK(std::max({c.red, c.green, c.blue}) < 60);
    }
  }
}

TEST_CASE("drops lie on the windscreen in rain, and fewer where the wipers run") {
  const rig::Rig rig = rig_called("desktop");
  Snapshot shown = in_the_seat(60.0, 2000.0);
  shown.environment.cloud_cover = 1.0;
  const auto dry = seat_picture(shown, rig, rig.screens[0], "windscreen-dry");
  shown.environment.rain_mm_per_h = 6.0;
  CHECK(drops_on_glass(in_the_seat().environment, 10.0).empty());
  for (const double time_s : {10.0, 10.4, 11.1}) {
    CAPTURE(time_s);
    shown.simulated_time_s = time_s;
    const auto wet = seat_picture(shown, rig, rig.screens[0], "windscreen-" + std::to_string(time_s));
    CHECK(seat_picture(shown, rig, rig.screens[0], "windscreen-again").image.rgba == wet.image.rgba);
    int swept = 0, unswept = 0;
    for (const GlassDrop& drop : drops_on_glass(shown.environment, time_s))
      (swept_share(drop.place_m) ? swept : unswept) += 1;
    CHECK(unswept > 150);
    CHECK(swept < unswept / 2);
  }
}

TEST_CASE("the steering wheel turns with the driver's") {
  const rig::Rig rig = rig_called("desktop");
  const glm::dvec2 top = seat_picture(in_the_seat(), rig, rig.screens[0], "wheel-straight").pixel({1.756, 0.37, 0.987});
  for (const double turn_rad : {0.0, 0.35, -0.35}) {
    CAPTURE(turn_rad);
    Snapshot shown = in_the_seat();
    shown.driver_car.steering_wheel_rad = turn_rad;
    const auto picture = seat_picture(shown, rig, rig.screens[0], "wheel-" + std::to_string(turn_rad));
    // Mark on the rim, bluer than hands and lighter than the rim in the cabin's shade: straight ahead it is at the top,
    // and it goes to the left with a turn to the left.
    double weight = 0.0, sum = 0.0;
    for (double x = top.x - 140.0; x <= top.x + 140.0; x += 1.0)
      for (double y = top.y; y <= top.y + 60.0; y += 1.0) {
        const image::Color c = picture.at({x, y});
        const double bright = std::max(0.0, c.blue - std::max(8.0, c.red + 5.0));
        weight += bright, sum += bright * (x - top.x);
      }
    REQUIRE(weight > 200.0);
    const double aside_px = sum / weight;
    if (turn_rad == 0.0)
      CHECK(std::abs(aside_px) < 12.0);
    else
      CHECK(aside_px * turn_rad < -20.0 * std::abs(turn_rad));
  }
}

}  // namespace septet::frame
