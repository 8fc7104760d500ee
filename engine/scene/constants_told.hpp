#pragma once
/// Tells once of each constant that stands for fragments which an author sets (material_constants.hpp).

#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/command.hpp"

namespace septet::scene {

/// Kinds of constants of materials that are told; a drive in which more are set goes on without words.
inline constexpr std::size_t most_constants_told = 10'000;

class ConstantsTold {
 public:
  /// A sentence for each fragment that the batch sets and that is a constant here, unless that of its material was told
  /// already: the material by `name_of`, the fragment, and what it gives. It is no refusal.
  std::vector<std::string> news_of(std::span<const Command> batch, const std::function<std::string(NodeId)>& name_of);

 private:
  std::set<std::pair<NodeId, std::string>> told_;  ///< Of a material: the constant.
};

}  // namespace septet::scene
