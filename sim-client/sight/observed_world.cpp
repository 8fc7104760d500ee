#include "sim-client/sight/observed_world.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/check.hpp"
#include "engine/instant/mirror_glass.hpp"
#include "sim-client/frame/client_frame.hpp"

namespace septet::sight {
namespace {

/// View of everything from the eyes; only its place counts here.
frame::ScreenViews views_from(const Vec3& eye_m, const Participant& observer, const Snapshot& world,
                              const DriverSeat& seat) {
  frame::ScreenViews views;
  instant::FrameView view;
  constexpr double right_angle = 0.5 * std::numbers::pi;
  view.projection = instant::symmetric_view(eye_m, 0.0, 0.0, right_angle, right_angle);
  view.viewport = {0, 0, 1, 1};
  views.views.push_back(view);
  views.show_interior = true;
  // Their housings hide; the glass between is not asked for a picture.
  if (observer.id == world.driver_car.participant && seat.rig)
    for (const rig::Mirror& mirror : seat.rig->mirrors) views.mirrors.push_back({mirror, {}});
  return views;
}

}  // namespace

struct ObservedWorld::Parts {
  const SceneParts& scene;
  const StandingWorld& standing;
  raytrace::SceneIndex index;
  raytrace::Geometry geometry;
  Snapshot world{};
  std::function<void(instant::FrameInput&)> add_effects{};
  Environment lit_by{};
  std::shared_ptr<const instant::SkyLight> light{};
  instant::Instant instant{};
  raytrace::Smoke smoke{};
  Vec3 eye_m{0.0};
  std::unique_ptr<const raytrace::World> moving{};
};

ObservedWorld::ObservedWorld(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
ObservedWorld::ObservedWorld(ObservedWorld&&) noexcept = default;
ObservedWorld& ObservedWorld::operator=(ObservedWorld&&) noexcept = default;
ObservedWorld::~ObservedWorld() = default;

Expected<ObservedWorld> ObservedWorld::create(const SceneParts& scene, const StandingWorld& standing) {
  auto geometry = raytrace::Geometry::create(raytrace::Rays::few);
  if (!geometry) return tl::unexpected(geometry.error());
  auto parts =
      std::make_unique<Parts>(Parts{scene, standing, raytrace::SceneIndex(scene.moving), std::move(*geometry)});
  for (std::size_t n = 0; n < scene.moving.meshes.size(); ++n)
    parts->geometry.add_mesh(scene.moving.meshes[n].vertices, scene.moving.meshes[n].indices, parts->index.open[n]);
  return ObservedWorld(std::move(parts));
}

void ObservedWorld::take(const Snapshot& world, std::function<void(instant::FrameInput&)> add_effects) {
  Parts& p = *parts_;
  p.world = world;
  p.add_effects = std::move(add_effects);
  if (!p.light || !(p.lit_by == world.environment)) {
    p.light = std::make_shared<const instant::SkyLight>(instant::sky_light(world.environment));
    p.lit_by = world.environment;
  }
}

void ObservedWorld::look_from(ParticipantId observer_id, const DriverSeat& seat) {
  Parts& p = *parts_;
  const Participant* observer = find_participant(p.world, observer_id);
  SEPTET_CHECK(observer && p.light, "no participant {} at tick {}", observer_id, p.world.tick);
  const Vec3 eye_in_m = eye_in_vehicle(*observer, p.world, seat);
  p.eye_m = observer->world_from_vehicle * eye_in_m;
  auto input = frame::client_frame(p.world, views_from(eye_in_m, *observer, p.world, seat),
                                   {observer->world_from_vehicle, observer_id}, p.scene.moving);
  if (p.add_effects) p.add_effects(input);
  p.moving.reset();
  p.instant = instant::describe(std::move(input), p.scene.summary, p.light);
  // Nothing is lit here, and no ripple on a road hides anybody.
  for (instant::PlacedMesh& part : p.instant.parts) part.tint.w = 0.0f;
  p.instant.environment.rain_mm_per_h = 0.0;
  p.smoke = raytrace::Smoke(p.instant.smoke, p.eye_m);
  p.instant.smoke.clear();
  p.moving =
      std::make_unique<const raytrace::World>(p.scene.moving, p.index, p.instant, nullptr,
                                              std::span<const raytrace::ClearBody>(), p.scene.cloud_noise, p.geometry);
}

const Vec3& ObservedWorld::eye_m() const { return parts_->eye_m; }

OnLine ObservedWorld::along(const Line& line, ParticipantId target, double from_m) const {
  const Parts& p = *parts_;
  const raytrace::World& world = *p.moving;
  raytrace::Ray ray = ray_in(world, line);
  ray.from_m = static_cast<float>(from_m);
  OnLine met;
  double passes = 1.0;
  raytrace::Hit hit;
  raytrace::SurfacePoint point;
  for (int n = 0; n < most_surfaces && world.geometry().intersect(ray, hit); ++n) {
    world.point(ray, hit, point);
    ray.from_m = beyond_m(hit.distance_m);
    if (point.opacity <= 0.0f) continue;  // The back of a surface that has one side.
    if (world.participant(hit.place) == target) {
      met.meets_target = true;
      met.target_m = hit.distance_m;
      break;
    }
    passes *= 1.0 - static_cast<double>(point.opacity);
  }
  if (!met.meets_target || passes < opaque_below) return met;
  const Line rest{line.from_m + from_m * line.direction, line.direction};
  passes *= p.standing.transmittance(rest, met.target_m - from_m);
  if (passes < opaque_below) return met;
  ray.from_m = static_cast<float>(from_m), ray.to_m = static_cast<float>(met.target_m);
  const double depth = static_cast<double>(p.smoke.optical_depth(ray)) +
                       static_cast<double>(p.instant.extinction_per_m) * (met.target_m - from_m);
  met.transmittance = passes * std::exp(-depth);
  return met;
}

double ObservedWorld::transmittance(const Line& line, double length_m) const {
  const Parts& p = *parts_;
  const raytrace::World& world = *p.moving;
  raytrace::Ray ray = ray_in(world, line);
  ray.to_m = static_cast<float>(length_m);
  const double in_air = std::exp(-static_cast<double>(p.smoke.optical_depth(ray)) -
                                 static_cast<double>(p.instant.extinction_per_m) * length_m);
  const double passes = left_behind_surfaces(world, ray, in_air);
  return passes > 0.0 ? passes * p.standing.transmittance(line, length_m) : 0.0;
}

}  // namespace septet::sight
