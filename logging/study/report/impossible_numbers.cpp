#include "logging/study/report/impossible_numbers.hpp"

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

constexpr double bound_s = 1e9, bound_m = 1e8, bound_across_m = 1e4, bound_mps = 1e3, bound_mps2 = 1e4, bound_rad = 1e4,
                 bound_share = 10.0;

constexpr std::array sample_bounds{
    Bound<Sample>{"simulated_time_s", &Sample::simulated_time_s, bound_s},
    Bound<Sample>{"x_m", &Sample::x_m, bound_m},
    Bound<Sample>{"y_m", &Sample::y_m, bound_m},
    Bound<Sample>{"z_m", &Sample::z_m, bound_m},
    Bound<Sample>{"heading_rad", &Sample::heading_rad, bound_rad},
    Bound<Sample>{"speed_mps", &Sample::speed_mps, bound_mps},
    Bound<Sample>{"longitudinal_acceleration_mps2", &Sample::longitudinal_acceleration_mps2, bound_mps2},
    Bound<Sample>{"lateral_acceleration_mps2", &Sample::lateral_acceleration_mps2, bound_mps2},
    Bound<Sample>{"yaw_rate_radps", &Sample::yaw_rate_radps, bound_rad},
    Bound<Sample>{"road_s_m", &Sample::road_s_m, bound_m},
    Bound<Sample>{"lateral_position_m", &Sample::lateral_position_m, bound_across_m},
    Bound<Sample>{"lane_width_m", &Sample::lane_width_m, bound_across_m},
    Bound<Sample>{"steering_wheel_rad", &Sample::steering_wheel_rad, bound_rad},
    Bound<Sample>{"accelerator", &Sample::accelerator, bound_share},
    Bound<Sample>{"brake", &Sample::brake, bound_share},
    Bound<Sample>{"clutch", &Sample::clutch, bound_share},
    Bound<Sample>{"gaze_heading_rad", &Sample::gaze_heading_rad, bound_rad}};
constexpr std::array leader_bounds{Bound<Leader>{"distance_gap_m", &Leader::distance_gap_m, bound_m},
                                   Bound<Leader>{"distance_headway_m", &Leader::distance_headway_m, bound_m},
                                   Bound<Leader>{"leader_speed_mps", &Leader::speed_mps, bound_mps}};
constexpr std::array input_bounds{Bound<DriverInput>{"steering_wheel_rad", &DriverInput::steering_wheel_rad, bound_rad},
                                  Bound<DriverInput>{"accelerator", &DriverInput::accelerator, bound_share},
                                  Bound<DriverInput>{"brake", &DriverInput::brake, bound_share},
                                  Bound<DriverInput>{"clutch", &DriverInput::clutch, bound_share}};
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
    const bool is_value = answer.value && std::abs(*answer.value) > bound_s;
    const bool is_time = !(std::abs(answer.observed_s) <= bound_s);
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
