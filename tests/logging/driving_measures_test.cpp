#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "logging/study/measures/accelerations.hpp"
#include "logging/study/measures/brake_reaction.hpp"
#include "logging/study/measures/collisions.hpp"
#include "logging/study/measures/following.hpp"
#include "logging/study/measures/order_statistics.hpp"
#include "logging/study/measures/speeding.hpp"
#include "logging/study/measures/steering_entropy.hpp"
#include "logging/study/measures/steering_reversals.hpp"
#include "logging/study/measures/time_to_collision.hpp"
#include "logging/study/measures/time_to_line_crossing.hpp"
#include "logging/study/report/drive_measures.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::logging {
namespace {

auto exactly(double value) { return relative(value, 1e-6); }

/// Ten samples a second that close in on a leader with this TTC.
std::vector<Sample> closing_in(const std::vector<double>& ttc_s) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < ttc_s.size(); ++i) {
    Sample sample = sample_at(static_cast<int>(i), -1, 0.0);
    sample.speed_mps = 20.0;
    sample.leader = Leader{7, ttc_s[i] * 5.0, ttc_s[i] * 5.0 + 4.0, 15.0};
    samples.push_back(sample);
  }
  return samples;
}

/// Rate of a recording without a gap, whatever its units and its rate.
double reversals_per_minute(std::span<const double> steering_rad, double rate_hz, const ReversalSettings& settings) {
  const auto smooth = filtered_both_ways(butterworth_low_pass(settings.cut_off_hz, rate_hz), steering_rad);
  const double length_s = static_cast<double>(steering_rad.size() - 1) / rate_hz;
  return static_cast<double>(count_reversals(smooth, settings.gap_rad)) * 60.0 / length_s;
}

}  // namespace

TEST_CASE("a quantile lies between two numbers in proportion and leaves out what is no number") {
  const std::vector numbers{4.0, 1.0, std::nan(""), 3.0, 2.0};
  CHECK(median(numbers).value() == exactly(2.5));
  CHECK(quantile(numbers, 0.9).value() == exactly(3.7));
  CHECK(quantile(numbers, 1.0).value() == 4.0);
  CHECK_FALSE(median({}).has_value());
}

TEST_CASE("the approximations of TLC have their closed forms") {
  CHECK(simple_tlc_s({0.5, 0.25, 0.0}).value() == exactly(2.0));
  // 0.5 = 0.25 t + 0.05 t².
  CHECK(quadratic_tlc_s({0.5, 0.25, 0.1}).value() == exactly((-0.25 + std::sqrt(0.0625 + 0.1)) / 0.1));
  CHECK(quadratic_tlc_s({0.5, 0.25, 0.0}).value() == exactly(2.0));
  CHECK(van_winsum_tlc_s({0.5, 0.25, 0.1}).value() == exactly(0.5 / 0.35));
  // Away from the line, or turning back before it.
  CHECK_FALSE(simple_tlc_s({0.5, -0.25, 0.0}).has_value());
  CHECK_FALSE(quadratic_tlc_s({0.5, 0.25, -0.1}).has_value());
  CHECK_FALSE(van_winsum_tlc_s({0.5, 0.25, -0.3}).has_value());
}

