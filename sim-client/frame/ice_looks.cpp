#include "sim-client/frame/ice_looks.hpp"

#include <cmath>

#include <glm/common.hpp>

#include "engine/effects/ice/cracks.hpp"

namespace septet::frame {
namespace {

ice::Look wetted(ice::Look look, float film) {
  look.bump *= 1.0f - 0.6f * film;
  look.roughness *= 1.0f - film;
  return look;
}

}  // namespace

ice::Look slab_look(float film) {
  ice::Look look;
  look.mode = ice::Mode::quality;
  look.bump = 0.10f;
  look.bump_size_m = 0.16f;
  look.roughness = 0.4f;
  return wetted(look, film);
}

ice::Look icicle_look(float film) {
  ice::Look look;
  look.back_sign = ice::BackSign::as_a_lens;
  look.bump = 0.08f;
  look.bump_size_m = 0.04f;
  look.roughness = 0.15f;
  return wetted(look, film);
}

ice::Look sheet_look(float film) {
  ice::Look look;
  look.thin = true;
  look.bump = 0.015f;
  look.bump_size_m = 0.6f;
  look.roughness = 0.06f;
  return wetted(look, film);
}

std::vector<ice::IceVertex> cracks_between(std::span<const Vec3> rest_m, float cell_m) {
  std::vector<ice::IceVertex> inside;
  if (rest_m.empty()) return inside;
  Vec3 low(INFINITY), high(-INFINITY);
  for (const Vec3& place : rest_m) low = glm::min(low, place), high = glm::max(high, place);
  // About a third of the cracks hold air, which makes such ice milky.
  const auto cracks = ice::cracks_in({glm::vec3(low), glm::vec3(high)}, cell_m);
  for (const bool airy : {false, true})
    for (const ice::Crack& crack : cracks)
      if (airy == (crack.seed < 0.35f))
        ice::append_crack(inside, crack, airy ? ice::InsideKind::air : ice::InsideKind::crack, 3);
  return inside;
}

}  // namespace septet::frame
