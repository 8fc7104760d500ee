#include <string>

#include <doctest/doctest.h>

#include "engine/scenery/model_size.hpp"

namespace septet::scenery {

TEST_CASE("a size that no metres give is doubted with its remedy, and any other is not") {
  const auto remedy = [](float longest_m) -> std::string {
    gltf::Model model;
    model.least_m = {-1.0f, 0.0f, 2.0f};
    model.most_m = {longest_m - 1.0f, 0.01f, 2.01f};
    const auto doubt = doubted_size(model);
    return doubt ? doubt->remedy : "";
  };
  CHECK(remedy(0.04f).starts_with("scale it by 100,"));
  CHECK(remedy(0.06f).empty());
  CHECK(remedy(99.0f).empty());
  CHECK(remedy(101.0f).starts_with("scale it by 0.01,"));
  CHECK(remedy(1001.0f).starts_with("scale it by 0.001,"));
}

}  // namespace septet::scenery
