/// The driver's car from his eyes, drawn by both renderers from one description of the instant: how alike its inside is
/// lit.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "engine/render/renderer.hpp"
#include "engine/rig/rig.hpp"
#include "sim-client/frame/screen_frames.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/images/motorway_view.hpp"
#include "tests/images/place_codes.hpp"
#include "tests/shipped_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t seat_width_px = 320, seat_height_px = 187, seat_samples = 48;

/// The desktop's screen, without the text over it.
class Seat {
 public:
  explicit Seat(const Motorway& motorway)
      : motorway_(motorway),
        rig_(*rig::read_rig(shipped_text("rigs/desktop.toml"), "desktop")),
        renderer_(*render::Renderer::create({seat_width_px, seat_height_px, render::DevicePreference::software, false,
                                             render::Antialiasing::automatic})),
        tracer_(*raytrace::RayTracer::create(motorway.scene())) {
    rig_.screens.front().width_px = seat_width_px;
    rig_.screens.front().height_px = seat_height_px;
    REQUIRE(frames_.look_through(rig_, rig_.screens.front()).has_value());
    REQUIRE(renderer_.upload(motorway.scene()).has_value());
  }

  struct Pictures {
    image::Image raster, traced;
  };
  Pictures draw(const Snapshot& shown, const std::string& name) {
    instant::FrameInput input = frames_.frame(shown, motorway_.scene());
    input.overlay.clear();
    REQUIRE(renderer_.draw(input).has_value());
    const image::Image raster = *renderer_.read_back();
    view_ = input.views.front();
    tracer_.begin(instant::describe(std::move(input), instant::summarise(motorway_.scene())),
                  {.samples = seat_samples});
    const auto traced = raytrace::whole_picture(tracer_, seat_width_px, seat_height_px);
    Pictures pictures{raster, raytrace::displayed(traced, tracer_.instant().exposure)};
    if (const char* folder = std::getenv("SEPTET_PICTURES")) {
      CHECK(image::write_png(std::string(folder) + "/cabin-" + name + "-raster.png", pictures.raster).has_value());
      CHECK(image::write_png(std::string(folder) + "/cabin-" + name + "-traced.png", pictures.traced).has_value());
    }
    return pictures;
  }

  double code_at(const image::Image& picture, const Vec3& place_m) const {
    return green_at(picture, view_.projection, place_m);
  }

 private:
  const Motorway& motorway_;
  rig::Rig rig_;
  frame::ScreenFrames frames_;
  render::Renderer renderer_;
  raytrace::RayTracer tracer_;
  instant::FrameView view_;
};

struct InsidePlace {
  std::string name;
  Vec3 place_m;  ///< Of the car.
};

}  // namespace

TEST_CASE("by day rasteriser and ray tracer light the cabin alike, whichever way the sun stands and under clouds") {
  const Motorway motorway;
  Seat seat(motorway);
  constexpr double alike = 15.0;
  struct DayLight {
    std::string name;
    double turned_rad, elevation_rad, clouds;
  };
  for (const DayLight& day : {DayLight{"usual", 0.0, 0.0, -1.0}, DayLight{"ahead", 1.57, 0.6, 0.0},
                              DayLight{"behind", -1.57, 0.6, 0.0}, DayLight{"overcast", 0.0, 0.7, 1.0}}) {
    Snapshot shown = motorway.snapshot({"cabin", 800.0, 0.0, false, false});
    if (day.clouds >= 0.0) {
      shown.environment.sun_azimuth_rad = day.turned_rad;
      shown.environment.sun_elevation_rad = day.elevation_rad;
      shown.environment.cloud_cover = day.clouds;
    }
    const Seat::Pictures pictures = seat.draw(shown, day.name);
    for (const InsidePlace& at :
         {InsidePlace{"dashboard before the passenger", {1.96, 0.12, 0.946}},
          InsidePlace{"dashboard beside the hood", {2.05, 0.60, 0.942}}, InsidePlace{"pillar", {1.98, 0.66, 1.185}}}) {
      CAPTURE(day.name);
      CAPTURE(at.name);
      const double raster = seat.code_at(pictures.raster, at.place_m),
                   traced = seat.code_at(pictures.traced, at.place_m);
      CAPTURE(raster);
      CAPTURE(traced);
      CHECK(std::abs(raster - traced) <= alike);
    }
  }
}

}  // namespace septet
