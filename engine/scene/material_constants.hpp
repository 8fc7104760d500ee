#pragma once
/// Fragments, and parts of them, that are constants here though Verse has them follow light, view or time.

#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/node.hpp"

namespace septet::scene {

/// What stands for a fragment's dependence on light, view or time: "view: 0.5 in each channel"; empty where nothing has to.
std::string_view constant_of(const Fragment& fragment);

/// A sentence for each such fragment of a material, by its id, with the constant that stands for it; each kind of
/// sentence once, for the fragment with the lowest id.
std::vector<std::string> constant_fragments(const Node& material);

}  // namespace septet::scene