TEST_CASE("the trigonometric TLC is the arc to the line for straight and bent paths and lines") {
  const double v = 25.0, d = 1.2;
  // Straight to straight: d / (v sin ψ), to either side.
  CHECK(trigonometric_tlc_s({v, 0.0, 0.02, d, 0.0}).value() == exactly(d / (v * std::sin(0.02))));
  CHECK(trigonometric_tlc_s({v, 0.0, -0.02, -d, 0.0}).value() == exactly(d / (v * std::sin(0.02))));
  CHECK_FALSE(trigonometric_tlc_s({v, 0.0, -0.02, d, 0.0}).has_value());
  CHECK_FALSE(trigonometric_tlc_s({v, 0.0, 0.0, d, 0.0}).has_value());
  // A circle along the lane to a straight line: the angle with R(1 − cos φ) = d.
  const double radius = 500.0, yaw = v / radius;
  CHECK(trigonometric_tlc_s({v, yaw, 0.0, d, 0.0}).value() == exactly(radius * std::acos(1.0 - d / radius) / v));
  CHECK(trigonometric_tlc_s({v, -yaw, 0.0, -d, 0.0}).value() == exactly(radius * std::acos(1.0 - d / radius) / v));
  // Straight on in a bend to the left with the line at the right: the chord to the outer circle.
  const double line = 800.0;
  CHECK(trigonometric_tlc_s({v, 0.0, 0.0, -d, 1.0 / line}).value() ==
        exactly(std::sqrt(line * line - (line - d) * (line - d)) / v));
  // Two circles, by the law of cosines: a path of 800 m radius leaves a lane of 500 m to the right.
  const double apart = line - (radius - d);  // Of the centres, both to the left.
  const double turned = std::acos((apart * apart + line * line - radius * radius) / (2.0 * apart * line));
  CHECK(trigonometric_tlc_s({v, v / line, 0.0, -d, 1.0 / radius}).value() == exactly(line * turned / v));
  CHECK_FALSE(
      trigonometric_tlc_s({v, yaw, 0.0, -d, 1.0 / line}).has_value());  // The other way round it never gets there.
  // As the bend of the path goes to nothing, the value goes to that of the straight one.
  CHECK(trigonometric_tlc_s({v, 1e-9, 0.02, d, 1e-12}).value() == exactly(d / (v * std::sin(0.02))));
}

TEST_CASE("TLC along a straight lane is the distance from the car's side to the line over the drift") {
  std::vector<Sample> samples;
  for (int i = 0; i < 21; ++i) {
    samples.push_back(sample_at(i, -1, 0.02 * i));
    samples.back().speed_mps = 20.0;
  }
  const auto tlc = compute_tlc(samples, {});
  // At sample 19, the last with a derivative: 0.38 m left of the centre, 0.2 m/s.
  const double distance_m = 1.75 - 0.915 - 0.38;
  CHECK(tlc.simple.smallest_s.value() == exactly(distance_m / 0.2));
  CHECK(tlc.van_winsum.smallest_s.value() == exactly(distance_m / 0.2));
  // The path of length vt at the angle of asin(0.01): the same here.
  CHECK(tlc.trigonometric.smallest_s.value() == exactly(distance_m / 0.2));
  CHECK(tlc.missing == 2);
  CHECK(tlc.simple.samples == 19);
  CHECK(tlc.simple.not_approaching == 0);
  // A sample that is missing costs itself and both neighbours their derivative, and is not filled in.
  samples.erase(samples.begin() + 10);
  CHECK(compute_tlc(samples, {}).missing == 4);
  CHECK(compute_tlc(samples, {}).simple.samples == 16);
}

TEST_CASE(
    "TLC of a session is from the side of the vehicle that was driven, and where it holds none from the Volvo's") {
  const TemporaryFolder folder;
  const auto smallest_s = [&](const std::string& vehicle) {
    SessionInfo info = example_info();
    if (!vehicle.empty()) info.files.push_back({"vehicle", vehicle, shipped_text("vehicles/" + vehicle)});
    const auto path = folder / ("of-" + vehicle + ".sqlite");
    auto writer = SessionWriter::create(path, info);
    REQUIRE(writer.has_value());
    for (int i = 0; i < 21; ++i) {
      Sample sample = sample_at(i, -1, 0.02 * i);
      sample.speed_mps = 20.0;
      writer->record(sample);
    }
    REQUIRE(writer->finish().has_value());
    const auto records = read_drive_records(must_open(path));
    REQUIRE(records.has_value());
    return compute_drive_measures(*records).tlc.simple.smallest_s.value();
  };
  // At the last sample with a derivative: 0.38 m left of the centre, 0.2 m/s.
  CHECK(smallest_s("commonroad-vanagon.toml") == exactly((1.75 - 1.844 / 2.0 - 0.38) / 0.2));
  CHECK(smallest_s("commonroad-bmw-320i.toml") == exactly((1.75 - 1.61 / 2.0 - 0.38) / 0.2));
  CHECK(smallest_s("") == exactly((1.75 - 0.915 - 0.38) / 0.2));
}

