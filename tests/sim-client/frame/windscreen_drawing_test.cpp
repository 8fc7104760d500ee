#include "sim-client/frame/windscreen_drawing.hpp"

#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::frame {

TEST_CASE("wipers rest in the dry, run at least 45 times a minute in steady rain, and now and then in a drizzle") {
  const auto strokes_a_minute = [](double rain_mm_per_h) {
    int strokes = 0;
    bool was_up = false;
    for (int i = 0; i < 6000; ++i) {
      const bool is_up = wiper_share(rain_mm_per_h, i * 0.01) > 0.5;
      strokes += is_up && !was_up;
      was_up = is_up;
    }
    return strokes;
  };
  CHECK(strokes_a_minute(0.0) == 0);
  CHECK(strokes_a_minute(1.0) == 15);
  CHECK(strokes_a_minute(4.0) == 45);
  CHECK(strokes_a_minute(20.0) == 60);
  CHECK(wiper_share(std::nan(""), 1.0) == 0.0);
}

TEST_CASE("a place was last wiped when a blade stood there") {
  for (const double rain : {1.0, 4.0, 20.0})
    for (const double share : {0.01, 0.3, 0.5, 0.97})
      for (double time_s = 8.0; time_s < 16.0; time_s += 0.07) {
        const auto passed_s = last_passed_s(rain, share, time_s);
        REQUIRE(passed_s);
        CHECK(*passed_s <= time_s);
        CHECK(wiper_share(rain, *passed_s) == relative(share, 1e-6));
        // And no blade did since.
        for (double later_s = *passed_s + 0.002; later_s < time_s; later_s += 0.01)
          CHECK((wiper_share(rain, later_s) > share) == (wiper_share(rain, *passed_s + 0.002) > share));
      }
  CHECK_FALSE(last_passed_s(0.0, 0.5, 10.0));
}

TEST_CASE("wipers at rest lie below the cowl's line, and sweep the glass that they clear") {
  for (const Wiper& wiper : wipers)
    for (double reach_m = wiper.from_m; reach_m <= wiper.to_m; reach_m += 0.01) {
      CHECK(place_on_wiper(wiper, reach_m, 0.0).y < -0.04);
      for (const double share : {0.1, 0.3, 0.5, 0.8, 0.99}) {
        const glm::dvec2 place_m = place_on_wiper(wiper, reach_m, share);
        CHECK(place_m.y > 0.0);
        const auto swept = swept_share(place_m);
        if (reach_m > wiper.from_m + 0.001 && reach_m < wiper.to_m - 0.001 && &wiper == &wipers.front())
          CHECK(swept.value_or(-1.0) == relative(share, 1e-6));
      }
    }
}

TEST_CASE("a heavier rain leaves more drops behind the wipers, snow none") {
  Environment environment;
  const auto wiped = [&](double rain_mm_per_h) {
    environment.rain_mm_per_h = rain_mm_per_h;
    std::size_t sum = 0;
    for (int i = 0; i < 40; ++i)
      for (const GlassDrop& drop : drops_on_glass(environment, 20.0 + 0.1 * i))
        sum += swept_share(drop.place_m).has_value();
    return sum;
  };
  CHECK(wiped(0.0) == 0);
  CHECK(wiped(2.0) < wiped(6.0));
  environment.temperature_k = 270.0;
  CHECK(drops_on_glass(environment, 20.0).empty());
}

}  // namespace septet::frame
