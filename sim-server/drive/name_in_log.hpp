#pragma once
/// How a command in the log calls an object of the scene, and its author.

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/scene/store.hpp"

namespace septet::server {

/// A name as it may stand between quotation marks: printable, `most_bytes` at most and "…", an apostrophe for each mark.
std::string in_quotes_in_log(std::string_view name, std::size_t most_bytes = 400);

/// The object's name; of one without a name its number, "#17". `id` is in the store.
std::string name_in_log(const scene::Store& store, scene::NodeId id);

}  // namespace septet::server
