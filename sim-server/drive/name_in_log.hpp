#pragma once
/// How a command in the log calls an object of the scene.

#include <string>

#include "engine/scene/store.hpp"

namespace septet::server {

/// Its name, printable and without a quotation mark; of one without a name its number, "#17". `id` is in the store.
std::string name_in_log(const scene::Store& store, scene::NodeId id);

}  // namespace septet::server
