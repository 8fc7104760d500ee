#include "sim-server/host/latency_record.hpp"

#include <limits>

#include <doctest/doctest.h>

namespace septet::server {

TEST_CASE("the quantiles of latencies lie within half a millisecond above the true ones, and nonsense does not count") {
  LatencyRecord record;
  CHECK_FALSE(record.quantile_ms(0.5).has_value());
  for (int ms = 1; ms <= 100; ++ms) record.add(1e-3 * ms - 1e-4);
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) record.add(bad);
  CHECK(record.count() == 100);
  CHECK(record.quantile_ms(0.5) == doctest::Approx(50.0));
  CHECK(record.quantile_ms(0.99) == doctest::Approx(99.0));
  record.add(std::numeric_limits<double>::infinity());
  record.add(1e6);
  CHECK(record.quantile_ms(1.0) == doctest::Approx(2000.0));
}

}  // namespace septet::server