TEST_CASE("a drift that turns back before the line is one minimum of TLC") {
  std::vector<Sample> samples;
  for (int i = 0; i < 200; ++i) {
    samples.push_back(sample_at(i, -1, 0.3 * std::sin(i * 0.1 * std::numbers::pi / 5.0)));  // Two swings of 10 s.
    samples.back().speed_mps = 20.0;
  }
  const auto tlc = compute_tlc(samples, {});
  CHECK(tlc.simple.minima == 4);  // To the left and to the right, twice.
  CHECK(tlc.simple.samples == 198);
}

TEST_CASE("headway is from front to front and gap from front to rear and neither counts beyond the cut-off") {
  std::vector<Sample> samples;
  for (int i = 0; i < 5; ++i) samples.push_back(sample_at(i, -1, 0.0));
  for (auto& sample : samples) sample.speed_mps = 20.0;
  samples[0].leader = Leader{1, 20.0, 24.0, 20.0};
  samples[1].leader = Leader{1, 16.0, 20.0, 20.0};
  samples[2].leader = Leader{1, 130.0, 134.0, 20.0};  // 6.7 s.
  samples[3].leader = Leader{1, 10.0, 14.0, 20.0};
  samples[3].speed_mps = 0.5;
  const auto following = compute_following(samples);
  CHECK(following.samples == 2);
  CHECK(following.no_leader == 1);
  CHECK(following.farther == 1);
  CHECK(following.too_slow == 1);
  CHECK(following.headway.median_s.value() == exactly(1.1));
  CHECK(following.gap.median_s.value() == exactly(0.9));
  CHECK(following.gap.smallest_s.value() == exactly(0.8));
  CHECK(following.gap.close_share == exactly(0.5));
}

TEST_CASE("TTC from 3 s to 1 s and back exposes for 4 s and integrates to 4 s²") {
  std::vector<double> ttc_s;
  for (int i = 0; i <= 40; ++i) ttc_s.push_back(1.0 + std::abs(i - 20) * 0.1);
  const auto ttc = compute_time_to_collision(closing_in(ttc_s));
  CHECK(ttc.smallest_s.value() == exactly(1.0));
  CHECK(ttc.exposed_s == exactly(4.0));
  CHECK(ttc.integrated_s2 == exactly(4.0));
}

TEST_CASE("TTC equals that of commonroad-crime") {
  // commonroad-crime 0.4.5 (PyPI), measures HW and TTC, which it rounds to hundredths: a car of 4.8 m at 25 m/s on a
  // straight lane, one of the same length at 18 m/s with its middle 40 m ahead, at 0, 1 and 2 s.
  const double gaps_m[] = {35.2, 28.2, 21.2}, ttc_s[] = {5.03, 4.03, 3.03};
  for (int i = 0; i < 3; ++i) {
    Sample sample = sample_at(10 * i, -1, 0.0);
    sample.speed_mps = 25.0;
    sample.leader = Leader{2, 40.0 - 4.8 - 7.0 * i, 40.0 - 7.0 * i, 18.0};
    CHECK(sample.leader->distance_gap_m == exactly(gaps_m[i]));
    CHECK(std::abs(time_to_collision_s(sample).value() - ttc_s[i]) <= 0.005);
  }
}

TEST_CASE("where a leader is not approached TTC is undefined and counted and the time beside it is not exposed") {
  auto samples = closing_in({2.0, 2.0, 2.0, 2.0});
  samples[1].leader->speed_mps = 25.0;
  samples[3].leader.reset();
  const auto ttc = compute_time_to_collision(samples);
  CHECK(ttc.samples == 2);
  CHECK(ttc.not_closing == 1);
  CHECK(ttc.no_leader == 1);
  CHECK(ttc.exposed_s == 0.0);
  // From 4 s to 2 s in a tenth of a second: below 3 s for half of it.
  const auto crossing = compute_time_to_collision(closing_in({4.0, 2.0}));
  CHECK(crossing.exposed_s == exactly(0.05));
  CHECK(crossing.integrated_s2 == exactly(0.025));
}

