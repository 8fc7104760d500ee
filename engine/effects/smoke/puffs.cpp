#include <algorithm>

#include "engine/effects/smoke/smoke_keyframe.hpp"

namespace septet::smoke {
namespace {

/// A puff is born half a cell wide and grows while it mixes with air.
float radius_cells(float age_s) { return 0.42f + 0.28f * std::min(1.0f, age_s / 6.0f); }

}  // namespace

void add_puffs(const Keyframe& keyframe, double time_s, std::vector<Puff>& puffs) {
  const float passed_s = std::clamp(static_cast<float>(time_s - keyframe.time_s), 0.0f, keyframe.duration_s);
  const float t = keyframe.duration_s > 0.0f ? passed_s / keyframe.duration_s : 1.0f;
  for (const Keyframe::Particle& particle : keyframe.particles) {
    const Keyframe::Look& look = keyframe.looks[particle.look];
    const float age_s = particle.age_s + passed_s;
    float area = look.extinction_area_m2 * static_cast<float>(particle.births) * (particle.newborn ? t : 1.0f);
    if (look.lifetime_s > 0.0f) area *= static_cast<float>(remaining_extinction(age_s / look.lifetime_s));
    if (area <= 0.0f) continue;
    Puff puff;
    puff.position_m = keyframe.world_from_grid * Vec3(glm::mix(particle.from, particle.to, t) * keyframe.cell_m);
    puff.radius_m = keyframe.cell_m * radius_cells(age_s);
    puff.extinction_area_m2 = area;
    puff.albedo = {look.albedo[0], look.albedo[1], look.albedo[2]};
    puff.glow = look.glow * std::max(0.0f, 1.0f - age_s / 2.0f);
    puff.seed = (keyframe.chunk * static_cast<std::uint32_t>(chunk_slots) + particle.slot) * 2654435761u;
    puffs.push_back(puff);
  }
}

}  // namespace septet::smoke
