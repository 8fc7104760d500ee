#include "engine/render/passes/smoke_pass.hpp"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

std::vector<SmokePuff> cloud(std::size_t count, const Vec3& middle, double half_m) {
  Random random(1);
  std::vector<SmokePuff> puffs(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) puffs[i].position_m[c] = middle[c] + random.uniform(-half_m, half_m);
    puffs[i].extinction_area_m2 = 0.4f;
    puffs[i].seed = static_cast<std::uint32_t>(i);
  }
  return puffs;
}

FrameView level_view() {
  FrameView view;
  view.projection = *off_axis_view({{2, 1, -1}, {2, -1, -1}, {2, 1, 1}}, {0, 0, 0});
  view.viewport = {0, 0, 640, 640};
  return view;
}

}  // namespace

TEST_CASE("merged smoke is less and hides as much") {
  const auto puffs = cloud(8000, {60, 0, 2}, 10.0);
  const auto merged = merged_puffs(puffs, {0, 0, 1});
  CHECK(merged.size() < puffs.size() / 8);
  double before = 0.0, after = 0.0;
  for (const SmokePuff& puff : puffs) before += puff.extinction_area_m2;
  for (const SmokePuff& puff : merged) after += puff.extinction_area_m2;
  CHECK(after == relative(before, 1e-4));
  // Lines of sight through the cloud keep their optical depth, in the mean.
  double depth_before = 0.0, depth_after = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 point(100.0, 12.0 * std::cos(i * 0.7), 2.0 + 12.0 * std::sin(i * 1.1));
    depth_before -= std::log(transmittance(puffs, {0, 0, 1}, point));
    depth_after -= std::log(transmittance(merged, {0, 0, 1}, point));
  }
  CHECK(depth_after == relative(depth_before, 0.05));
}

TEST_CASE("a puff dims what is behind its middle by its optical depth and nothing before it") {
  SmokePuff puff;
  puff.position_m = {10, 0, 0};
  puff.radius_m = 0.5f;
  puff.extinction_area_m2 = 2.0f * std::numbers::pi_v<float> * 0.25f;  // Depth 1.
  const std::vector puffs{puff};
  CHECK(transmittance(puffs, {0, 0, 0}, {20, 0, 0}) == doctest::Approx(std::exp(-1.0)));
  CHECK(transmittance(puffs, {0, 0, 0}, {9, 0, 0}) == doctest::Approx(1.0));
  CHECK(transmittance(puffs, {0, 0, 0}, {20, 10, 0}) == doctest::Approx(1.0));
}

TEST_CASE("what lies behind much smoke is not drawn and what is drawn comes farthest first") {
  std::vector<SmokePuff> puffs = cloud(45'000, {30, 0, 0}, 14.0);
  const auto far = cloud(500, {200, 0, 0}, 5.0);
  puffs.insert(puffs.end(), far.begin(), far.end());
  const DrawnSmoke smoke = drawn_smoke(puffs, {}, {0, 0, 0});
  const auto records = puff_records(smoke, {}, {}, level_view(), {0, 0, 0});
  REQUIRE(!records.empty());
  CHECK(records.size() < smoke.puffs.size() * 3 / 4);
  for (const PuffRecord& record : records) CHECK(record.position_radius.x < 100.0f);
  for (std::size_t i = 1; i < records.size(); ++i)
    CHECK(glm::length(glm::vec3(records[i - 1].position_radius)) >= glm::length(glm::vec3(records[i].position_radius)));
}

TEST_CASE("thin smoke far away is drawn") {
  const auto records =
      puff_records(drawn_smoke(cloud(50, {200, 0, 0}, 5.0), {}, {0, 0, 0}), {}, {}, level_view(), {0, 0, 0});
  CHECK(!records.empty());
}

TEST_CASE("a beam lights smoke by its candela over the square of the way and less behind other smoke") {
  const auto puff_at = [](double x_m, float depth) {
    SmokePuff puff;
    puff.position_m = {x_m, 0.0, 0.0};
    puff.radius_m = 1.0f;
    puff.extinction_area_m2 = depth * 2.0f * std::numbers::pi_v<float>;
    return puff;
  };
  const Headlight lamp{{0.0, 0.0, 0.0}, {1.0f, 0.0f, 0.0f}, 4.0f, 1.0f};
  const std::vector puffs{puff_at(20.0, 1.0f), puff_at(10.0, 0.3f)};
  const auto both = light_of_beams(puffs, std::span(&lamp, 1), {0, 0, 0});
  const auto alone = light_of_beams(std::span(puffs).first(1), std::span(&lamp, 1), {0, 0, 0});
  CHECK(both[1].r / alone[0].r == relative((400.0 + 1.0) / (100.0 + 1.0), 1e-4));
  CHECK(both[0].r / alone[0].r == relative(std::exp(-0.3), 0.1));
  CHECK(light_of_beams(puffs, {}, {0, 0, 0})[0] == glm::vec3(0.0f));
}

}  // namespace septet::render
