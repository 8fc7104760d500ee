#include <algorithm>
#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"
#include "tests/relative.hpp"

namespace septet::net {
namespace {

TEST_CASE("clients whose clocks differ and drift know the server's clock within two milliseconds on a bad network") {
  // A round trip of 1 ms; unequal paths there and back; drift of up to 200 ppm between two clocks.
  const NetworkFaults quiet{.latency_s = 0.0005}, bad{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020},
      worse{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.040};
  for (const NetworkFaults& faults : {quiet, bad, worse}) {
    CAPTURE(faults.jitter_s);
    Site site(7, faults);
    site.run(3.0);
    double worst_s = 0.0;
    for (int look = 0; look < 100; ++look) {
      site.run(0.1);
      for (std::size_t n = 0; n < site.clients.size(); ++n) {
        REQUIRE(site.clients[n]->clock().valid());
        const double error_s = std::abs(site.clock_error_s(n));
        CHECK(error_s <= site.clients[n]->clock().uncertainty_s() + 0.0002);
        worst_s = std::max(worst_s, error_s);
      }
    }
    MESSAGE("jitter " << 1e3 * faults.jitter_s << " ms: the clock is wrong by " << 1e3 * worst_s << " ms at most");
    CHECK(worst_s < (faults.jitter_s > 0.0 ? 0.002 : 0.0015));
  }
}

TEST_CASE("a clock that is set is noticed by the next ping and known again two seconds later") {
  const NetworkFaults quiet{.latency_s = 0.0005}, bad{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020};
  for (const NetworkFaults& faults : {quiet, bad})
    for (const bool of_server : {false, true}) {
      CAPTURE(faults.jitter_s);
      CAPTURE(of_server);
      Site site(2, faults);
      site.run(5.0);
      (of_server ? *site.server_machine : *site.client_machines[0]).set_clock_forward(0.5);
      CHECK(std::abs(site.clock_error_s(0)) > 0.49);
      site.run(0.5);  // A lost ping is followed by another a tenth of a second later.
      CHECK(std::abs(site.clock_error_s(0)) < 0.025);
      site.run(1.5);
      CHECK(std::abs(site.clock_error_s(0)) < 0.002);
      CHECK(std::abs(site.clock_error_s(1)) < 0.002);
    }
}

TEST_CASE("a client that looks only sixty times a second at what has arrived knows the server's clock no worse") {
  Site site(3, {.latency_s = 0.0005});
  site.run(1.0);
  for (int frame = 0; frame < 300; ++frame) {
    for (std::size_t n = 0; n < site.clients.size(); ++n) site.hung[n] = true;
    site.run(0.0157);
    for (std::size_t n = 0; n < site.clients.size(); ++n) site.hung[n] = false;
    site.run(0.001);
    for (std::size_t n = 0; n < site.clients.size(); ++n) CHECK(std::abs(site.clock_error_s(n)) < 0.0015);
  }
}

TEST_CASE("the estimate of a clock is the middle of what all pings leave") {
  ClockEstimate clock;
  clock.add(10.0, 110.003, 10.020);  // The path back was slow: the offset is between 99.983 and 100.003.
  clock.add(10.1, 110.118, 10.120);  // The path there: between 99.998 and 100.018.
  CHECK(clock.pings() == 2);
  CHECK(clock.offset_s() == relative(100.0005, 1e-6));
  CHECK(clock.uncertainty_s() == relative(0.0025 + 0.00001, 0.01));
  // An old ping counts for less and less: two clocks drift apart.
  for (int k = 1; k <= 10; ++k) clock.add(10.0 + k, 110.0105 + k, 10.020 + k);
  CHECK(clock.uncertainty_s() > 0.0025 + 0.0015);
  // A ping that contradicts the others: a clock was set.
  clock.add(30.0, 180.001, 30.002);
  CHECK(clock.pings() == 1);
  CHECK(clock.offset_s() == relative(150.0, 1e-6));
  // Times that no clock shows are dropped, too.
  clock.add(std::nan(""), 181.0, 31.0);
  clock.add(31.0, 181.0, 30.9);
  CHECK(clock.pings() == 1);
}

}  // namespace
}  // namespace septet::net
