#pragma once
/// Time of one pass of a frame by the device's clock.

#include <string_view>

namespace septet::render {

struct PassTime {
  std::string_view name;  ///< String literal.
  double time_ms = 0.0;
};

}  // namespace septet::render
