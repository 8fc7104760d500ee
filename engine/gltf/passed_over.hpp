#pragma once
/// What of a file is not read: refused where the file requires it, told where it may be missed (glTF 2.0, 3.12).

#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// Error: the file requires an extension that is not applied.
Expected<void> check_required_extensions(const Container& container);

/// One sentence a kind of contents, with the first that has it and how many there are: extensions used and not
/// applied, points and lines, cameras, other
/// scenes.
std::vector<std::string> passed_over(const Container& container);

}  // namespace septet::gltf
