// What is unobstructed here is what the ray tracer's first surfaces are, of a picture from the same eyes.

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include <doctest/doctest.h>

#include "engine/instant/clouds.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "sim-client/sight/observed_world.hpp"
#include "tests/images/motorway_view.hpp"
#include "tests/why_not.hpp"

namespace septet::sight {
namespace {

/// A scene and an instant in one hierarchy, levels of detail by distance, as a film traces them.
class TracedWorld {
 public:
  TracedWorld(const scene::ResolvedScene& scene, instant::FrameInput input)
      : index_(scene),
        instant_(instant::describe(std::move(input), instant::summarise(scene))),
        noise_(instant::cloud_noise()) {
    auto geometry = raytrace::Geometry::create();
    REQUIRE_MESSAGE(geometry.has_value(), why_not(geometry));
    geometry_.emplace(std::move(*geometry));
    for (std::size_t n = 0; n < scene.meshes.size(); ++n)
      geometry_->add_mesh(scene.meshes[n].vertices, scene.meshes[n].indices, index_.open[n]);
    world_.emplace(scene, index_, instant_, nullptr, std::span<const raytrace::ClearBody>(), noise_, *geometry_);
  }
  /// True if nothing opaque comes before the target.
  bool reaches(const Line& line, ParticipantId target) const {
    raytrace::Ray ray;
    ray.origin_m = glm::vec3(line.from_m - world_->origin_m());
    ray.direction = glm::vec3(line.direction);
    raytrace::Hit hit;
    raytrace::SurfacePoint point;
    for (int n = 0; n < most_surfaces && world_->geometry().intersect(ray, hit); ++n) {
      world_->point(ray, hit, point);
      if (point.opacity > 0.0f && world_->participant(hit.place) == target) return true;
      if (point.opacity >= 1.0f) return false;
      ray.from_m = beyond_m(hit.distance_m);
    }
    return false;
  }

 private:
  raytrace::SceneIndex index_;
  instant::Instant instant_;
  std::vector<std::uint8_t> noise_;
  std::optional<raytrace::Geometry> geometry_;
  std::optional<raytrace::World> world_;
};

}  // namespace

TEST_CASE("of all pixels around vehicles on the motorway 99.5 % are unobstructed where the ray tracer has them so") {
  const Motorway motorway;
  const Snapshot world = motorway.snapshot({"", 800.0, 0.0, false, false});
  const Participant& car = world.participants.back();
  const SceneParts parts(motorway.scene());
  const auto standing = StandingWorld::create(parts, car.world_from_vehicle.position_m + Vec3(400.0, 0.0, 0.0));
  REQUIRE_MESSAGE(standing.has_value(), why_not(standing));
  auto observed = ObservedWorld::create(parts, **standing);
  REQUIRE_MESSAGE(observed.has_value(), why_not(observed));
  observed->take(world);
  observed->look_from(car.id, {Vec3(1.35, 0.37, 1.17), std::nullopt});

  frame::ScreenViews views;
  instant::FrameView view;
  view.projection = instant::symmetric_view(Vec3(1.35, 0.37, 1.17), 0.0, 0.0, 1.0, 1.0);
  view.viewport = {0, 0, 16, 16};
  views.views.push_back(view);
  views.show_interior = true;
  const TracedWorld traced(motorway.scene(),
                           frame::client_frame(world, views, {car.world_from_vehicle, car.id}, motorway.scene()));
  std::size_t pixels = 0, equal = 0, reached = 0, hidden = 0;
  for (const Participant& target : world.participants) {
    if (target.id == car.id || target.id == 0) continue;  // 0 is what stands.
    const Raster raster(observed->eye_m(), box_around(target), 64);
    for (std::uint32_t y = 0; y < raster.height(); ++y)
      for (std::uint32_t x = 0; x < raster.width(); ++x, ++pixels) {
        const Line line = raster.line(x, y);
        const OnLine met = observed->along(line, target.id);
        const bool is_there = met.transmittance > 0.0;
        equal += is_there == traced.reaches(line, target.id);
        reached += is_there;
        hidden += met.meets_target && !is_there;
      }
  }
  const double share = static_cast<double>(equal) / static_cast<double>(pixels);
  MESSAGE(share << " of " << pixels << " pixels agree; " << reached << " unobstructed, " << hidden << " hidden");
  CHECK(share >= 0.995);
  CHECK(reached > pixels / 20);  // Both are met often.
  CHECK(hidden > pixels / 20);
}

}  // namespace septet::sight
