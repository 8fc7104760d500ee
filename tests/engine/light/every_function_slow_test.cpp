/// The text of light means the same to both compilers: each function at 1,000 points, on the software device and on the
/// host.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/render/vulkan/vulkan_api.hpp"
#include "tests/engine/light/device_values.hpp"
#include "tests/engine/light/every_function.hpp"

namespace septet::light {
namespace {

constexpr std::size_t point_count = 1000;

std::vector<vec4> points_of_arguments() {
  Random random(1);
  std::vector<vec4> points(2 * point_count);
  for (vec4& point : points)
    for (int i = 0; i < 4; ++i) point[i] = static_cast<float>(random.uniform());
  return points;
}

/// Sine, exponential and division differ from device to device by 2 in 10,000, and what is left of a difference of
/// numbers near 1 by their rounding.
bool alike(float one, float other) {
  return std::abs(one - other) <= 2e-4f * std::max(std::abs(one), std::abs(other)) + 5e-7f;
}

}  // namespace

TEST_CASE("each function of light has the same values on the device as on the host at 1,000 points") {
  const std::vector<vec4> points = points_of_arguments();
  const std::vector<vec4> device = values_on_device(points, function_count);
  for (uint function = 0; function < function_count; ++function) {
    std::size_t apart = 0, varied = 0;
    vec4 first(0.0f);
    for (std::size_t i = 0; i < point_count; ++i) {
      const vec4 host = value_of(function, points[2 * i], points[2 * i + 1]);
      const vec4 there = device[function * point_count + i];
      if (i == 0) first = host;
      bool same = true;
      for (int k = 0; k < 4; ++k) same = same && alike(host[k], there[k]);
      apart += same ? 0 : 1;
      varied += host == first ? 0 : 1;
    }
    CAPTURE(function);
    CHECK(apart == 0);
    CHECK(varied > 0);
  }
}

}  // namespace septet::light
