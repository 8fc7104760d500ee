#include "sim-client/screen/even_times.hpp"

#include <doctest/doctest.h>

namespace septet::screen {

TEST_CASE("five times a second stay five where frames come in bursts, and no standstill is made up for") {
  constexpr double every_s = 0.2;
  EvenTimes times(every_s);
  int done = 0;
  double now_s = 0.0;
  const auto frame_after = [&](double seconds) {
    now_s += seconds;
    if (!times.is_due(now_s)) return;
    times.done(now_s);
    ++done;
  };
  // Two frames a hundredth apart, then a pause of 0.33 s: 3 bursts a second, 6 frames.
  while (now_s < 20.0) {
    frame_after(0.01);
    frame_after(0.33);
  }
  CHECK(done >= 99);
  CHECK(done <= 101);
  const int before = done;
  frame_after(10.0);
  frame_after(0.01);
  frame_after(0.01);
  CHECK(done == before + 1);
}

TEST_CASE("after a reset the next frame is due") {
  EvenTimes times(0.2);
  CHECK(times.is_due(5.0));
  times.done(5.0);
  CHECK_FALSE(times.is_due(5.1));
  times.reset();
  CHECK(times.is_due(5.1));
}

}  // namespace septet::screen
