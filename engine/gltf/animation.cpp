#include "engine/gltf/animation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/nodes.hpp"
#include "engine/math/spherical_interpolation.hpp"

namespace septet::gltf {
namespace {

using Interpolation = Channel::Interpolation;

constexpr std::size_t most_times = 10'000, most_times_in_all = 1'000'000;
constexpr float longest_s = 3600.0f;
constexpr double taken_apart_s = 1.0 / 60.0;

/// What a channel does not move, by kind, with the first animation that has it.
struct NotPlayed {
  std::string weights, twice, other;
};

Expected<Channel> read_channel(const Container& container, const Json& sampler, std::size_t width,
                               const std::string& where) {
  Channel channel;
  const std::string interpolation = text_in(sampler, "interpolation");
  if (interpolation == "STEP") channel.interpolation = Interpolation::step;
  if (interpolation == "CUBICSPLINE") channel.interpolation = Interpolation::cubic;
  auto times = read_rows(container, index_in(sampler, "input"), 1, 1, most_times);
  if (!times) return tl::unexpected(times.error());
  channel.times_s = std::move(times->numbers);
  auto values = read_rows(container, index_in(sampler, "output"), width, width, 3 * most_times);
  if (!values) return tl::unexpected(values.error());
  channel.values = std::move(*values);
  const std::size_t rows_a_time = channel.interpolation == Interpolation::cubic ? 3 : 1;
  if (channel.times_s.empty() || channel.values.count != rows_a_time * channel.times_s.size())
    return failure(fmt::format("it has {} values at {} times", channel.values.count, channel.times_s.size()), where,
                   export_anew);
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

/// The value at a time; `before`: just before it. Outside of its times that of the nearest (3.11).
glm::vec4 value_at(const Channel& channel, double time_s, bool before, bool is_turn) {
  const auto& times = channel.times_s;
  const bool is_cubic = channel.interpolation == Interpolation::cubic;
  const auto row = [&](std::size_t time, std::size_t part) {
    const std::size_t width = channel.values.width, at = (is_cubic ? 3 * time + part : time) * width;
    glm::vec4 value(0.0f);
    for (std::size_t k = 0; k < width; ++k) value[static_cast<glm::length_t>(k)] = channel.values.numbers[at + k];
    return value;
  };
  constexpr std::size_t slope_before = 0, value = 1, slope_behind = 2;
  const auto from_s = [](float at_s) { return double{at_s}; };
  const auto next = before ? std::ranges::lower_bound(times, time_s, {}, from_s)
                           : std::ranges::upper_bound(times, time_s, {}, from_s);
  const auto after = static_cast<std::size_t>(next - times.begin());
  if (after == 0) return row(0, value);
  if (after == times.size() || channel.interpolation == Interpolation::step) return row(after - 1, value);
  const double length_s = double{times[after]} - double{times[after - 1]};
  const double share = (time_s - double{times[after - 1]}) / length_s;
  const glm::vec4 from = row(after - 1, value), to = row(after, value);
  const auto t = static_cast<float>(share), length = static_cast<float>(length_s);
  if (is_cubic) {  // Appendix C.5.
    const float t2 = t * t, t3 = t2 * t;
    return (2.0f * t3 - 3.0f * t2 + 1.0f) * from + length * (t3 - 2.0f * t2 + t) * row(after - 1, slope_behind) +
           (3.0f * t2 - 2.0f * t3) * to + length * (t3 - t2) * row(after, slope_before);
  }
  if (!is_turn) return from + t * (to - from);
  const auto turn_of = [](const glm::vec4& v) {
    const Quat turn(double{v.w}, double{v.x}, double{v.y}, double{v.z});
    const double size = glm::length(turn);
    return size > 1e-6 ? turn / size : Quat(1.0, 0.0, 0.0, 0.0);
  };
  const Quat turn = slerp_quadratic(turn_of(from), turn_of(to), 0.0, share);  // Appendix C.4.
  return {glm::vec3(turn.x, turn.y, turn.z), static_cast<float>(turn.w)};
}

std::array<float, 3> three_of(const glm::vec4& v) { return {v.x, v.y, v.z}; }

/// `before`: just before the time.
glm::mat4 model_from_node(const Container& container, const Animations& animations,
                          const std::vector<std::int64_t>& chain, double time_s, bool before) {
  const Json& nodes = list_of(*container.json, "nodes");
  glm::mat4 placed(1.0f);
  for (const std::int64_t node : chain) {
    NodePose pose;
    if (const auto moved = animations.by_node.find(node); moved != animations.by_node.end()) {
      const NodeChannels& by = moved->second;
      if (by.translation) pose.translation = three_of(value_at(*by.translation, time_s, before, false));
      if (by.scale) pose.scale = three_of(value_at(*by.scale, time_s, before, false));
      if (by.rotation) {
        const glm::vec4 turn = value_at(*by.rotation, time_s, before, true);
        pose.rotation = {turn.x, turn.y, turn.z, turn.w};
      }
    }
    placed = placed * parent_from_node(nodes[static_cast<std::size_t>(node)], pose);
  }
  return placed;
}

/// A matrix as place, turn and size; what it shears is lost.
PoseKey key_of(const glm::mat4& model_from_part, double at_s) {
  PoseKey key;
  key.at_s = static_cast<float>(at_s);
  key.position_m = glm::vec3(model_from_part[3]);
  glm::mat3 turn(model_from_part);
  const bool mirrors = glm::determinant(turn) < 0.0f;
  bool has_no_turn = false;
  for (int i = 0; i < 3; ++i) {
    key.scale[i] = glm::length(turn[i]);
    has_no_turn |= key.scale[i] < 1e-6f;
    if (!has_no_turn) turn[i] /= key.scale[i];
  }
  if (mirrors) {
    key.scale.x = -key.scale.x;
    turn[0] = -turn[0];
  }
  if (!has_no_turn) key.rotation = glm::normalize(glm::quat_cast(turn));
  return key;
}

/// Times of a chain's keys, and those at which it jumps.
struct Times {
  std::set<double> all, jumps;
};

Times times_of(const Animations& animations, const std::vector<std::int64_t>& chain) {
  Times times;
  const double period_s = double{animations.period_s};
  std::size_t moving_nodes = 0;
  bool has_curves = false;
  for (const std::int64_t node : chain) {
    const auto found = animations.by_node.find(node);
    if (found == animations.by_node.end()) continue;
    ++moving_nodes;
    for (const auto* channel : {&found->second.translation, &found->second.rotation, &found->second.scale}) {
      if (!*channel) continue;
      has_curves |= (*channel)->interpolation == Interpolation::cubic;
      for (const float time_s : (*channel)->times_s) {
        times.all.insert(double{time_s});
        if ((*channel)->interpolation == Interpolation::step && time_s > 0.0f) times.jumps.insert(double{time_s});
      }
    }
  }
  times.all.insert({0.0, period_s});
  const bool is_fine = has_curves || moving_nodes > 1;
  const bool is_long = times.all.size() + times.jumps.size() > max_pose_keys;
  if (!is_fine && !is_long) return times;
  if (is_long) times = {};
  const auto left = static_cast<double>(max_pose_keys - 1 - std::min(max_pose_keys / 2, times.all.size()));
  const auto steps = static_cast<std::size_t>(std::clamp(std::ceil(period_s / taken_apart_s), 1.0, left / 2.0));
  for (std::size_t i = 0; i <= steps; ++i)
    times.all.insert(period_s * static_cast<double>(i) / static_cast<double>(steps));
  return times;
}

}  // namespace

Expected<Animations> read_animations(const Container& container, std::vector<std::string>& left_out) {
  Animations read;
  NotPlayed not_played;
  std::size_t times = 0;
  const Json& animations = list_of(*container.json, "animations");
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const std::string name = printable(text_in(animations[i], "name"), 80);
    const std::string called = name.empty() ? fmt::format("animation {}", i) : fmt::format("animation \"{}\"", name);
    const Json& channels = list_of(animations[i], "channels");
    const Json& samplers = list_of(animations[i], "samplers");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Json& target = member_of(channels[c], "target");
      const std::string path = text_in(target, "path");
      const bool is_turn = path == "rotation";
      if (!is_turn && path != "translation" && path != "scale") {
        std::string& first = path == "weights" ? not_played.weights : not_played.other;
        if (first.empty()) first = called;
        continue;
      }
      if (!target.contains("node")) continue;  // 3.11: such a channel is ignored.
      const std::string where = fmt::format("{}, {}, channel {}", container.where, called, c);
      const std::int64_t sampler = index_in(channels[c], "sampler"), node = index_in(target, "node");
      if (sampler < 0 || static_cast<std::uint64_t>(sampler) >= samplers.size())
        return failure(fmt::format("its sampler is none of {}", samplers.size()), where, export_anew);
      if (node < 0 || static_cast<std::uint64_t>(node) >= list_of(*container.json, "nodes").size())
        return failure("it moves no node of the file", where, export_anew);
      NodeChannels& of_node = read.by_node[node];
      auto& moved = is_turn ? of_node.rotation : path == "scale" ? of_node.scale : of_node.translation;
      if (moved) {
        if (not_played.twice.empty()) not_played.twice = called;
        continue;
      }
      auto channel = read_channel(container, samplers[static_cast<std::size_t>(sampler)], is_turn ? 4 : 3, where);
      if (!channel) return tl::unexpected(channel.error());
      times += channel->times_s.size();
      if (times > most_times_in_all)
        return failure(fmt::format("its animations have more than {} times", most_times_in_all), container.where,
                       "bake them with fewer keys");
      read.period_s = std::max(read.period_s, channel->times_s.back());
      moved = std::move(*channel);
    }
  }
  const auto tell = [&](const std::string& which, std::string_view what) {
    if (!which.empty()) left_out.push_back(fmt::format("{} {}", which, what));
  };
  tell(not_played.twice, "moves what an earlier one moves: there the earlier one is played");
  tell(not_played.weights,
       "moves the weights of morph targets, which is not played: they stay as they are in the file");
  tell(not_played.other, "moves something else than nodes, which is not played");
  return read;
}

std::vector<PoseKey> keys_of_chain(const Container& container, const Animations& animations,
                                   const std::vector<std::int64_t>& chain) {
  const Times times = times_of(animations, chain);
  std::vector<PoseKey> keys;
  for (const double at_s : times.all) {
    if (times.jumps.contains(at_s))
      keys.push_back(key_of(model_from_node(container, animations, chain, at_s, true), at_s));
    keys.push_back(key_of(model_from_node(container, animations, chain, at_s, false), at_s));
  }
  return keys;
}

}  // namespace septet::gltf
