#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/lane_changes.hpp"
#include "logging/study/measures/lateral_position.hpp"
#include "tests/logging/sample_series.hpp"

namespace septet::logging {

TEST_CASE("mean and standard deviation of lateral position equal those computed by hand") {
  // 0.1, 0.3, −0.1, 0.1: mean 0.1; squares of the differences 0, 0.04, 0.04, 0 sum to 0.08.
  const std::vector samples{sample_at(0, -1, 0.1), sample_at(1, -1, 0.3), sample_at(2, -1, -0.1),
                            sample_at(3, -1, 0.1)};
  const auto result = compute_lateral_position_statistics(samples, {});
  CHECK(result.mean_m == doctest::Approx(0.1));
  CHECK(result.sd_m == doctest::Approx(std::sqrt(0.08 / 4)));
  CHECK(result.sd_sample_m == doctest::Approx(std::sqrt(0.08 / 3)));
  CHECK(result.samples == 4);
}

TEST_CASE("samples around a lane change are left out of lane keeping and counted") {
  std::vector<Sample> samples;
  for (int i = 0; i < 100; ++i) samples.push_back(sample_at(i, -1, i < 50 ? 0.2 : 0.4));
  const std::vector changes{
      LaneChange{.tick = 0, .simulated_time_s = 5.0, .lanes_to_left = 1, .from_lane = -2, .to_lane = -1}};
  const auto result = compute_lateral_position_statistics(samples, changes, {.exclude_around_lane_change_s = 3.0});
  // Left out: 2.0 s < t < 8.0 s, samples 21 to 79.
  CHECK(result.excluded_lane_change == 59);
  CHECK(result.samples == 41);
  CHECK(result.mean_m == doctest::Approx((21 * 0.2 + 20 * 0.4) / 41));
  CHECK(compute_lateral_position_statistics(samples, changes, {.exclude_around_lane_change_s = 0.0}).samples == 100);
}

TEST_CASE("samples off every lane do not count as lane keeping") {
  const std::vector samples{sample_at(0, 0, 9.0, 0.0), sample_at(1, -1, 0.5), sample_at(2, -1, std::nan(""))};
  const auto result = compute_lateral_position_statistics(samples, {});
  CHECK(result.samples == 1);
  CHECK(result.excluded_off_lane == 2);
  CHECK(result.sd_sample_m == 0.0);
}

TEST_CASE("the histogram puts each of 21 bin centres into its bin") {
  std::vector<Sample> samples;
  for (int i = 0; i < 21; ++i) samples.push_back(sample_at(i, -1, 4.2 * (-0.5 + (i + 0.5) / 21), 4.2));
  const auto histogram = compute_lateral_position_histogram(samples);
  for (std::size_t bin = 0; bin < 21; ++bin) CHECK(histogram.counts[bin] == 1);
  CHECK(histogram.total() == 21);
}

TEST_CASE("the centre bin is symmetric about the lane centre and bins are closed below and open above") {
  using Histogram = LateralPositionHistogram;
  CHECK(Histogram::edge(10) == doctest::Approx(-1.0 / 42));
  CHECK(Histogram::edge(11) == doctest::Approx(1.0 / 42));
  // A lane of width 1 makes the position the relative one, so that the edges are hit exactly.
  std::vector<Sample> samples{sample_at(0, -1, 0.0, 1.0)};
  for (std::size_t i = 0; i <= 21; ++i) samples.push_back(sample_at(0, -1, Histogram::edge(i), 1.0));
  samples.push_back(sample_at(0, -1, std::nextafter(Histogram::edge(1), -1.0), 1.0));
  const auto histogram = compute_lateral_position_histogram(samples);
  CHECK(histogram.counts[0] == 2);
  CHECK(histogram.counts[10] == 2);
  CHECK(histogram.counts[20] == 1);
  CHECK(histogram.underflow == 0);
  CHECK(histogram.overflow == 1);  // The left-hand line itself.
}

TEST_CASE("positions beyond the lines and samples without a lane are counted apart") {
  const std::vector samples{sample_at(0, -1, -1.76), sample_at(1, -1, 1.75), sample_at(2, -1, 0.0),
                            sample_at(3, 0, 0.0, 0.0)};
  const auto histogram = compute_lateral_position_histogram(samples);
  CHECK(histogram.underflow == 1);
  CHECK(histogram.overflow == 1);
  CHECK(histogram.off_lane == 1);
  CHECK(histogram.total() == 3);
  CHECK(histogram.fraction(10) == doctest::Approx(1.0 / 3));
}

TEST_CASE("a lane change is dated at the crossing of the line and tells its direction") {
  // From the middle of lane −2 to the left into lane −1; the line lies 1.75 m right of lane −1's
  // centre.
  const auto samples = drive_through({-3.5, -3.0, -2.2, -1.8, -1.7, -1.5, -1.0, 0.0});
  const auto changes = find_lane_changes(samples);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].simulated_time_s == doctest::Approx(0.4));
  CHECK(changes[0].lanes_to_left == 1);
  CHECK(changes[0].from_lane == -2);
  CHECK(changes[0].to_lane == -1);
}

TEST_CASE("driving on the line is no lane change") {
  const auto samples = drive_through({-1.6, -1.7, -1.8, -1.9, -1.7, -1.6, -1.8, -1.9, -2.0, -1.7, -1.5, -1.0});
  CHECK(find_lane_changes(samples).empty());
}

