/// A beacon's light on the flank of a car beside it, drawn by both renderers from one description of the instant.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/image/image.hpp"
#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/images/motorway_view.hpp"
#include "tests/images/place_codes.hpp"

namespace septet {
namespace {

constexpr std::uint32_t flank_width_px = 320, flank_height_px = 200, flank_samples = 64;

/// Codes of blue on the flank, by both renderers.
struct FlankCodes {
  double raster = 0.0, traced = 0.0;
};

/// By night a white car stands beside an ambulance, seen from before them.
class Beside {
 public:
  Beside()
      : renderer_(*render::Renderer::create({flank_width_px, flank_height_px, render::DevicePreference::software, false,
                                             render::Antialiasing::automatic, nullptr})),
        tracer_(*raytrace::RayTracer::create(motorway_.scene())) {
    REQUIRE(renderer_.upload(motorway_.scene()).has_value());
  }

  /// At places of the car, m.
  std::vector<FlankCodes> blue(bool beacons, double at_s, std::span<const Vec3> places_m, const std::string& name) {
    const auto input = [&] { return frame(beacons, at_s); };
    REQUIRE(renderer_.draw(input()).has_value());
    const image::Image raster = *renderer_.read_back();
    tracer_.begin(instant::describe(input(), instant::summarise(motorway_.scene())), {.samples = flank_samples});
    const image::Image traced = raytrace::displayed(raytrace::whole_picture(tracer_, flank_width_px, flank_height_px),
                                                    tracer_.instant().exposure);
    if (const char* folder = std::getenv("SEPTET_PICTURES")) {
      CHECK(image::write_png(std::string(folder) + "/beacon-" + name + "-raster.png", raster).has_value());
      CHECK(image::write_png(std::string(folder) + "/beacon-" + name + "-traced.png", traced).has_value());
    }
    const instant::OffAxisView view = input().views.front().projection;
    std::vector<FlankCodes> codes;
    for (const Vec3& place_m : places_m) {
      const Vec3 in_view_m = place_m + car_m;
      codes.push_back({mean_code_at(raster, view, in_view_m, &image::Color::blue),
                       mean_code_at(traced, view, in_view_m, &image::Color::blue)});
    }
    return codes;
  }

 private:
  static inline const Vec3 car_m{0.5, -3.5, 0.0};  ///< Of the ambulance's frame.

  instant::FrameInput frame(bool beacons, double at_s) const {
    instant::FrameInput input = motorway_.frame({"beacon", 800.0, 0.0, true, false});
    const RigidTransform road = input.views[0].world_from_car;
    input.views[0].viewport = {0, 0, flank_width_px, flank_height_px};
    input.views[0].projection = instant::symmetric_view(Vec3(10.0, -0.6, 1.5), 3.387, -0.08, 0.8, 0.5);
    input.simulated_time_s = at_s;
    input.participants = {motorway_.vehicle("ambulance", road),
                          motorway_.vehicle("volvo-s80", road * RigidTransform{car_m, Quat(1, 0, 0, 0)})};
    input.participants[0].lamps.set(Lamp::beacon, beacons);
    input.participants[1].paint = glm::vec3(0.6f);
    return input;
  }

  Motorway motorway_;
  render::Renderer renderer_;
  raytrace::RayTracer tracer_;
};

}  // namespace

TEST_CASE("by night a beacon that flashes is seen on the flank of the car beside it, as much traced as drawn") {
  Beside beside;
  constexpr double seen = 10.0, alike = 25.0;
  // On its doors, high and low.
  const std::vector<Vec3> places_m{{1.9, 0.93, 0.75}, {0.9, 0.93, 0.75}, {1.9, 0.93, 0.45}};
  // Lenses on the right flash in the second half of each half second.
  const std::vector<FlankCodes> dark = beside.blue(false, 12.28, places_m, "dark"),
                                lit = beside.blue(true, 12.28, places_m, "lit");
  for (std::size_t n = 0; n < places_m.size(); ++n) {
    CAPTURE(n);
    const double raster = lit[n].raster - dark[n].raster, traced = lit[n].traced - dark[n].traced;
    CAPTURE(raster);
    CAPTURE(traced);
    CHECK(raster >= seen);
    CHECK(traced >= seen);
    CHECK(std::abs(raster - traced) <= alike);
  }
}

}  // namespace septet
