#include "sim-client/frame/soot_drawing.hpp"

#include <doctest/doctest.h>

using namespace septet;
using namespace septet::frame;

namespace {

smoke::SootKeyframe one_cell(std::uint8_t level) {
  smoke::SootKeyframe keyframe;
  keyframe.world_from_box.position_m = Vec3(100, 20, 5);
  keyframe.cell_m = 1.0f;
  keyframe.nx = keyframe.ny = keyframe.nz = 1;
  keyframe.level = {level};
  return keyframe;
}

}  // namespace

TEST_CASE("soot covers the surfaces beside its cell and nothing beyond") {
  const instant::SootField field = soot_field(one_cell(smoke::soot_levels - 1));
  REQUIRE(field.cover.size() == 125);
  std::size_t covered = 0;
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 5; ++i) {
        const bool beside = std::max({std::abs(i - 2), std::abs(j - 2), std::abs(k - 2)}) <= 1;
        CHECK((field.cover[static_cast<std::size_t>((k * 5 + j) * 5 + i)] > 240) == beside);
        covered += beside;
      }
  CHECK(covered == 27);
  CHECK(glm::length(field.world_from_field * Vec3(2.5) - Vec3(100.5, 20.5, 5.5)) < 1e-9);
}

TEST_CASE("more soot covers more") {
  CHECK(soot_field(one_cell(8)).cover[62] > 0);
  CHECK(soot_field(one_cell(32)).cover[62] > 2 * soot_field(one_cell(16)).cover[62]);
  int last = 0;
  for (std::uint8_t level = 1; level < smoke::soot_levels; ++level) {
    const int cover = soot_field(one_cell(level)).cover[62];
    CHECK(cover >= last);
    last = cover;
  }
}

TEST_CASE("soot that cannot be read is left out") {
  SootDrawing drawing;
  const std::vector<EffectKeyframe> effects{{smoke::soot_effect_id, smoke::soot_kind, Bytes(9), 4}};
  CHECK(drawing.draw(effects).cover.empty());
  CHECK(drawing.draw(effects).cover.empty());
}
