#pragma once
/// Crash scenes whose energy is followed, for the tests.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/effects/debris/crash.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/energy_ledger.hpp"
#include "tests/engine/effects/debris/crashes.hpp"
#include "tests/engine/effects/debris/pieces.hpp"

namespace septet::debris {

struct Scene {
  std::string name;
  State state;
  ContactWorld world = level_road();
  double seconds = 2.0;
  double released_s = 0.0;  ///< From then on nothing is fixed.
};

namespace scenes {

inline void put(Scene& scene, Part part, const RigidTransform& place, const Vec3& velocity_mps,
                const Vec3& turning_radps = Vec3(0), std::uint64_t seed = 1) {
  Random random(seed);
  spawn_part(scene.state, part, place, velocity_mps, turning_radps, random);
}

inline Box box_at(const Vec3& place_m, const Vec3& half_size_m, const Vec3& velocity_mps = Vec3(0)) {
  Box box;
  box.world_from_box.position_m = place_m;
  box.half_size_m = half_size_m;
  box.velocity_mps = velocity_mps;
  return box;
}

inline Scene bumper_against_post() {
  Scene scene{.name = "bumper against a post"};
  put(scene, Part::bumper, {{-1.0, 0, 0.6}, {1, 0, 0, 0}}, {15, 0, 0});
  scene.world.boxes = {box_at({0, 0, 0.6}, {0.1, 0.1, 0.6})};
  return scene;
}

inline Scene door_bent() {
  Scene scene{.name = "door bent over a barrier's end"};
  put(scene, Part::door, {{0, -1.0, 0.7}, {1, 0, 0, 0}}, {0, 12, 0});
  scene.world.boxes = {box_at({0.4, 0.3, 0.5}, {0.2, 0.3, 0.5})};
  return scene;
}

inline Scene windscreen() {
  Scene scene{.name = "windscreen against a barrier"};
  put(scene, Part::windscreen, {{1.2, 0, 1.0}, {1, 0, 0, 0}}, {-19.4, 0, 0}, Vec3(0), 3);
  scene.world.boxes = {box_at({0, 0, 0.5}, {0.5, 3.0, 0.5})};
  return scene;
}

inline Scene roof_ice() {
  Scene scene{.name = "roof ice from 3.5 m at 18 m/s"};
  put(scene, Part::ice_slab, {{0, 0, 3.5}, glm::angleAxis(0.1, Vec3(0, 1, 0))}, {18, 0, 0}, {0.2, 0.5, 0});
  scene.seconds = 4.0;
  return scene;
}

inline Scene post_run_over(double speed_mps) {
  Scene scene{.name = "post run over at " + std::to_string(static_cast<int>(speed_mps)) + " m/s"};
  put(scene, Part::barrier_post, {{0, 0.3, 0.5}, {1, 0, 0, 0}}, Vec3(0));
  scene.world.boxes = {box_at({-3.0, 0, 0.8}, {2.2, 0.9, 0.6}, {speed_mps, 0, 0})};
  return scene;
}

inline Scene cone_under_wheel() {
  Scene scene{.name = "cone under a wheel"};
  put(scene, Part::traffic_cone, {{0, 0, 0.25}, {1, 0, 0, 0}}, Vec3(0));
  Box wheel = box_at({-1.0, 0, 0.31}, {0.3, 0.1, 0.3}, {5, 0, 0});
  const Vec3 ahead = glm::normalize(Vec3(1, 0, -1));
  wheel.cuts = {{ahead, glm::dot(ahead, Vec3(0.3, 0, -0.1))}};
  scene.world.boxes = {wheel};
  return scene;
}

inline Scene box_thrown() {
  Scene scene{.name = "lamp thrown along the road"};
  put(scene, Part::lamp, {{0, 0, 1.0}, {1, 0, 0, 0}}, {12, 2, 0}, {3, 7, 1});
  scene.seconds = 3.0;
  return scene;
}

inline Scene pile() {
  Scene scene{.name = "pile of pieces"};
  for (int k = 0; k < 5; ++k)
    put(scene, k % 2 == 0 ? Part::lamp : Part::traffic_cone, {{0.03 * k, 0.02 * k, 0.3 + 0.5 * k}, {1, 0, 0, 0}},
        {0, 0, -1}, {0.3 * k, 0.2, 0}, static_cast<std::uint64_t>(k + 1));
  scene.seconds = 4.0;
  return scene;
}

inline Scene two_parts() {
  Scene scene{.name = "two posts that meet"};
  put(scene, Part::barrier_post, {{0, 0, 1.5}, {1, 0, 0, 0}}, Vec3(0));
  put(scene, Part::barrier_post, {{1.0, 0.05, 1.6}, {1, 0, 0, 0}}, {-8, 0, 0}, Vec3(0), 2);
  return scene;
}

inline Scene hanging_beam() {
  Scene scene{.name = "hanging beam let go"};
  put(scene, Part::bumper, {{0, 0, 2.5}, {1, 0, 0, 0}}, Vec3(0));
  auto& body = scene.state.pieces[0].body;
  for (int i = 0; i < body.node_count(); ++i) body.fixed[i] = body.rest_position_m[i].y() < -0.84;
  scene.released_s = 0.5;
  return scene;
}

inline Scene between_two_cars() {
  Scene scene{.name = "bumper between two cars"};
  put(scene, Part::bumper, {{0, 0, 0.6}, {1, 0, 0, 0}}, Vec3(0));
  scene.world.boxes = {box_at({-2.4, 0, 0.8}, {2.2, 0.9, 0.6}, {6, 0, 0}),
                       box_at({2.4, 0, 0.8}, {2.2, 0.9, 0.6}, {-6, 0, 0})};
  scene.seconds = 0.1;
  return scene;
}

inline Scene car_into_barrier() {
  Scene scene{.name = "debris of a car into a barrier at 70 km/h"};
  Random random(3);
  Crash impact = into_barrier(crash_speed_mps);
  crash(scene.state, impact, level_road(), random);
  impact.first.box.velocity_mps = Vec3(0);
  scene.world.boxes = {impact.first.box, impact.second.box};
  return scene;
}

inline std::vector<Scene> all() {
  std::vector<Scene> scenes{bumper_against_post(), door_bent(),        windscreen(), roof_ice(), post_run_over(10.0),
                            post_run_over(20.0),   cone_under_wheel(), box_thrown(), pile(),     two_parts(),
                            hanging_beam(),        car_into_barrier()};
  return scenes;
}

}  // namespace scenes

/// One tick, after which its boxes have moved on.
inline void advance(Scene& scene, double time_s, double tick_s, EnergyLedger* ledger) {
  if (scene.released_s > 0.0 && time_s >= scene.released_s) {
    for (Piece& piece : scene.state.pieces) std::ranges::fill(piece.body.fixed, std::uint8_t{0});
    scene.released_s = 0.0;
  }
  advance_debris(scene.state, scene.world, tick_s, ledger);
  for (Box& box : scene.world.boxes) box.world_from_box.position_m += tick_s * box.velocity_mps;
}

}  // namespace septet::debris