TEST_CASE("the steering filter has the published coefficients at 30 Hz") {
  // Markkula and Engström's own table (github.com/gmarkkula/SteeringWheelReversalRate, GetButterworthFilter.m).
  const auto slow = butterworth_low_pass(0.6, 30.0);
  CHECK(slow.b0 == exactly(0.00362168151493));
  CHECK(slow.b1 == exactly(0.00724336302986));
  CHECK(slow.a1 == exactly(-1.82269493));
  CHECK(slow.a2 == exactly(0.83718165125602));
  const auto fast = butterworth_low_pass(2.0, 30.0);
  CHECK(fast.b0 == exactly(0.03357180936764));
  CHECK(fast.a1 == exactly(-1.41898265221812));
  CHECK(fast.a2 == exactly(0.55326988968868));
}

TEST_CASE("reversal rates of a recording equal those of SciPy's filter and the published rule") {
  // scipy 1.17.1: butter(2, …), filtfilt(…, padlen = 6); swings by the published rule. 25 s at 30 Hz, in degrees.
  std::vector<double> degrees;
  for (int i = 0; i < 751; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 30.0;
    degrees.push_back(4.0 * std::sin(0.13 * turn) + 2.5 * std::sin(0.37 * turn + 1.0) +
                      0.4 * std::sin(1.3 * turn + 2.0) + 0.15 * std::sin(4.1 * turn));
  }
  const auto smooth = filtered_both_ways(butterworth_low_pass(0.6, 30.0), degrees);
  CHECK(smooth[0] == exactly(2.644820531640655));
  CHECK(smooth[100] == exactly(2.9756096299860713));
  CHECK(smooth[374] == exactly(-4.911530917553736));
  CHECK(smooth[750] == exactly(5.921342627441568));
  CHECK(reversals_per_minute(degrees, 30.0, {0.6, 3.0}) == exactly(24.0));
  CHECK(reversals_per_minute(degrees, 30.0, {2.0, 0.1}) == exactly(57.6));
}

TEST_CASE("25 s at 30 Hz with 5, 8, 27 and 55 reversals are the published 12.0, 19.2, 64.8 and 132.0 a minute") {
  // The rates of Markkula and Engström's example recordings (baseline 12.0 and 64.8, visual task 19.2, cognitive task
  // 132.0), which are not ours to ship. Here: slow swings that count for visual load, with ripples on top that count
  // for cognitive load alone.
  const auto recording = [](double slow_swings, double ripple_swings) {
    std::vector<double> radians;
    for (int i = 0; i < 751; ++i) {
      // By the published rule the first value is a stationary point, the last is not.
      const double half_wave = std::numbers::pi * i / 750.0;
      const double slow_deg = 4.0 * std::sin(slow_swings * half_wave);
      const double ripple_deg = 0.35 * std::sin(ripple_swings * half_wave);
      radians.push_back((slow_deg + ripple_deg) * std::numbers::pi / 180.0);
    }
    return radians;
  };
  const auto visual = [&](const auto& radians) { return reversals_per_minute(radians, 30.0, visual_load_reversals); };
  const auto cognitive = [&](const auto& radians) {
    return reversals_per_minute(radians, 30.0, cognitive_load_reversals);
  };
  CHECK(visual(recording(5.0, 0.0)) == exactly(12.0));
  CHECK(visual(recording(8.0, 0.0)) == exactly(19.2));
  CHECK(cognitive(recording(0.0, 27.0)) == exactly(64.8));
  CHECK(cognitive(recording(0.0, 55.0)) == exactly(132.0));
  // Swings of less than 3 degrees do not count for visual load, with any noise on top.
  CHECK(visual(recording(0.0, 27.0)) == 0.0);
  CHECK(visual(recording(5.0, 55.0)) == exactly(12.0));
}

TEST_CASE("each full swing of a sine beyond the gap is two reversals") {
  std::vector<double> sine;
  for (int i = 0; i < 1000; ++i) sine.push_back(std::sin(2.0 * std::numbers::pi * i / 100.0 + 0.05));
  CHECK(count_reversals(sine, 1.9) == 19);  // Between its 20 tops and bottoms.
  CHECK(count_reversals(sine, 2.1) == 0);
}

