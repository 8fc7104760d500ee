#include "sim-client/screen/frame_times.hpp"

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::screen {

TEST_CASE("percentiles of frame times are right within one per cent") {
  FrameTimes times;
  CHECK(times.percentile_ms(0.5) == 0.0);
  for (int i = 1; i <= 1000; ++i) times.add(0.1 * i);
  CHECK(times.count() == 1000);
  for (const double fraction : {0.01, 0.25, 0.5, 0.9, 0.99, 1.0})
    CHECK(times.percentile_ms(fraction) == relative(100.0 * fraction, 0.011));
}

TEST_CASE("a frame of no time and one of a minute fall into the outermost bins") {
  FrameTimes times;
  times.add(0.0);
  times.add(-1.0);
  CHECK(times.percentile_ms(1.0) == relative(0.01, 0.011));
  times.add(60'000.0);
  times.add(1e12);
  CHECK(times.percentile_ms(0.5) == relative(0.01, 0.011));
  CHECK(times.percentile_ms(0.75) == relative(60'000.0, 0.011));
  CHECK(times.count() == 4);
}

}  // namespace septet::screen
