/// A flat face has one light: the walls of lorries' boxes and cabs, in the radiance before exposure.
///
/// A face whose normals lean towards its neighbours' is brighter at one end than at the other, and looks like a
/// cushion.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet {
namespace {

constexpr std::uint32_t face_px = 160;

/// A part of a face without anything on it, vehicle frame; on its left if `left`, else on its rear.
struct FlatFace {
  const char* what;
  std::string_view model;
  bool left;
  double from_m, to_m;  ///< Along x of a side, along y of a rear.
  double low_m, high_m;
};

struct Spread {
  double least = 1e9, most = 0.0;
  double share() const { return (most - least) / most; }
};

/// Luminance over the whole face, as it is seen square on from sixty metres away.
Spread luminance_over(render::Renderer& renderer, const scene::ResolvedScene& scene, const FlatFace& face,
                      const Environment& environment) {
  constexpr double away_m = 60.0;
  const VehicleModel& model = vehicle_models()[*find_vehicle_model(face.model)];
  const double along = 0.5 * (face.from_m + face.to_m), up = 0.5 * (face.low_m + face.high_m);
  instant::FrameInput input;
  input.environment = environment;
  instant::FrameView view;
  const Vec3 eye_m =
      face.left ? Vec3(along, 0.5 * model.width_m + away_m, up) : Vec3(-model.rear_overhang_m - away_m, along, up);
  view.projection = instant::symmetric_view(eye_m, face.left ? -0.5 * std::numbers::pi : 0.0, 0.0,
                                            2.0 * std::atan(0.5 * (face.to_m - face.from_m) / away_m),
                                            2.0 * std::atan(0.5 * (face.high_m - face.low_m) / away_m));
  view.viewport = {0, 0, face_px, face_px};
  input.views = {view};
  const auto prototype = std::ranges::find(scene.prototypes, face.model, &scene::Prototype::name);
  REQUIRE(prototype != scene.prototypes.end());
  Participant vehicle{.id = 1, .model = *find_vehicle_model(face.model)};
  input.participants = {
      instant::drawn_participant(vehicle, static_cast<std::uint32_t>(prototype - scene.prototypes.begin()))};
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  Spread spread;
  const render::RadianceImage seen = *renderer.read_radiance();
  for (const glm::vec3& pixel : seen.radiance) {
    const double luminance = double(glm::dot(pixel, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
    spread.least = std::min(spread.least, luminance);
    spread.most = std::max(spread.most, luminance);
  }
  return spread;
}

}  // namespace

TEST_CASE("the flat faces of lorries have the same light all over, under clouds and in the sun") {
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_vehicles(builder);
  const scene::ResolvedScene scene = scene::resolve(store);
  render::Renderer renderer = *render::Renderer::create(
      {face_px, face_px, render::DevicePreference::software, true, render::Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  for (const FlatFace& face : {FlatFace{"a box's side", "lorry", true, -1.5, 4.0, 2.3, 3.6},
                               FlatFace{"a box's side, below its stripe", "lorry", true, -1.5, 4.0, 1.2, 1.65},
                               FlatFace{"a trailer's side", "articulated-lorry", true, -3.0, 8.0, 2.3, 3.8},
                               FlatFace{"a door of a trailer's rear", "articulated-lorry", false, 0.75, 0.95, 2.1, 2.5},
                               FlatFace{"a cab's door", "lorry", true, 6.75, 7.2, 1.2, 1.6}})
    for (const bool sunny : {false, true}) {
      Environment environment;
      environment.cloud_cover = sunny ? 0.0 : 1.0;
      // It shines on the side or on the rear, two parts ahead to one aside.
      environment.sun_azimuth_rad = face.left ? 0.46 : 4.71 - 0.46;
      const Spread spread = luminance_over(renderer, scene, face, environment);
      CAPTURE(face.what);
      CAPTURE(sunny);
      CAPTURE(spread.least);
      CAPTURE(spread.most);
      CHECK(spread.least > 0.01);
      CHECK(spread.share() < 0.01);
    }
}

}  // namespace septet
