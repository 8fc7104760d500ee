/// A driver's view of a vehicle that has just caught fire: from its ignition by the stage that burns it, through the
/// keyframes that a snapshot carries, to the pixels of a screen of a shipped rig.

#include <algorithm>
#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "engine/rig/rig.hpp"
#include "engine/simulation/effects/fire_stage.hpp"
#include "sim-client/frame/screen_frames.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

constexpr double tick_s = 1.0 / 120.0;
constexpr std::uint32_t fire_width_px = 640, fire_height_px = 458;

/// Bright, and from yellow to red, as no sky, road or smoke is.
bool is_flame_coloured(const image::Color& code) {
  return code.red > 160 && code.red > code.green && code.green > code.blue && code.red > code.blue + 40;
}

/// A van thirty metres ahead in the driver's lane that burns.
class Burning {
 public:
  Burning(const Motorway& motorway, const MotorwayInstant& instant) : motorway_(motorway) {
    shown_ = motorway.snapshot(instant);
    MotorwayInstant ahead = instant;
    ahead.s_m += 30.0;
    Participant van{.id = 90, .model = *find_vehicle_model("van"), .paint = 3};
    van.world_from_vehicle = motorway.frame(ahead).views[0].world_from_car;
    shown_.participants.insert(shown_.participants.end() - 1, van);
    simulation::ignite(road::motorway(), van, 1, fires_);
    rig_ = *rig::read_rig(shipped_text("rigs/seven-screens.toml"), "seven-screens");
    const auto screen = std::ranges::find(rig_.screens, "ahead-3", &rig::Screen::name);
    REQUIRE(screen != rig_.screens.end());
    screen->width_px = fire_width_px, screen->height_px = fire_height_px;
    REQUIRE(frames_.look_through(rig_, *screen).has_value());
    REQUIRE(renderer_.upload(motorway.scene()).has_value());
  }
  /// The picture so long after the ignition.
  image::Image after(double seconds) {
    for (; burnt_s_ < seconds - 0.5 * tick_s; burnt_s_ += 2.0 * tick_s) {
      shown_.tick += 2, shown_.simulated_time_s += 2.0 * tick_s;
      simulation::advance_fires(shown_.participants, shown_.environment, shown_.tick, shown_.simulated_time_s,
                                2.0 * tick_s, fires_);
    }
    shown_.effects = fires_.keyframes;
    frames_.show(shown_, {}, tick_s, motorway_.scene());
    REQUIRE(renderer_.draw(frames_.frame(shown_, motorway_.scene())).has_value());
    return *renderer_.read_back();
  }

 private:
  const Motorway& motorway_;
  Snapshot shown_;
  simulation::FireState fires_;
  double burnt_s_ = 0.0;
  rig::Rig rig_;
  frame::ScreenFrames frames_;
  render::Renderer renderer_ = *render::Renderer::create(
      {fire_width_px, fire_height_px, render::DevicePreference::software, false, render::Antialiasing::automatic});
};

}  // namespace

TEST_CASE("flames of a van thirty metres ahead are seen within a second of its ignition, in the open and in a tunnel") {
  const Motorway motorway;
  for (const MotorwayInstant& instant :
       {MotorwayInstant{"fire-day", 800.0, 0.0, false, false}, MotorwayInstant{"fire-night", 800.0, 0.0, true, false},
        MotorwayInstant{"fire-tunnel", 3330.0, 0.0, false, false}}) {
    Burning burning(motorway, instant);
    const image::Image before = burning.after(0.0);
    const image::Image picture = burning.after(1.0);
    int flames_px = 0;
    for (std::uint32_t y = 0; y < picture.height; ++y)
      for (std::uint32_t x = 0; x < picture.width; ++x)
        flames_px += is_flame_coloured(picture.at(x, y)) && !is_flame_coloured(before.at(x, y));
    image::write_png(build_folder() + "/images/" + instant.name + ".png", picture);
    CAPTURE(instant.name);
    CAPTURE(flames_px);
    CHECK(flames_px > 200);
  }
}

}  // namespace septet
