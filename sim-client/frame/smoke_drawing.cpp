#include "sim-client/frame/smoke_drawing.hpp"

namespace septet::frame {

std::vector<instant::SmokePuff> SmokeDrawing::draw(std::span<const EffectKeyframe> effects, double simulated_time_s) {
  std::vector<smoke::Puff> puffs;
  for (auto& [id, entry] : decoded_) entry.used = false;
  for (const EffectKeyframe& effect : effects) {
    if (effect.kind != smoke::keyframe_kind) continue;
    const auto [found, fresh] = decoded_.try_emplace(effect.id);
    Decoded& entry = found->second;
    entry.used = true;
    if (fresh || entry.tick != effect.tick) {
      entry.tick = effect.tick;
      auto keyframe = smoke::decode(effect.data);
      entry.readable = keyframe.has_value();
      if (entry.readable) entry.keyframe = std::move(*keyframe);
    }
    if (entry.readable) smoke::add_puffs(entry.keyframe, simulated_time_s, puffs);
  }
  std::erase_if(decoded_, [](const auto& entry) { return !entry.second.used; });
  std::vector<instant::SmokePuff> drawn;
  drawn.reserve(puffs.size());
  for (const smoke::Puff& puff : puffs)
    drawn.push_back({puff.position_m, puff.radius_m, puff.extinction_area_m2, puff.albedo, puff.glow, puff.seed});
  return drawn;
}

}  // namespace septet::frame
