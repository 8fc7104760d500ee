#include "sim-client/frame/soot_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace septet::frame {
namespace {

/// A full layer transmits a fiftieth of the light from below (e^−3.9), half of one a seventh.
constexpr float full_layer_depth = 3.9f;

std::uint8_t cover_of(std::uint8_t level) {
  return static_cast<std::uint8_t>(std::lround(255.0f * (1.0f - std::exp(-full_layer_depth * smoke::soot_of(level)))));
}

}  // namespace

instant::SootField soot_field(const smoke::SootKeyframe& keyframe) {
  instant::SootField field;
  // One more cell on each side for surfaces beside it, and one without soot for a soft edge.
  constexpr int border = 2;
  field.nx = keyframe.nx + 2 * border, field.ny = keyframe.ny + 2 * border, field.nz = keyframe.nz + 2 * border;
  field.cell_m = keyframe.cell_m;
  field.world_from_field = keyframe.world_from_box;
  field.world_from_field.position_m = keyframe.world_from_box * Vec3(-border * static_cast<double>(keyframe.cell_m));
  std::vector<std::uint8_t> cover(static_cast<std::size_t>(field.nx) * field.ny * field.nz, 0);
  const auto at = [&](int i, int j, int k) { return (static_cast<std::size_t>(k) * field.ny + j) * field.nx + i; };
  for (int k = 0; k < keyframe.nz; ++k)
    for (int j = 0; j < keyframe.ny; ++j)
      for (int i = 0; i < keyframe.nx; ++i)
        cover[at(i + border, j + border, k + border)] =
            cover_of(keyframe.level[(static_cast<std::size_t>(k) * keyframe.ny + j) * keyframe.nx + i]);
  // The greatest of three along each axis in turn is the greatest of all 27.
  for (const std::size_t stride :
       {std::size_t{1}, static_cast<std::size_t>(field.nx), static_cast<std::size_t>(field.nx) * field.ny}) {
    field.cover = cover;
    for (std::size_t n = stride; n + stride < cover.size(); ++n)
      cover[n] = std::max({field.cover[n - stride], field.cover[n], field.cover[n + stride]});
  }
  field.cover = std::move(cover);
  return field;
}

const instant::SootField& SootDrawing::draw(std::span<const EffectKeyframe> effects) {
  const auto soot = std::ranges::find(effects, smoke::soot_kind, &EffectKeyframe::kind);
  if (soot == effects.end()) {
    field_ = {};
    tick_ = 0;
  } else if (soot->tick != tick_) {
    tick_ = soot->tick;
    const auto keyframe = smoke::decode_soot(soot->data);
    field_ = keyframe ? soot_field(*keyframe) : instant::SootField{};
  }
  return field_;
}

}  // namespace septet::frame
