#pragma once
/// What a pass of a frame took by the device's clock.

#include <string_view>

namespace septet::render {

struct PassTime {
  std::string_view name;  ///< A literal.
  double time_ms = 0.0;
};

}  // namespace septet::render
