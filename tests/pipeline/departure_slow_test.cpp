#include "sim-client/screen/departure.hpp"

#include <doctest/doctest.h>

#include "tests/pipeline/simulated_rig.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

/// The screen pumps and sends its departure until `end_s`, or until it gives up; returns true if it has given up.
bool leave(SimulatedRig& rig, screen::Departure& departure, double end_s) {
  while (rig.now_s() < end_s && !(rig.has_server() && rig.host().end_requested())) {
    rig.advance_1ms();
    if (departure.is_in_vain(*rig.screen(0).link, rig.screen(0).machine->clock_s(rig.now_s()))) return true;
  }
  return false;
}

screen::Departure escape(SimulatedRig& rig) {
  return {control::Quit::How::escape, rig.screen(0).machine->clock_s(rig.now_s())};
}

}  // namespace

TEST_CASE("a screen that was dropped and gets no processor still tells the server that its driver has left") {
  SimulatedRig rig({.screens = 1});
  rig.run_for(1.0);
  rig.screen(0).hung = true;
  rig.run_for(8.0);
  screen::Departure departure = escape(rig);
  CHECK_FALSE(departure.is_in_vain(*rig.screen(0).link, rig.screen(0).machine->clock_s(rig.now_s())));
  rig.run_for(11.0);
  rig.screen(0).hung = false;
  CHECK_FALSE(leave(rig, departure, rig.now_s() + 60.0));
  CHECK(rig.host().end_requested() == logging::DriveEnd::escape);
}

TEST_CASE("a screen whose server is gone leaves after two seconds") {
  SimulatedRig rig({.screens = 1});
  rig.run_for(1.0);
  rig.stop_server();
  screen::Departure departure = escape(rig);
  const double from_s = rig.now_s();
  CHECK(leave(rig, departure, from_s + 60.0));
  CHECK(rig.now_s() - from_s == relative(2.0, 0.05));
}

}  // namespace septet
