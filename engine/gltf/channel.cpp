#include "engine/gltf/channel.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/math/spherical_interpolation.hpp"

namespace septet::gltf {
namespace {

using Interpolation = Channel::Interpolation;

constexpr std::size_t most_times = 10'000;
constexpr float longest_s = 3600.0f;

}  // namespace

Expected<Channel> read_channel(const Container& container, const Json& sampler, std::size_t width, std::size_t joined,
                               const std::string& where) {
  Channel channel;
  const std::string interpolation = text_in(sampler, "interpolation");
  if (interpolation == "STEP") channel.interpolation = Interpolation::step;
  if (interpolation == "CUBICSPLINE") channel.interpolation = Interpolation::cubic;
  auto times = read_rows(container, index_in(sampler, "input"), 1, 1, most_times);
  if (!times) return tl::unexpected(times.error());
  channel.times_s = std::move(times->numbers);
  auto values = read_rows(container, index_in(sampler, "output"), width, width, 3 * most_times * joined);
  if (!values) return tl::unexpected(values.error());
  channel.values = std::move(*values);
  const std::size_t rows_a_time = channel.interpolation == Interpolation::cubic ? 3 : 1;
  if (channel.times_s.empty() || channel.values.count != rows_a_time * joined * channel.times_s.size())
    return failure(fmt::format("it has {} values at {} times", channel.values.count, channel.times_s.size()), where,
                   export_anew);
  channel.values.count /= joined;
  channel.values.width *= joined;
  float before_s = -1.0f;
  for (const float time_s : channel.times_s) {
    if (!(time_s >= 0.0f && time_s > before_s && time_s <= longest_s))
      return failure(fmt::format("its times do not rise from 0 to at most {:.0f} s: {} s follows {} s", longest_s,
                                 time_s, std::max(before_s, 0.0f)),
                     where, export_anew);
    before_s = time_s;
  }
  return channel;
}

std::vector<WeightedRow> rows_at(const Channel& channel, double time_s, bool before) {
  const auto& times = channel.times_s;
  const bool is_cubic = channel.interpolation == Interpolation::cubic;
  constexpr std::size_t slope_before = 0, value = 1, slope_behind = 2;
  const auto row = [&](std::size_t time, std::size_t part) { return is_cubic ? 3 * time + part : time; };
  const auto from_s = [](float at_s) { return double{at_s}; };
  const auto next = before ? std::ranges::lower_bound(times, time_s, {}, from_s)
                           : std::ranges::upper_bound(times, time_s, {}, from_s);
  const auto after = static_cast<std::size_t>(next - times.begin());
  if (after == 0) return {{row(0, value), 1.0f}};
  if (after == times.size() || channel.interpolation == Interpolation::step) return {{row(after - 1, value), 1.0f}};
  const double length_s = double{times[after]} - double{times[after - 1]};
  const auto t = static_cast<float>((time_s - double{times[after - 1]}) / length_s),
             length = static_cast<float>(length_s);
  if (!is_cubic) return {{row(after - 1, value), 1.0f - t}, {row(after, value), t}};
  const float t2 = t * t, t3 = t2 * t;  // Appendix C.5.
  return {{row(after - 1, value), 2.0f * t3 - 3.0f * t2 + 1.0f},
          {row(after - 1, slope_behind), length * (t3 - 2.0f * t2 + t)},
          {row(after, value), 3.0f * t2 - 2.0f * t3},
          {row(after, slope_before), length * (t3 - t2)}};
}

glm::vec4 value_at(const Channel& channel, double time_s, bool before, bool is_turn) {
  const std::vector<WeightedRow> rows = rows_at(channel, time_s, before);
  const auto value_of = [&](std::size_t row) {
    glm::vec4 value(0.0f);
    for (std::size_t k = 0; k < channel.values.width; ++k)
      value[static_cast<glm::length_t>(k)] = channel.values.numbers[row * channel.values.width + k];
    return value;
  };
  if (is_turn && rows.size() == 2) {
    const auto turn_of = [](const glm::vec4& v) {
      const Quat turn(double{v.w}, double{v.x}, double{v.y}, double{v.z});
      const double size = glm::length(turn);
      return size > 1e-6 ? turn / size : Quat(1.0, 0.0, 0.0, 0.0);
    };
    const Quat turn = slerp_quadratic(turn_of(value_of(rows[0].row)), turn_of(value_of(rows[1].row)), 0.0,
                                      double{rows[1].factor});  // Appendix C.4.
    return {glm::vec3(turn.x, turn.y, turn.z), static_cast<float>(turn.w)};
  }
  if (rows.size() == 2) {
    const glm::vec4 from = value_of(rows[0].row);
    return from + rows[1].factor * (value_of(rows[1].row) - from);
  }
  glm::vec4 sum(0.0f);
  for (const WeightedRow& row : rows) sum += row.factor * value_of(row.row);
  return sum;
}

}  // namespace septet::gltf
