#include "engine/instant/scene_summary.hpp"

#include <cmath>

#include <doctest/doctest.h>

namespace septet::instant {
namespace {

/// Two stretches of one tunnel along x, from 0 to 160 and on to 320 m, overlapping by a metre.
SceneSummary tunnel() {
  SceneSummary scene;
  for (const double from : {0.0, 160.0})
    scene.roofs.push_back(
        {inverse(RigidTransform{Vec3(from, 0, 0), {1, 0, 0, 0}}), {-0.5f, -12.0f, -1.0f}, {160.5f, 12.0f, 7.0f}, 0.0f});
  return scene;
}

}  // namespace

TEST_CASE(
    "a vehicle that drives into a tunnel and out goes dark and bright by and by and stays dark where two stretches "
    "meet") {
  const SceneSummary scene = tunnel();
  const auto at = [&](double x_m) { return share_of_sky(scene, RigidTransform{Vec3(x_m, 3, 0), {1, 0, 0, 0}}); };
  CHECK(at(-30.0) == 1.0f);
  CHECK(at(360.0) == 1.0f);
  float before = 1.0f;
  for (double x = -30.0; x < 360.0; x += 0.25) {
    const float now = at(x);
    CAPTURE(x);
    CHECK(std::abs(now - before) < 0.02f);
    if (x > 8.0 && x < 310.0) CHECK(now == doctest::Approx(0.0f).epsilon(1e-6));
    before = now;
  }
  // Beside the tube and above it the sky is open.
  CHECK(share_of_sky(scene, RigidTransform{Vec3(100, 20, 0), {1, 0, 0, 0}}) == 1.0f);
  CHECK(share_of_sky(scene, RigidTransform{Vec3(100, 0, 12), {1, 0, 0, 0}}) == 1.0f);
}

}  // namespace septet::instant