TEST_CASE("every line crossed is one change and a return is a change to the right") {
  const auto changes = find_lane_changes(drive_through({-7.0, -5.5, -4.5, -3.0, -1.9, -1.0, 0.0, -1.0, -1.8, -2.5}));
  REQUIRE(changes.size() == 3);
  CHECK(changes[0].lanes_to_left == 1);
  CHECK(changes[1].lanes_to_left == 1);
  CHECK(changes[1].from_lane == -2);
  CHECK(changes[2].lanes_to_left == -1);
  CHECK(changes[2].simulated_time_s == doctest::Approx(0.8));
}

TEST_CASE("lines crossed within the hysteresis are one change over two lanes") {
  const auto changes = find_lane_changes(drive_through({-7.0, -5.5, -4.5, -3.0, -1.9, -1.0}), {.hysteresis_m = 3.4});
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].lanes_to_left == 2);
  CHECK(changes[0].from_lane == -3);
  CHECK(changes[0].to_lane == -1);
}

TEST_CASE("a renumbered lane is no lane change and a road left and entered again neither") {
  const std::vector renumbered{sample_at(0, -2, 0.3), sample_at(1, -2, 0.31), sample_at(2, -3, 0.32),
                               sample_at(3, -3, 0.3)};
  CHECK(find_lane_changes(renumbered).empty());
  const std::vector off_road{sample_at(0, -2, 1.0), sample_at(1, 0, 0.0, 0.0), sample_at(2, -1, -1.0),
                             sample_at(3, -1, 0.0)};
  CHECK(find_lane_changes(off_road).empty());
}

TEST_CASE(
    "a car that an operator put into another lane has changed no lane, and one that changes lanes afterwards has") {
  std::vector<Sample> samples;
  for (int i = 0; i < 20; ++i) samples.push_back(sample_at(i, -2, 1.2));
  for (int i = 20; i < 40; ++i) samples.push_back(sample_at(i, -1, -1.2));
  for (int i = 40; i < 60; ++i) samples.push_back(sample_at(i, -2, 1.2));
  const std::vector<Event> events{{samples[19].tick, 1.9, "operator_command", {}, "conditions rain_mm_per_h=1"},
                                  {samples[19].tick + 1, 1.9, "operator_command", {}, "put x_m=1 y_m=2"}};
  const auto put_before = put_before_ticks(events);
  REQUIRE(put_before == std::vector<Tick>{samples[19].tick + 1});
  CHECK(find_lane_changes(samples).size() == 2);
  const auto changes = find_lane_changes(samples, {}, put_before);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].tick == samples[40].tick);
  CHECK(changes[0].lanes_to_left == -1);
}

TEST_CASE(
    "glances begin and end at the borders of their area, and a head that passes through one does not look there") {
  std::vector<Sample> samples;
  const double degree = std::numbers::pi / 180;
  const double gaze[] = {0, 0, 40, 45, 40, 0, -30, -60, -60, 0, 30};
  for (int i = 0; i < 11; ++i) {
    samples.push_back(sample_at(i, -1, 0.0));
    samples.back().gaze_heading_rad = gaze[i] * degree;
  }
  const auto glances = find_glances(samples);
  REQUIRE(glances.size() == 2);
  CHECK(glances[0].area == "left mirror");
  CHECK(glances[0].start_s == doctest::Approx(0.2));
  CHECK(glances[0].duration_s == doctest::Approx(0.3));
  CHECK(glances[1].area == "right mirror");
  CHECK(glances[1].duration_s == doctest::Approx(0.2));
}

TEST_CASE("ten samples a second are due at any tick rate") {
  for (const double rate : {60.0, 120.0, 125.0, 1000.0 / 3.0}) {
    int due = 0;
    for (Tick tick = 0; tick < static_cast<Tick>(rate * 100.0 + 0.5); ++tick) due += is_sample_due(tick, rate);
    CHECK(due == 1000);
  }
  CHECK(is_sample_due(0, 120));
  CHECK(is_sample_due(12, 120));
  CHECK_FALSE(is_sample_due(11, 120));
}

TEST_CASE("the areas of the mirrors reach as far as their degrees say and the windscreen lies between them") {
  const double degree = std::numbers::pi / 180;
  const auto area_at = [&](double gaze_deg) -> std::string {
    std::vector<Sample> samples;
    for (int i = 0; i < 10; ++i) {
      samples.push_back(sample_at(i, -1, 0.0));
      samples.back().gaze_heading_rad = i < 2 || i > 7 ? 0.0 : gaze_deg * degree;
    }
    const auto glances = find_glances(samples);
    return glances.empty() ? "" : glances[0].area;
  };
  for (const double ahead_deg : {24.0, 10.0, -19.0}) CHECK(area_at(ahead_deg) == "");
  for (const double left_deg : {26.0, 74.0}) CHECK(area_at(left_deg) == "left mirror");
  for (const double inside_deg : {-21.0, -44.0}) CHECK(area_at(inside_deg) == "inside mirror");
  for (const double right_deg : {-46.0, -79.0}) CHECK(area_at(right_deg) == "right mirror");
  for (const double beyond_deg : {76.0, -81.0}) CHECK(area_at(beyond_deg) == "");
}

}  // namespace septet::logging
