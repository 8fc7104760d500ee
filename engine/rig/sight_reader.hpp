#pragma once
/// The driver's view in a rig file: rectangles, mirrors, the head and its range of movement.

#include <string_view>

#include "engine/document/table_reader.hpp"
#include "engine/rig/rig.hpp"

namespace septet::rig {

inline constexpr const char* documented_in = "rigs/README.md";

void read_window(document::TableReader& reader, Window& window);
/// Reads a mirror. Without a zone of its own a look within 15° of the glass's middle counts.
Mirror read_mirror(const toml::table& table, const Vec3& eye_point_m, std::string_view file, Error& error);
HeadTracking read_head(const toml::table& table, std::string_view file, Error& error);

/// Checks that from all possible eye points each screen and each mirror is seen from its front.
void check_sight(const Rig& rig, document::TableReader& reader);

}  // namespace septet::rig