TEST_CASE(
    "a glance every ten seconds, as the paper has it, is told as 10.0 s, and passing glances and other areas do not "
    "shorten it") {
  // Lebram, Engström and Gustavsson 2006, section 4: mirrors every 10 s. A glance counts from 0.2 s at 10 Hz.
  DriveRecords drive;
  for (int i = 0; i <= 6000; ++i) {
    Sample sample;
    sample.tick = static_cast<Tick>(12 * i);
    sample.simulated_time_s = 0.1 * i;
    sample.speed_mps = 25.0;
    sample.lane = -1;
    sample.lane_width_m = 3.5;
    const int of_ten_s = i % 100;
    if (of_ten_s >= 40 && of_ten_s < 42) sample.gaze_heading_rad = 0.6;  // The left mirror for 0.2 s.
    if (of_ten_s == 70) sample.gaze_heading_rad = -0.5;                  // Past the inside mirror.
    if (of_ten_s == 85) sample.gaze_heading_rad = 0.2;                   // The road to the left.
    drive.samples.push_back(sample);
  }
  const DriveMeasures measures = compute_drive_measures(drive);
  CHECK(measures.glances.size() == 60);
  CHECK(measures.between_glances_s.value() == exactly(10.0));
  for (const Glance& glance : measures.glances) CHECK(glance.duration_s == exactly(0.2));
  for (Sample& sample : drive.samples) sample.gaze_heading_rad = 0.0;
  CHECK_FALSE(compute_drive_measures(drive).between_glances_s.has_value());
}

TEST_CASE("steering entropy is 0.542 of normal errors in their own baseline and 1 of even ones and 0 of none") {
  // The middles of 20,000 equal parts of a normal distribution: by its quantiles, no random numbers.
  std::vector<double> errors;
  const auto normal_share = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  double x = -6.0;
  for (int i = 0; i < 20000; ++i) {
    const double share = (i + 0.5) / 20000.0;
    while (normal_share(x) < share) x += 1e-4;
    errors.push_back(x);
  }
  const double alpha = steering_entropy_alpha(errors).value();
  CHECK(alpha == relative(1.6449, 1e-3));
  CHECK(steering_entropy_of(errors, alpha).value() == relative(0.542, 1e-3));
  CHECK(steering_entropy_of(std::vector{-9.0, -3.0, -2.0, -0.7, 0.0, 0.7, 2.0, 3.0, 9.0}, 1.0).value() == exactly(1.0));
  CHECK(steering_entropy_of(std::vector{0.1, 0.2}, 1.0).value() == 0.0);
  CHECK_FALSE(steering_entropy_of(std::vector{0.1}, 0.0).has_value());
}

TEST_CASE("the prediction of steering is exact for a steady turn and half a second difference off for a parabola") {
  CHECK(std::ranges::max(steering_prediction_errors(std::vector{1.0, 1.5, 2.0, 2.5, 3.0})) == exactly(0.0).scale(1.0));
  // θ = n²: differences 1, 3, 5, 7; predicted 9 + 5 + 1 = 15 for 16.
  CHECK(steering_prediction_errors(std::vector{0.0, 1.0, 4.0, 9.0, 16.0}).back() == exactly(1.0));
}

TEST_CASE("steering entropy of inputs takes 150 ms each and nothing across a gap") {
  std::vector<InputRecord> inputs;
  for (Tick tick = 1; tick <= 18 * 20; ++tick) {
    InputRecord input;
    input.tick = tick;
    input.input.steering_wheel_rad = 0.1 * std::sin(static_cast<double>(tick) * 0.03);
    inputs.push_back(input);
  }
  CHECK(compute_steering_entropy(inputs, 120.0).errors == 17);
  inputs.erase(inputs.begin() + 18 * 10, inputs.begin() + 18 * 10 + 1);
  const auto broken = compute_steering_entropy(inputs, 120.0);
  CHECK(broken.errors == 7 + 6);
  CHECK(broken.entropy.has_value());
}

