#include "engine/world/vehicle_model.hpp"

#include <cstddef>

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("every vehicle model is found by its name and no other word finds one") {
  const auto models = vehicle_models();
  for (std::size_t i = 0; i < models.size(); ++i) {
    CAPTURE(models[i].name);
    CHECK(find_vehicle_model(models[i].name) == static_cast<ModelIndex>(i));
  }
  for (const char* other : {"", "horse-cart", "volvo", "volvo-s80 "})
    CHECK_FALSE(find_vehicle_model(other).has_value());
}

}  // namespace septet
