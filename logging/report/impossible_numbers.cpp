#include "logging/report/impossible_numbers.hpp"

#include <array>
#include <cstdint>
#include <string_view>

#include <fmt/core.h>

namespace septet::logging {
namespace {

template <class Row>
struct Bound {
  std::string_view name;
  double Row::*number;
  double largest;
};

constexpr double seconds = 1e9, metres = 1e8, across_m = 1e4, mps = 1e3, mps2 = 1e4, radians = 1e4, share = 10.0;

constexpr std::array sample_bounds{
    Bound<Sample>{"simulated_time_s", &Sample::simulated_time_s, seconds},
    Bound<Sample>{"x_m", &Sample::x_m, metres},
    Bound<Sample>{"y_m", &Sample::y_m, metres},
    Bound<Sample>{"z_m", &Sample::z_m, metres},
    Bound<Sample>{"heading_rad", &Sample::heading_rad, radians},
    Bound<Sample>{"speed_mps", &Sample::speed_mps, mps},
    Bound<Sample>{"longitudinal_acceleration_mps2", &Sample::longitudinal_acceleration_mps2, mps2},
    Bound<Sample>{"lateral_acceleration_mps2", &Sample::lateral_acceleration_mps2, mps2},
    Bound<Sample>{"yaw_rate_radps", &Sample::yaw_rate_radps, radians},
    Bound<Sample>{"road_s_m", &Sample::road_s_m, metres},
    Bound<Sample>{"lateral_position_m", &Sample::lateral_position_m, across_m},
    Bound<Sample>{"lane_width_m", &Sample::lane_width_m, across_m},
    Bound<Sample>{"steering_wheel_rad", &Sample::steering_wheel_rad, radians},
    Bound<Sample>{"accelerator", &Sample::accelerator, share},
    Bound<Sample>{"brake", &Sample::brake, share},
    Bound<Sample>{"clutch", &Sample::clutch, share},
    Bound<Sample>{"gaze_heading_rad", &Sample::gaze_heading_rad, radians}};
constexpr std::array leader_bounds{Bound<Leader>{"distance_gap_m", &Leader::distance_gap_m, metres},
                                   Bound<Leader>{"distance_headway_m", &Leader::distance_headway_m, metres},
                                   Bound<Leader>{"leader_speed_mps", &Leader::speed_mps, mps}};
constexpr std::array input_bounds{Bound<DriverInput>{"steering_wheel_rad", &DriverInput::steering_wheel_rad, radians},
                                  Bound<DriverInput>{"accelerator", &DriverInput::accelerator, share},
                                  Bound<DriverInput>{"brake", &DriverInput::brake, share},
                                  Bound<DriverInput>{"clutch", &DriverInput::clutch, share}};
constexpr Tick last_tick = Tick{1} << 53;

/// The first number of the row that is beyond its bound, in words; empty where each can be.
template <class Row, class Bounds>
std::string impossible_in(const Row& row, const Bounds& bounds, Tick tick) {
  for (const auto& bound : bounds)
    if (std::abs(row.*bound.number) > bound.largest)
      return fmt::format("{} is {:g} at tick {}", bound.name, row.*bound.number, tick);
  return {};
}

std::string impossible_in(const Sample& sample) {
  if (sample.tick >= last_tick) return fmt::format("a tick is {}", static_cast<std::int64_t>(sample.tick));
  auto first = impossible_in(sample, sample_bounds, sample.tick);
  if (first.empty() && sample.leader) first = impossible_in(*sample.leader, leader_bounds, sample.tick);
  return first;
}

std::string impossible_in(const InputRecord& input) {
  if (input.tick >= last_tick) return fmt::format("a tick is {}", static_cast<std::int64_t>(input.tick));
  return impossible_in(input.input, input_bounds, input.tick);
}

template <class Row>
std::size_t take_away(std::vector<Row>& rows, std::string& first) {
  return std::erase_if(rows, [&](const Row& row) {
    std::string words = impossible_in(row);
    const bool is_impossible = !words.empty();
    if (first.empty()) first = std::move(words);
    return is_impossible;
  });
}

}  // namespace

ImpossibleNumbers leave_out_impossible(std::vector<Sample>& samples, std::vector<InputRecord>& inputs) {
  ImpossibleNumbers found;
  found.samples = take_away(samples, found.first);
  found.inputs = take_away(inputs, found.first);
  return found;
}

void leave_out_impossible(std::vector<QuestionnaireRecord>& answers, ImpossibleNumbers& found) {
  for (QuestionnaireRecord& answer : answers) {
    const bool is_value = answer.value && std::abs(*answer.value) > seconds;
    const bool is_time = !(std::abs(answer.observed_s) <= seconds);
    if (!is_value && !is_time) continue;
    if (found.first.empty())
      found.first = fmt::format("the answer {} is {:g}", answer.item, is_value ? *answer.value : answer.observed_s);
    ++found.answers;
    if (is_value) answer.value = std::nullopt, answer.answer = std::nullopt;
    if (is_time) answer.observed_s = 0.0;
  }
}

std::string told(const ImpossibleNumbers& found) {
  if (!found.any()) return {};
  return fmt::format(
      "{} samples, {} driver inputs and {} answers hold numbers that nothing physical has and are left out of every "
      "figure "
      "({}): the session was damaged or altered.",
      found.samples, found.inputs, found.answers, found.first);
}

}  // namespace septet::logging