TEST_CASE("speeding counts samples over limit and tolerance and those without a limit apart") {
  std::vector<Sample> samples;
  for (int i = 0; i < 6; ++i) samples.push_back(sample_at(i, -1, 0.0));
  for (const int i : {1, 2, 4, 5}) samples[static_cast<std::size_t>(i)].speed_mps = 30.0;
  samples[0].speed_mps = 25.5;  // Within the tolerance.
  samples[4].speed_mps = 31.0;
  std::vector<std::optional<double>> limits(6, 25.0);
  limits[5].reset();
  const auto speeding = compute_speeding(samples, limits);
  CHECK(speeding.samples == 5);
  CHECK(speeding.no_limit == 1);
  CHECK(speeding.share == exactly(0.6));
  CHECK(speeding.over_s == exactly(0.3));
  CHECK(speeding.episodes == 2);
  CHECK(speeding.largest_excess_mps == exactly(6.0));
}

TEST_CASE("accelerations have the root mean square of a sine and hard brakings are counted once each") {
  std::vector<Sample> samples;
  for (int i = 0; i < 100; ++i) {
    samples.push_back(sample_at(i, -1, 0.0));
    samples.back().longitudinal_acceleration_mps2 = 6.0 * std::sin(2.0 * std::numbers::pi * i / 50.0);
    samples.back().lateral_acceleration_mps2 = i == 7 ? -2.0 : 0.0;
  }
  const auto a = compute_accelerations(samples);
  CHECK(a.longitudinal_rms_mps2 == exactly(6.0 / std::numbers::sqrt2));
  CHECK(a.lateral_rms_mps2 == exactly(0.2));
  CHECK(a.strongest_lateral_mps2 == 2.0);
  CHECK(a.hard_brakings == 2);
  samples[3].longitudinal_acceleration_mps2 = std::nan("");
  CHECK(compute_accelerations(samples).missing == 1);
}

TEST_CASE("a brake reaction is from the named event to the pedal and who has not braked is censored") {
  std::vector<InputRecord> inputs;
  for (Tick tick = 1; tick <= 1200; ++tick) {
    InputRecord input;
    input.tick = tick;
    input.input.brake = (tick >= 180 && tick < 240) || tick == 600 ? 0.4 : 0.0;
    inputs.push_back(input);
  }
  const std::vector<Event> events{{60, 0.5, "scenario", std::nullopt, "element=\"lead brakes\" state=running"},
                                  {60, 0.5, "scenario", std::nullopt, "element=other"},
                                  {200, 1.7, "scenario", std::nullopt, "element=\"lead brakes\" state=running"},
                                  {1000, 8.3, "scenario", std::nullopt, "element=\"lead brakes\" state=running"}};
  const auto reactions = find_brake_reactions(events, inputs, 120.0, parse_named_event("scenario:lead brakes"));
  REQUIRE(reactions.size() == 3);
  CHECK(reactions[0].response == BrakeResponse::braked);
  CHECK(reactions[0].time_s == exactly(1.0));
  CHECK(reactions[1].response == BrakeResponse::braking_already);
  CHECK(reactions[2].response == BrakeResponse::censored);
  CHECK(reactions[2].time_s == exactly(200.0 / 120.0));
}

TEST_CASE("a collision has the closing speed of its event and one that says none has none") {
  const auto collisions = find_collisions(std::vector<Event>{
      {1, 0.1, "collision", 7, "closing_speed_mps=12.50"},
      {2, 0.2, "lane_change", std::nullopt, ""},
      {3, 0.3, "collision", std::nullopt, "rail other_closing_speed_mps=3 closing_speed_mps=1.25 delta_v_mps=0.5"},
      {4, 0.4, "collision", std::nullopt, "closing_speed_mps=nan"}});
  REQUIRE(collisions.size() == 3);
  CHECK(collisions[0].closing_speed_mps.value() == 12.5);
  CHECK(collisions[1].closing_speed_mps.value() == 1.25);
  CHECK_FALSE(collisions[1].other.has_value());
  CHECK_FALSE(collisions[2].closing_speed_mps.has_value());
}

}  // namespace septet::logging
