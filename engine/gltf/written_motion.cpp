#include "engine/gltf/written_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace septet::gltf {
namespace {

/// Values by time, which does not fall.
struct TimedValue {
  float at_s = 0.0f;
  glm::vec4 value{0.0f};
};

bool only_jumps(const std::vector<TimedValue>& values) {
  return std::ranges::adjacent_find(values, [](const TimedValue& a, const TimedValue& b) {
           return a.at_s < b.at_s && a.value != b.value;
         }) == values.end();
}

/// Rising times: of those at one time the last stays, and the first goes before it where a line ends in it.
std::vector<TimedValue> at_rising_times(const std::vector<TimedValue>& values, bool steps) {
  std::vector<TimedValue> rising;
  for (std::size_t first = 0; first < values.size();) {
    std::size_t last = first;
    while (last + 1 < values.size() && values[last + 1].at_s == values[first].at_s) ++last;
    const float before_s = std::nextafter(values[first].at_s, 0.0f);
    if (!steps && !rising.empty() && values[first].value != values[last].value && before_s > rising.back().at_s)
      rising.push_back({before_s, values[first].value});
    rising.push_back(values[last]);
    first = last + 1;
  }
  return rising;
}

void add_channel(const std::vector<TimedValue>& values, const char* path, std::size_t width, std::size_t node,
                 WrittenBuffer& buffer, Json& animation) {
  const bool steps = only_jumps(values);
  const std::vector<TimedValue> rising = at_rising_times(values, steps);
  std::vector<float> times_s, numbers;
  for (const TimedValue& at : rising) {
    times_s.push_back(at.at_s);
    for (std::size_t k = 0; k < width; ++k) numbers.push_back(at.value[static_cast<glm::length_t>(k)]);
  }
  const std::size_t input = buffer.accessor({.view = buffer.view(times_s, WrittenBuffer::no_target),
                                             .numbers = WrittenBuffer::floats,
                                             .count = times_s.size(),
                                             .least = {times_s.front()},
                                             .most = {times_s.back()}});
  const std::size_t output = buffer.accessor({.view = buffer.view(numbers, WrittenBuffer::no_target),
                                              .numbers = WrittenBuffer::floats,
                                              .count = times_s.size(),
                                              .type = width == 4 ? "VEC4" : "VEC3"});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", steps ? "STEP" : "LINEAR"}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

}  // namespace

void add_written_keys(const std::vector<PoseKey>& keys, std::size_t node, WrittenBuffer& buffer, Json& animation) {
  struct Path {
    const char* name;
    std::size_t width;
    std::function<glm::vec4(const PoseKey&)> value_of;
  };
  const std::array<Path, 3> paths{{
      {"translation", 3, [](const PoseKey& key) { return glm::vec4(file_axes(key.position_m), 0.0f); }},
      {"rotation", 4,
       [](const PoseKey& key) {
         return glm::vec4(file_axes({key.rotation.x, key.rotation.y, key.rotation.z}), key.rotation.w);
       }},
      {"scale", 3, [](const PoseKey& key) { return glm::vec4(file_axes(key.scale), 0.0f); }},
  }};
  for (const Path& path : paths) {
    std::vector<TimedValue> values;
    values.reserve(keys.size());
    for (const PoseKey& key : keys) values.push_back({key.at_s, path.value_of(key)});
    const bool changes =
        std::ranges::any_of(values, [&](const TimedValue& at) { return at.value != values.front().value; });
    if (changes) add_channel(values, path.name, path.width, node, buffer, animation);
  }
}

}  // namespace septet::gltf
