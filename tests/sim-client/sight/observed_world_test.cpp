// Sight in a world of boxes whose geometry is worked out by hand.

#include "sim-client/sight/observed_world.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "sim-client/sight/pair_sight.hpp"
#include "sim-client/sight/session_sight.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::sight {
namespace {

constexpr ParticipantId watcher = 1, walker = 2, other = 3;
constexpr double tick_s = 1.0 / 120.0;
constexpr double walker_width_m = 0.5, walker_height_m = 1.75;

/// A box from corner to corner, of one material.
scene::SurfaceMesh box_mesh(const glm::vec3& low, const glm::vec3& high, std::uint32_t material = 0) {
  scene::SurfaceMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      glm::vec3 normal(0.0f);
      normal[axis] = far ? 1.0f : -1.0f;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (int corner = 0; corner < 4; ++corner) {
        glm::vec3 at;
        at[axis] = far ? high[axis] : low[axis];
        at[(axis + 1) % 3] = (corner & 1) ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
        at[(axis + 2) % 3] = (corner & 2) ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
        mesh.vertices.push_back({at, normal, {}});
      }
      for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.indices.push_back(first + corner);
      if (!far)
        for (std::size_t n = mesh.indices.size() - 6; n < mesh.indices.size(); n += 3)
          std::swap(mesh.indices[n], mesh.indices[n + 1]);
    }
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), material});
  mesh.bounds_min_m = low, mesh.bounds_max_m = high;
  return mesh;
}

class BoxScene {
 public:
  BoxScene() {
    scene_.materials.resize(2);
    scene_.materials[1].opacity = 0.3f;
    // As flat as a board towards x, so that its silhouette from there is a rectangle.
    prototype("pedestrian", {-1e-4f, -0.5 * walker_width_m, 0.0f}, {1e-4f, 0.5 * walker_width_m, walker_height_m});
  }
  void prototype(const char* name, const glm::vec3& low, const glm::vec3& high) {
    scene_.prototypes.push_back({name, {part(box_mesh(low, high))}});
  }
  void stand(const glm::vec3& low, const glm::vec3& high, std::uint32_t material = 0) {
    scene_.instances.push_back(part(box_mesh(low, high, material)));
  }
  const scene::ResolvedScene& scene() const { return scene_; }

 private:
  scene::Instance part(scene::SurfaceMesh mesh) {
    scene_.meshes.push_back(std::move(mesh));
    scene::Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    return instance;
  }
  scene::ResolvedScene scene_;
};

/// The scene and its two worlds together.
struct Stage {
  explicit Stage(const BoxScene& scene) : parts(scene.scene()) {
    auto made = StandingWorld::create(parts, Vec3(0.0));
    REQUIRE_MESSAGE(made.has_value(), why_not(made));
    standing = std::move(*made);
    auto world = ObservedWorld::create(parts, *standing);
    REQUIRE_MESSAGE(world.has_value(), why_not(world));
    observed.emplace(std::move(*world));
  }
  Sight sight(const Snapshot& world, std::function<void(instant::FrameInput&)> effects = {}) {
    observed->take(world, std::move(effects));
    observed->look_from(watcher, {});
    return straight_sight(*observed, *find_participant(world, walker), {});
  }
  SceneParts parts;
  std::unique_ptr<const StandingWorld> standing;
  std::optional<ObservedWorld> observed;
};

void add(Snapshot& world, ParticipantId id, const char* model, const Vec3& place_m) {
  Participant participant;
  participant.id = id;
  participant.model = *find_vehicle_model(model);
  participant.world_from_vehicle.position_m = place_m;
  world.participants.push_back(participant);
}

/// The watcher's eyes at x = 0, y = 0, those of a walker; the other walker at a place.
Snapshot two_walkers(const Vec3& other_m) {
  Snapshot world;
  world.environment.visibility_m = 1e9;
  const Vec3 eye_m = scenery::eye_in(vehicle_models()[*find_vehicle_model("pedestrian")]);
  add(world, watcher, "pedestrian", {-eye_m.x, -eye_m.y, 0.0});
  add(world, walker, "pedestrian", other_m);
  return world;
}

}  // namespace

