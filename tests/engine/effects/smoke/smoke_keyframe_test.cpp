#include <doctest/doctest.h>

#include <map>

#include "engine/core/random.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "smoke_fixtures.hpp"
#include "tests/engine/effects/smoke/puffs_of.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

constexpr double tick_s = 1.0 / 120.0;

/// 20,000 particles at once, near the fire.
State full_tunnel() {
  State state = tunnel_fire(1, 20000);
  Random random(5);
  for (int n = 0; n < 20000; ++n)
    add_particle(state, {random.uniform(20.0, 100.0), random.uniform(1.0, 10.0), random.uniform(0.0, 6.0)}, 0,
                 static_cast<float>(random.uniform(0.0, 35.0)));
  return state;
}

/// The keyframes that stand after so many ticks in still air.
std::vector<EffectKeyframe> keyframes_after(int ticks, State& state) {
  KeyframeTrack track;
  std::vector<EffectKeyframe> effects;
  for (int tick = 0; tick < ticks; ++tick) {
    advance_smoke(state, Vec3(0.0), {}, tick_s);
    effects = advance_keyframes(track, state);
  }
  return effects;
}

}  // namespace

TEST_CASE("a keyframe gives back every particle within its stated bound") {
  State state = tunnel_fire(1, 2000);
  const auto effects = keyframes_after(360, state);
  REQUIRE(effects.size() >= 3);
  std::size_t compared = 0;
  for (const EffectKeyframe& effect : effects) {
    CHECK(effect.kind == keyframe_kind);
    const auto keyframe = decode(effect.data);
    REQUIRE(keyframe);
    // Those taken this very tick can be compared with the state.
    if (keyframe->time_s != state.time_s) continue;
    CHECK(keyframe->duration_s == doctest::Approx(keyframe_ticks * tick_s));
    for (const auto& p : keyframe->particles) {
      const auto number = static_cast<std::uint32_t>(keyframe->chunk * chunk_slots + p.slot);
      const auto found = std::ranges::find(state.particles.number, number);
      REQUIRE(found != state.particles.number.end());
      const auto slot = static_cast<std::size_t>(found - state.particles.number.begin());
      REQUIRE(std::abs(p.to.x - state.particles.x[slot]) <= 0.5f / steps_per_cell + 1e-4f);
      REQUIRE(std::abs(p.to.y - state.particles.y[slot]) <= 0.5f / steps_per_cell + 1e-4f);
      REQUIRE(std::abs(p.to.z - state.particles.z[slot]) <= 0.5f / steps_per_cell + 1e-4f);
      REQUIRE(std::abs(p.age_s - state.particles.age_s[slot]) <= 40.0f / 510.0f + 1e-3f);
      ++compared;
    }
  }
  // The last tick is one on which chunk 0 is renewed.
  CHECK(compared == chunk_slots);
}

TEST_CASE("what is shown goes on without a jump when the next keyframe comes") {
  State state = tunnel_fire(1, 400);
  KeyframeTrack track;
  std::optional<Keyframe> last;
  int joined = 0;
  for (int tick = 0; tick < 400; ++tick) {
    advance_smoke(state, Vec3(0.0), {}, tick_s);
    const auto effects = advance_keyframes(track, state);
    if (effects.empty()) continue;
    auto now = decode(effects.front().data);
    REQUIRE(now);
    if (last && now->time_s != last->time_s) {
      std::map<std::uint16_t, glm::vec3> end;
      for (const auto& p : last->particles) end[p.slot] = p.to;
      for (const auto& p : now->particles) {
        if (p.newborn) continue;
        REQUIRE(end.contains(p.slot));
        REQUIRE(glm::length(end[p.slot] - p.from) == 0.0f);
        ++joined;
      }
    }
    last = *now;
  }
  CHECK(joined > 300);
}

TEST_CASE("puffs carry the cross-section of their particles to where they are in the world") {
  State state = full_tunnel();
  const auto effects = keyframes_after(60, state);
  std::uint32_t refused = 0;
  const auto puffs = puffs_of(effects, state.time_s, &refused);
  CHECK(refused == 0);
  double drawn_m2 = 0.0, simulated_m2 = 0.0;
  for (const Puff& puff : puffs) {
    drawn_m2 += puff.extinction_area_m2;
    const Vec3 p = state.grid.grid_from_world(puff.position_m);
    REQUIRE(state.grid.inside(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                              static_cast<int>(std::floor(p.z))));
  }
  for (const float area : state.extinction_area_m2) simulated_m2 += area;
  CHECK(drawn_m2 == relative(simulated_m2, 0.03));
}

TEST_CASE("twenty thousand visible particles need less than two megabytes a second") {
  State state = full_tunnel();
  KeyframeTrack track;
  std::map<std::uint32_t, Bytes> seen;
  std::size_t bytes = 0, largest_tick = 0, snapshot = 0;
  for (int tick = 0; tick < 180; ++tick) {
    advance_smoke(state, Vec3(0.0), {}, tick_s);
    std::size_t this_tick = 0;
    snapshot = 0;
    for (const EffectKeyframe& effect : advance_keyframes(track, state)) {
      snapshot += effect.data.size();
      if (seen[effect.id] == effect.data) continue;
      this_tick += effect.data.size();
      seen[effect.id] = effect.data;
    }
    if (tick < 60) continue;  // One second is measured, once every chunk has been sent.
    bytes += this_tick;
    largest_tick = std::max(largest_tick, this_tick);
  }
  REQUIRE(state.particles.size() > 19000);
  MESSAGE(bytes << " bytes a second, at most " << largest_tick << " in a tick; a whole snapshot has " << snapshot);
  CHECK(bytes < 2'000'000);
  CHECK(bytes > 100'000);
  CHECK(largest_tick < 20'000);
}

TEST_CASE("hostile smoke keyframes are refused or harmless") {
  State state = tunnel_fire(1, 600);
  const auto effects = keyframes_after(61, state);
  REQUIRE(!effects.empty());
  const Bytes good = effects.front().data;
  REQUIRE(decode(good));
  for (std::size_t length = 0; length < good.size(); ++length) REQUIRE(!decode(std::span(good).first(length)));
  Bytes longer = good;
  longer.push_back(std::byte{0});
  CHECK(!decode(longer));
  Random random(9);
  std::size_t read = 0;
  for (int n = 0; n < 4000; ++n) {
    Bytes bad = good;
    for (int change = 0; change < 3; ++change)
      bad[random.below(std::min<std::size_t>(bad.size(), 260))] = static_cast<std::byte>(random.below(256));
    const auto keyframe = decode(bad);
    if (!keyframe) continue;
    ++read;
    std::vector<Puff> puffs;
    add_puffs(*keyframe, 0.3, puffs);
    for (const Puff& puff : puffs) {
      REQUIRE(std::isfinite(puff.position_m.x + puff.position_m.y + puff.position_m.z));
      REQUIRE(std::isfinite(puff.radius_m));
      REQUIRE(puff.extinction_area_m2 >= 0.0f);
    }
  }
  CHECK(read > 0);
  CHECK(read < 4000);
  std::uint32_t refused = 0;
  const std::vector<EffectKeyframe> mixed{{1, keyframe_kind, Bytes(3)}, {2, 77, Bytes(3)}};
  CHECK(puffs_of(mixed, 0.0, &refused).empty());
  CHECK(refused == 1);
}
