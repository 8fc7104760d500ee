#include "engine/scene/keyed_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/core/bytes.hpp"
#include "engine/scene/world_bounds.hpp"

namespace septet::scene {
namespace {

/// Time, place, rotation (w first), scale, each a little-endian real32.
constexpr std::size_t numbers_a_key = 11, bytes_a_key = 4 * numbers_a_key;
/// As many as a tag's bytes hold (command_limits.hpp), and the tags of all.
constexpr std::size_t keys_a_tag = 93, most_tags = (max_pose_keys + keys_a_tag - 1) / keys_a_tag;

std::array<float, numbers_a_key> numbers_of(const PoseKey& key) {
  const auto& [at_s, p, r, s] = key;
  return {at_s, p.x, p.y, p.z, r.w, r.x, r.y, r.z, s.x, s.y, s.z};
}

Blob blob_of(std::span<const PoseKey> keys) {
  Bytes bytes;
  ByteWriter out(bytes);
  for (const PoseKey& key : keys)
    for (const float number : numbers_of(key)) out.put(number);
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return {first, first + bytes.size()};
}

/// Empty where what comes next is no pose.
std::optional<PoseKey> read_key(ByteReader& in) {
  std::array<float, numbers_a_key> n{};
  for (float& number : n) number = in.get_float();
  if (!std::ranges::all_of(n, [](float number) { return std::isfinite(number); })) return std::nullopt;
  PoseKey key{n[0], {n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7]}, {n[8], n[9], n[10]}};
  if (!is_within(key.position_m, farthest_m) || !is_within(key.scale, largest_scale)) return std::nullopt;
  const float length = glm::length(key.rotation);
  if (!(length > 0.9f && length < 1.1f)) return std::nullopt;
  if (std::abs(length - 1.0f) > 1e-6f) key.rotation = key.rotation / length;
  return key;
}

}  // namespace

ScaledPose child_of(const ScaledPose& parent, const RigidTransform& parent_from_child, const glm::vec3& scale) {
  return {{parent.pose * (Vec3(parent.scale) * parent_from_child.position_m),
           parent.pose.orientation * parent_from_child.orientation},
          parent.scale * scale};
}

std::optional<Instance> moved(const Instance& instance, double simulated_time_s) {
  if (!instance.keyed) return std::nullopt;
  const KeyedPart& keyed = *instance.keyed;
  const PoseKey now = keyed_pose(keyed.keys, simulated_time_s);
  const ScaledPose object = child_of(keyed.above, {Vec3(now.position_m), Quat(now.rotation)}, now.scale);
  const ScaledPose part = child_of(object, keyed.below.pose, keyed.below.scale);
  Instance at = instance;
  at.world_from_object = part.pose;
  at.scale = part.scale;
  return at;
}

bool same_keys(const std::shared_ptr<const KeyedPart>& a, const std::shared_ptr<const KeyedPart>& b) {
  if (a == b) return true;
  if (!a || !b) return false;
  const auto same = [](const ScaledPose& x, const ScaledPose& y) {
    return x.pose.position_m == y.pose.position_m && x.pose.orientation == y.pose.orientation && x.scale == y.scale;
  };
  return same(a->above, b->above) && same(a->below, b->below) && a->keys == b->keys;
}

std::vector<Tag> tags_of_keys(const std::vector<PoseKey>& keys) {
  std::vector<Tag> tags;
  auto rest = std::span(keys).first(std::min(keys.size(), max_pose_keys));
  while (!rest.empty()) {
    const auto some = rest.first(std::min(rest.size(), keys_a_tag));
    tags.push_back({fmt::format("keys/{}", tags.size()), blob_of(some)});
    rest = rest.subspan(some.size());
  }
  return tags;
}

std::vector<PoseKey> keys_of(const Node& object) {
  std::vector<PoseKey> keys;
  for (std::size_t n = 0; n < most_tags; ++n) {
    const TagValue* value = find_tag(object, "draw", fmt::format("keys/{}", n));
    if (!value) break;
    const Blob* blob = std::get_if<Blob>(value);
    if (!blob || blob->size() % bytes_a_key != 0) return {};
    ByteReader in(std::as_bytes(std::span(*blob)));
    while (!in.at_end()) {
      const auto key = read_key(in);
      if (!key || key->at_s < (keys.empty() ? 0.0f : keys.back().at_s)) return {};
      keys.push_back(*key);
    }
  }
  return keys;
}

}  // namespace septet::scene