TEST_CASE("a walker who steps out from behind a wall is first unobstructed at the tick that geometry gives") {
  constexpr double wall_m = 8.0, way_m = 20.0, edge_m = -0.73, speed_mps = 1.9, begin_m = -2.99;
  BoxScene scene;
  scene.stand({wall_m - 0.05, -30.0, -1.0}, {wall_m, edge_m, 6.0});
  Stage stage(scene);
  const Threshold threshold{.light = 0.05};
  const auto at_m = [&](Tick tick) { return begin_m + speed_mps * static_cast<double>(tick) * tick_s; };
  // The wall's far edge hides what lies right of this at the board's distance; 5 % of its width must lie left of it.
  const double line_m = edge_m * way_m / wall_m;
  const double first_tick = (line_m + (0.05 - 0.5) * walker_width_m - begin_m) / speed_mps / tick_s;
  const auto is_open = [&](Tick tick) { return threshold.holds(stage.sight(two_walkers({way_m, at_m(tick), 0.0}))); };
  REQUIRE_FALSE(is_open(0));
  REQUIRE(is_open(200));
  CHECK(first_changed(0, 200, is_open) == static_cast<Tick>(std::ceil(first_tick)));
  // Half of it is seen when its middle is in line with the edge.
  const Sight half = stage.sight(two_walkers({way_m, line_m, 0.0}));
  CHECK(half.share() == relative(0.5, 0.02));
  CHECK(half.transmittance > 0.999);  // Of the haze of the clearest air.
}

TEST_CASE("a lorry that drives away opens the line at the tick that geometry gives, and its sight both ways agrees") {
  BoxScene scene;
  scene.prototype("lorry", {-4.25f, -1.25f, 0.0f}, {7.65f, 1.25f, 3.8f});
  Stage stage(scene);
  constexpr double lorry_m = 10.0, way_m = 25.0, speed_mps = 6.0;
  const auto world_at = [&](Tick tick) {
    Snapshot world = two_walkers({way_m, 0.0, 0.0});
    add(world, other, "lorry", {lorry_m, -2.0, 0.0});
    // It stands across and moves to the left: its tail is its right side.
    world.participants.back().world_from_vehicle.orientation = orientation_from_angles(0.5 * std::numbers::pi, 0, 0);
    world.participants.back().world_from_vehicle.position_m.y += speed_mps * static_cast<double>(tick) * tick_s;
    return world;
  };
  // Its tail at y = −6.25 + v t hides all left of the line by its corner that is nearer to the eye. The board's right
  // edge is free first: 20 % of its width must lie right of that line.
  const Threshold threshold{.light = 0.2};
  const double tail_m = (0.2 - 0.5) * walker_width_m * (lorry_m - 1.25) / way_m;
  const double first_tick = (tail_m + 6.25) / speed_mps / tick_s;
  const auto is_open = [&](Tick tick) { return threshold.holds(stage.sight(world_at(tick))); };
  REQUIRE_FALSE(is_open(0));
  REQUIRE(is_open(240));
  CHECK(first_changed(0, 240, is_open) == static_cast<Tick>(std::ceil(first_tick)));
}

TEST_CASE("a pillar of the observer's own vehicle hides as wide a band as the law of rays says") {
  // A pillar 12 cm wide at 0.75 m before one eye hides 3.2 m at 20 m.
  const Vec3 eye_m = scenery::eye_in(vehicle_models()[*find_vehicle_model("saloon")]);
  BoxScene scene;
  const glm::vec3 eye(eye_m);
  scene.prototype("interior/saloon", eye + glm::vec3(0.75f, -0.06f, -1.0f), eye + glm::vec3(0.751f, 0.06f, 2.0f));
  scene.prototype("saloon", {-0.98f, -0.9f, 0.0f}, {3.64f, 0.9f, 1.44f});  // Not drawn while the eyes are in it.
  Stage stage(scene);
  Snapshot world;
  world.environment.visibility_m = 1e9;
  add(world, watcher, "saloon", -Vec3(eye_m.x, eye_m.y, 0.0));
  add(world, walker, "pedestrian", Vec3(0.0));
  const auto share_at = [&](double y_m) {
    world.participants[1].world_from_vehicle.position_m = {20.0, y_m, 0.0};
    return stage.sight(world).share();
  };
  CHECK(share_at(0.0) == 0.0);
  CHECK(share_at(1.6 - 0.26) == 0.0);
  CHECK(share_at(1.6) == relative(0.5, 0.03));
  CHECK(share_at(-1.6) == relative(0.5, 0.03));
  CHECK(share_at(1.6 + 0.26) == 1.0);
}

