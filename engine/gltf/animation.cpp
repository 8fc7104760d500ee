#include "engine/gltf/animation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/nodes.hpp"

namespace septet::gltf {
namespace {

constexpr std::size_t most_times_in_all = 1'000'000, most_weights = 256;
constexpr double taken_apart_s = 1.0 / 60.0;

/// What a channel does not move, by kind, with the first animation that has it.
struct NotPlayed {
  std::string weights, twice, other;
};

std::array<float, 3> three_of(const glm::vec4& v) { return {v.x, v.y, v.z}; }

NodePose pose_at(const Animations& animations, std::int64_t node, double time_s, bool before) {
  NodePose pose;
  const auto moved = animations.by_node.find(node);
  if (moved == animations.by_node.end()) return pose;
  const NodeChannels& by = moved->second;
  if (by.translation) pose.translation = three_of(value_at(*by.translation, time_s, before, false));
  if (by.scale) pose.scale = three_of(value_at(*by.scale, time_s, before, false));
  if (by.rotation) {
    const glm::vec4 turn = value_at(*by.rotation, time_s, before, true);
    pose.rotation = {turn.x, turn.y, turn.z, turn.w};
  }
  return pose;
}

/// `before`: just before the time.
glm::mat4 model_from_node(const Container& container, const Animations& animations,
                          const std::vector<std::int64_t>& chain, double time_s, bool before) {
  const Json& nodes = list_of(*container.json, "nodes");
  glm::mat4 placed(1.0f);
  for (const std::int64_t node : chain)
    placed =
        placed * parent_from_node(nodes[static_cast<std::size_t>(node)], pose_at(animations, node, time_s, before));
  return placed;
}

/// Places a node and those below it, of which none is its own ancestor.
void place_below(const Container& container, const Animations& animations, std::int64_t index,
                 const glm::mat4& model_from_parent, double time_s, PlacedNodes& placed) {
  const Json& node = list_of(*container.json, "nodes")[static_cast<std::size_t>(index)];
  const glm::mat4 model_from_node =
      model_from_parent * parent_from_node(node, pose_at(animations, index, time_s, false));
  placed.model_from_node[static_cast<std::size_t>(index)] = model_from_node;
  for (const Json& child : list_of(node, "children"))
    place_below(container, animations, node_index(*container.json, child), model_from_node, time_s, placed);
}

/// The number of morph targets of a node's mesh.
std::size_t targets_of(const Container& container, std::int64_t node) {
  const Json& nodes = list_of(*container.json, "nodes");
  const Json& meshes = list_of(*container.json, "meshes");
  const Json& json = nodes[static_cast<std::size_t>(node)];
  const std::int64_t mesh = json.is_object() ? index_in(json, "mesh") : -1;
  if (mesh < 0 || static_cast<std::uint64_t>(mesh) >= meshes.size()) return 0;
  const Json& primitives = list_of(meshes[static_cast<std::size_t>(mesh)], "primitives");
  return primitives.empty() ? 0 : list_of(primitives[0], "targets").size();
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
      has_curves |= (*channel)->interpolation == Channel::Interpolation::cubic;
      for (const float time_s : (*channel)->times_s) {
        times.all.insert(double{time_s});
        if ((*channel)->interpolation == Channel::Interpolation::step && time_s > 0.0f)
          times.jumps.insert(double{time_s});
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
      const bool is_weights = path == "weights";
      if (!is_turn && !is_weights && path != "translation" && path != "scale") {
        if (not_played.other.empty()) not_played.other = called;
        continue;
      }
      if (!target.contains("node")) continue;  // 3.11: such a channel is ignored.
      const std::string where = fmt::format("{}, {}, channel {}", container.where, called, c);
      const std::int64_t sampler = index_in(channels[c], "sampler"), node = index_in(target, "node");
      if (sampler < 0 || static_cast<std::uint64_t>(sampler) >= samplers.size())
        return failure(fmt::format("its sampler is none of {}", samplers.size()), where, export_anew);
      if (node < 0 || static_cast<std::uint64_t>(node) >= list_of(*container.json, "nodes").size())
        return failure("it moves no node of the file", where, export_anew);
      const std::size_t targets = is_weights ? targets_of(container, node) : 0;
      if (is_weights && (targets == 0 || targets > most_weights)) {
        if (not_played.weights.empty()) not_played.weights = called;
        continue;
      }
      NodeChannels& of_node = read.by_node[node];
      auto& moved = is_weights        ? of_node.weights
                    : is_turn         ? of_node.rotation
                    : path == "scale" ? of_node.scale
                                      : of_node.translation;
      if (moved) {
        if (not_played.twice.empty()) not_played.twice = called;
        continue;
      }
      const Json& sampling = samplers[static_cast<std::size_t>(sampler)];
      auto channel = is_weights ? read_channel(container, sampling, 1, targets, where)
                                : read_channel(container, sampling, is_turn ? 4 : 3, 1, where);
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
  tell(not_played.weights, "moves the weights of no morph targets, or of more than 256, which is not played");
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

PlacedNodes placed_at(const Container& container, const Animations& animations, const PlacedNodes& placed,
                      double time_s) {
  PlacedNodes then{placed.roots, std::vector<std::optional<glm::mat4>>(placed.model_from_node.size())};
  for (const std::int64_t root : placed.roots) place_below(container, animations, root, glm::mat4(1.0f), time_s, then);
  return then;
}

std::vector<float> weights_at(const Animations& animations, std::int64_t node, double time_s) {
  const auto found = animations.by_node.find(node);
  if (found == animations.by_node.end() || !found->second.weights) return {};
  const Channel& channel = *found->second.weights;
  std::vector<float> weights(channel.values.width, 0.0f);
  for (const WeightedRow& row : rows_at(channel, time_s, false))
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] += row.factor * channel.values.numbers[row.row * weights.size() + k];
  return weights;
}

}  // namespace septet::gltf
