#pragma once
/// Meshes that an animation bends, by joints or by the weights of morph targets: a row of poses, each a part of its own
/// that is there for its share of the period.
///
/// Between two poses nothing is blended, so a file says by its length and its triangles how fine the steps are: 30
/// poses a second, no more than 120, and no more than `most_bent_size` triangles in all of them.

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "engine/gltf/animation.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/nodes.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {

inline constexpr std::size_t most_bent_poses = 120, most_bent_size = 200'000;

struct BentMeshes {
  std::set<std::int64_t> nodes;  ///< Those of the scene that have such a mesh.
  std::size_t poses = 0;         ///< Below 2: too many triangles, all stay as they are in the file.
};

BentMeshes find_bent_meshes(const Container& container, const Animations& animations, const PlacedNodes& placed);

/// The time that a pose is taken at: the middle of its share of the period.
double bent_pose_time_s(std::size_t pose, std::size_t poses, double period_s);

/// Keys of a part that is there while the pose is shown, and has no size at other times.
std::vector<PoseKey> keys_of_bent_pose(std::size_t pose, std::size_t poses, double period_s);

}  // namespace septet::gltf