TEST_CASE("light through a puff of smoke, through fog and through a pane is what their laws say") {
  const Vec3 place_m(20.0, 0.0, 0.0);
  const BoxScene empty;
  Stage open(empty);
  // A Gaussian ball: its depth at a distance b from its middle is A / (2π r²) · exp(−b² / 2r²).
  constexpr float radius_m = 2.0f, area_m2 = 20.0f;
  const Vec3 middle_m(9.0, 0.8, 1.5);
  const Sight smoky = open.sight(two_walkers(place_m), [&](instant::FrameInput& frame) {
    frame.smoke.push_back({.position_m = middle_m, .radius_m = radius_m, .extinction_area_m2 = area_m2});
  });
  const Vec3 eye_m(0.0, 0.0, scenery::eye_in(vehicle_models()[*find_vehicle_model("pedestrian")]).z);
  double sum = 0.0;
  int count = 0;
  for (int column = 0; column < 50; ++column)
    for (int row = 0; row < 175; ++row, ++count) {
      const double y = 0.01 * column - 0.245, z = 0.01 * row + 0.005;
      const Vec3 way = glm::normalize(Vec3(20.0, y, z) - eye_m);
      const double beside_m = glm::length(glm::cross(middle_m - eye_m, way));
      sum += std::exp(-area_m2 / (2.0 * std::numbers::pi * radius_m * radius_m) *
                      std::exp(-0.5 * beside_m * beside_m / (radius_m * radius_m)));
    }
  CHECK(smoky.share() == 1.0);
  // The ray tracer spreads a puff over cells of half its radius.
  CHECK(smoky.transmittance == relative(sum / count, 0.03));

  Snapshot foggy = two_walkers(place_m);
  foggy.environment.visibility_m = 60.0;
  const double koschmieder = 3.912 / 60.0;
  CHECK(open.sight(foggy).transmittance == relative(std::exp(-koschmieder * 20.0), 0.02));

  BoxScene glazed;
  glazed.stand({9.99f, -9.0f, -9.0f}, {10.0f, 9.0f, 9.0f}, 1);
  Stage pane(glazed);
  const Sight behind = pane.sight(two_walkers(place_m));
  CHECK(behind.share() == 1.0);
  // Both faces take 30 % and mirror about 4 %.
  CHECK(behind.transmittance == relative(0.66 * 0.66, 0.05));
}

TEST_CASE("somebody behind is seen in the mirror alone, and a wall beside the car takes that too") {
  const auto in_mirrors = [](bool walled) {
    BoxScene scene;
    if (walled) scene.stand({-8.0f, -20.0f, -1.0f}, {-7.9f, 20.0f, 6.0f});
    Stage stage(scene);
    const Vec3 eye_m = scenery::eye_in(vehicle_models()[*find_vehicle_model("saloon")]);
    Snapshot world;
    world.environment.visibility_m = 1e9;
    add(world, watcher, "saloon", Vec3(0.0));
    add(world, walker, "pedestrian", Vec3(-15.0, 2.5, 0.0));
    stage.observed->take(world);
    stage.observed->look_from(watcher, {});
    CHECK(glm::length(stage.observed->eye_m() - eye_m) < 1e-9);
    return mirror_sights(*stage.observed, world.participants[0], mirrors_of(world.participants[0], world, {}),
                         world.participants[1], {});
  };
  const auto free = in_mirrors(false), hidden = in_mirrors(true);
  const auto left = std::ranges::find(free, "left mirror", &MirrorSight::mirror);
  REQUIRE(left != free.end());
  CHECK(left->sight.share() == 1.0);
  CHECK(std::ranges::find(free, "right mirror", &MirrorSight::mirror) == free.end());
  for (const MirrorSight& each : hidden) CHECK(each.sight.share() == 0.0);
  CHECK_FALSE(hidden.empty());
}

}  // namespace septet::sight
