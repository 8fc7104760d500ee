#include "engine/simulation/effects/keyframe_schedule.hpp"

#include <map>

#include <doctest/doctest.h>

using namespace septet;
using namespace septet::simulation;

namespace {

EffectOffer offer(std::uint32_t id, std::size_t bytes, bool settled = false, Tick interval = 4) {
  return {id, 2, interval, settled, [=] { return Bytes(bytes, static_cast<std::byte>(id)); }};
}

}  // namespace

TEST_CASE("an effect at rest is written once and one that moves at its own rate") {
  PublishedEffects published;
  std::map<std::uint32_t, int> written;
  for (Tick tick = 2; tick <= 120; tick += 2) {
    publish(std::vector{offer(1, 100, true), offer(2, 100), offer(3, 100, false, 8)}, tick, {}, published);
    for (const EffectKeyframe& keyframe : published.keyframes)
      if (keyframe.tick == tick) ++written[keyframe.id];
  }
  CHECK(written[1] == 1);
  CHECK(written[2] == 30);
  CHECK(written[3] == 15);
}

TEST_CASE("an effect that comes to rest is written at once and then no more") {
  PublishedEffects published;
  publish(std::vector{offer(1, 10)}, 2, {}, published);
  publish(std::vector{offer(1, 10, true)}, 4, {}, published);
  CHECK(published.keyframes.front().tick == 4);
  publish(std::vector{offer(1, 10, true)}, 40, {}, published);
  CHECK(published.keyframes.front().tick == 4);
}

TEST_CASE("where bytes run short those that waited longest come first and none starves") {
  PublishedEffects published;
  std::vector<EffectOffer> offers;
  for (std::uint32_t id = 1; id <= 20; ++id) offers.push_back(offer(id, 1000));
  const KeyframeLimits limits{.fresh_bytes = 5000, .total_bytes = 100'000};
  for (Tick tick = 2; tick <= 100; tick += 2) {
    const PublishReport report = publish(offers, tick, limits, published);
    CHECK(report.fresh_bytes <= limits.fresh_bytes);
    if (tick < 8) continue;
    REQUIRE(published.keyframes.size() == 20);
    for (const EffectKeyframe& keyframe : published.keyframes) CHECK(keyframe.tick + 8 > tick);
  }
}

TEST_CASE("all keyframes together stay within what one tick may carry") {
  PublishedEffects published;
  std::vector<EffectOffer> offers;
  for (std::uint32_t id = 1; id <= 50; ++id) offers.push_back(offer(id, 1000));
  const KeyframeLimits limits{.fresh_bytes = 50'000, .total_bytes = 30'000};
  const PublishReport report = publish(offers, 2, limits, published);
  CHECK(report.total_bytes == 30'000);
  CHECK(published.keyframes.size() == 30);
  CHECK(report.waiting == 20);
}

TEST_CASE("an effect that is offered no more is gone at once") {
  PublishedEffects published;
  publish(std::vector{offer(1, 10), offer(2, 10), offer(3, 10)}, 2, {}, published);
  publish(std::vector{offer(1, 10), offer(3, 10)}, 4, {}, published);
  REQUIRE(published.keyframes.size() == 2);
  CHECK(published.keyframes[1].id == 3);
  CHECK(published.keyframes[1].tick == 2);
}

TEST_CASE("an effect that rested and moves again is written again at its rate") {
  PublishedEffects published;
  publish(std::vector{offer(1, 10, true)}, 2, {}, published);
  publish(std::vector{offer(1, 10)}, 40, {}, published);
  CHECK(published.keyframes.front().tick == 40);
  publish(std::vector{offer(1, 10)}, 42, {}, published);
  CHECK(published.keyframes.front().tick == 40);
  publish(std::vector{offer(1, 10)}, 44, {}, published);
  CHECK(published.keyframes.front().tick == 44);
}
