#include "sim-client/sight/standing_world.hpp"

#include <algorithm>
#include <utility>

#include "engine/instant/clouds.hpp"

namespace septet::sight {

SceneParts::SceneParts(scene::ResolvedScene scene)
    : moving(std::move(scene)), summary(instant::summarise(moving)), cloud_noise(instant::cloud_noise()) {
  for (scene::SurfaceMaterial& material : moving.materials) material.emission = glm::vec3(0.0f);
  standing = moving;
  standing.prototypes.clear();
  moving.instances.clear();
  std::erase_if(standing.instances, [](const scene::Instance& instance) { return instance.visible_from_m > 0.0f; });
  for (scene::Instance& instance : standing.instances) instance.visible_to_m = 1e9f;
}

struct StandingWorld::Parts {
  raytrace::SceneIndex index;
  raytrace::Geometry geometry;
  instant::Instant instant{};
  std::unique_ptr<const raytrace::World> world{};
};

StandingWorld::StandingWorld(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
StandingWorld::~StandingWorld() = default;

Expected<std::unique_ptr<const StandingWorld>> StandingWorld::create(const SceneParts& scene, const Vec3& origin_m) {
  auto geometry = raytrace::Geometry::create();
  if (!geometry) return tl::unexpected(geometry.error());
  auto parts = std::make_unique<Parts>(Parts{raytrace::SceneIndex(scene.standing), std::move(*geometry)});
  for (std::size_t n = 0; n < scene.standing.meshes.size(); ++n)
    parts->geometry.add_mesh(scene.standing.meshes[n].vertices, scene.standing.meshes[n].indices, parts->index.open[n]);
  parts->instant.light = std::make_shared<const instant::SkyLight>(instant::sky_light({}));
  instant::FrameView view;
  view.world_from_car.position_m = origin_m;
  parts->instant.views.push_back(view);
  parts->world = std::make_unique<const raytrace::World>(scene.standing, parts->index, parts->instant, nullptr,
                                                         std::span<const raytrace::ClearBody>(), scene.cloud_noise,
                                                         parts->geometry);
  return std::unique_ptr<const StandingWorld>(new StandingWorld(std::move(parts)));
}

raytrace::Ray ray_in(const raytrace::World& world, const Line& line) {
  raytrace::Ray ray;
  ray.origin_m = glm::vec3(line.from_m - world.origin_m());
  ray.direction = glm::vec3(line.direction);
  return ray;
}

double left_behind_surfaces(const raytrace::World& world, raytrace::Ray ray, double share) {
  raytrace::Hit hit;
  raytrace::SurfacePoint point;
  for (int n = 0; n < most_surfaces && world.geometry().intersect(ray, hit); ++n) {
    world.point(ray, hit, point);
    share *= 1.0 - static_cast<double>(point.opacity);
    if (share < opaque_below) return 0.0;
    ray.from_m = beyond_m(hit.distance_m);
    if (!(ray.from_m < ray.to_m)) break;
  }
  return share;
}

double StandingWorld::transmittance(const Line& line, double length_m) const {
  raytrace::Ray ray = ray_in(*parts_->world, line);
  ray.to_m = static_cast<float>(length_m);
  return left_behind_surfaces(*parts_->world, ray, 1.0);
}

}  // namespace septet::sight
