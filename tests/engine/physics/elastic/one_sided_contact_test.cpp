/// A surface presses and never pulls.

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

constexpr double kilohertz_s = 0.001, tick_s = 1.0 / 240.0;

/// One step of a body whose lower side stands on the ground at z = 0; the sum of the ground's impulses along z, and the least of
/// them.
struct Footing {
  double sum_ns = 0.0, least_ns = 0.0;
};
Footing step_on_ground(ElasticBody& body, const StepSettings& settings) {
  std::vector<NodeContact> contacts;
  for (int i = 0; i < body.node_count(); ++i)
    if (body.rest_position_m[i].z() < 1e-9) contacts.push_back({.node = i, .gap_m = body.position_m[i].z()});
  step_elastic(body, settings, contacts);
  Footing footing;
  for (const NodeContact& c : contacts) {
    footing.sum_ns += c.impulse_ns.z();
    footing.least_ns = std::min(footing.least_ns, c.impulse_ns.z());
  }
  return footing;
}

ElasticBody concrete_post() {
  return *make_elastic_body(lattice_mesh({2, 2, 8}, {0.15, 0.15, 1.0}), {30e9, 0.2, 2400.0});
}

ElasticBody rubber_block() { return *make_elastic_body(lattice_mesh({2, 2, 2}, {0.2, 0.2, 0.2}), {1e6, 0.4, 1100.0}); }

double height_m(const ElasticBody& body) { return centre_of_mass_m(body).z(); }

/// How high a rubber block springs whose height was pressed to 90 %.
double spring_m(double step_s) {
  ElasticBody block = rubber_block();
  const double standing_m = height_m(block);
  for (auto& x : block.position_m) x.z() *= 0.9;
  StepSettings settings;
  settings.step_s = step_s;
  double highest_m = 0.0;
  for (double time_s = 0.0; time_s < 0.6; time_s += step_s) {
    step_on_ground(block, settings);
    highest_m = std::max(highest_m, height_m(block) - standing_m);
  }
  return highest_m;
}

}  // namespace

TEST_CASE("a standing post that is pulled up by 1.01 of its weight leaves the ground within two steps") {
  for (const double step_s : {tick_s, 1.0 / 60.0}) {
    CAPTURE(step_s);
    ElasticBody post = concrete_post();
    StepSettings settings;
    settings.step_s = step_s;
    const double weight_n = total_mass_kg(post) * gravity_mps2;
    Footing footing;
    for (int k = 0; k < 400; ++k) footing = step_on_ground(post, settings);
    CHECK(footing.sum_ns == relative(weight_n * step_s, 0.01));  // It stands.
    const double standing_m = height_m(post);
    for (int i = 0; i < post.node_count(); ++i)
      if (post.rest_position_m[i].z() > 1.0 - 1e-9) post.force_n[i].z() = 1.01 * weight_n / 9.0;
    for (int k = 0; k < 2; ++k) footing = step_on_ground(post, settings);
    CHECK(footing.sum_ns == 0.0);
    for (int k = 0; k < 60; ++k) CHECK(step_on_ground(post, settings).least_ns >= 0.0);
    const double pulled_s = 62 * step_s;
    CHECK(height_m(post) - standing_m == relative(0.5 * 0.01 * gravity_mps2 * pulled_s * pulled_s, 0.1));
  }
}

TEST_CASE("a pressed rubber block springs from the ground") {
  const double fine_m = spring_m(kilohertz_s);
  CHECK(fine_m > 0.1);
  CHECK(spring_m(tick_s) > 0.4 * fine_m);  // Of what is stiff, longer steps damp more.
}

TEST_CASE("a rubber block rests within two millimetres at 240 steps a second") {
  ElasticBody block = rubber_block();
  const double free_m = height_m(block);
  StepSettings settings;
  settings.step_s = tick_s;
  for (int k = 0; k < 480; ++k) {
    step_on_ground(block, settings);
    CHECK(std::abs(height_m(block) - free_m) < 0.002);
  }
}
