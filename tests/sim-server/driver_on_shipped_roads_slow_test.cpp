// The simulated driver in the shipped scenarios, as the product drives them.

#include "logging/study/measures/lateral_position.hpp"
#include "tests/sim-server/driver_hours.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

TEST_CASE("the driver passes the car that has broken down on the hard shoulder") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    DriveWatch watch = watch_drive("winter-lorry", "plain", seed, 45.0);
    for (const std::string& incident : watch.record.incidents) MESSAGE(incident);
    CHECK(watch.record.time_s == doctest::Approx(45.0));
    CHECK(watch.record.stops == 0);
    CHECK(watch.record.hard_brakings == 0);
    CHECK_FALSE(watch.has_collided());
  }
}

TEST_CASE("the first half minute lies no farther to one side of the lane than the others") {
  double first_m = 0.0, later_m = 0.0, largest_later_m = 0.0;
  constexpr int drives = 6;
  for (std::uint64_t seed = 1; seed <= drives; ++seed) {
    const DriveWatch watch = watch_drive("behind-ambulance", "plain", seed, 60.0);
    const std::span<const logging::Sample> samples(watch.samples);
    const double first = logging::compute_lateral_position_statistics(samples.first(300), {}).mean_m;
    const double later = logging::compute_lateral_position_statistics(samples.last(300), {}).mean_m;
    MESSAGE("seed " << seed << ": mean lateral position in the first 30 s " << first << " m, in the next " << later
                    << " m");
    first_m += first / drives;
    later_m += later / drives;
    largest_later_m = std::max(largest_later_m, std::abs(later));
  }
  MESSAGE("mean " << first_m << " m, then " << later_m << " m, at most " << largest_later_m << " m");
  CHECK(std::abs(first_m) < 0.12);
}

}  // namespace septet::server
