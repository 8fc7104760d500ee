#include "engine/simulation/deviation_text.hpp"

#include <string>

#include <doctest/doctest.h>

using namespace septet::simulation;

TEST_CASE("a departure comes back from its text to the last bit, and what is none is refused") {
  MotionDeviation deviation;
  deviation.share = {.time_s = 0.1 + 0.2, .speed_mps = -1.0 / 3.0, .yaw_rate_radps = 1.0};
  const std::string text = deviation_text(deviation);
  const auto read = read_deviation(text, "session");
  REQUIRE(read.has_value());
  CHECK(read->share.time_s == deviation.share.time_s);
  CHECK(read->share.x_m == 0.0);
  CHECK(read->share.speed_mps == deviation.share.speed_mps);
  CHECK(read->share.yaw_rate_radps == 1.0);
  for (const std::string& wrong : {std::string(), std::string("0 0 0 0 0"), text + " 0", "1.5" + text,
                                   std::string("0 0 0 nan 0 0"), std::string("0,0,0,0,0,0")}) {
    CAPTURE(wrong);
    const auto refused = read_deviation(wrong, "session");
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().where == "session");
  }
}
