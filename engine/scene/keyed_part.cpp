#include "engine/scene/keyed_part.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include <fmt/format.h>
#include <glm/geometric.hpp>

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

void append(Blob& blob, float number) {
  const auto bits = std::bit_cast<std::uint32_t>(number);
  for (int shift = 0; shift < 32; shift += 8) blob.push_back(static_cast<std::uint8_t>(bits >> shift));
}

float number_at(const Blob& blob, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) bits |= std::uint32_t{blob[at + i]} << (8 * i);
  return std::bit_cast<float>(bits);
}

/// The key at a byte of a blob; empty where it is no pose.
std::optional<PoseKey> key_at(const Blob& blob, std::size_t at) {
  std::array<float, numbers_a_key> n{};
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = number_at(blob, at + 4 * i);
  if (!std::ranges::all_of(n, [](float number) { return std::isfinite(number); })) return std::nullopt;
  PoseKey key{n[0], {n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7]}, {n[8], n[9], n[10]}};
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
  const std::size_t count = std::min(keys.size(), max_pose_keys);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % keys_a_tag == 0) tags.push_back({fmt::format("keys/{}", i / keys_a_tag), Blob{}});
    for (const float number : numbers_of(keys[i])) append(std::get<Blob>(tags.back().value), number);
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
    for (std::size_t at = 0; at < blob->size(); at += bytes_a_key) {
      const auto key = key_at(*blob, at);
      if (!key || key->at_s < (keys.empty() ? 0.0f : keys.back().at_s)) return {};
      keys.push_back(*key);
    }
  }
  return keys;
}

}  // namespace septet::scene
