#include "sim-server/attendants/guidance_voice.hpp"

#include "engine/world/guidance.hpp"
#include "engine/world/guidance_words.hpp"

namespace septet::server {

void GuidanceVoice::before_tick(const Moment& /*moment*/) {
  if (auto trouble = speaker_.attend()) messages_.push_back(std::move(*trouble));
}

void GuidanceVoice::after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double /*shaking_share*/) {
  const auto guidance = guidance_of(tick->snapshot());
  if (!guidance || guidance->told_count == told_) return;
  told_ = guidance->told_count;
  if (speaker_.is_there()) return speaker_.say(guidance_sentence(guidance->told, language_), language_);
  if (!std::exchange(has_said_silent_, true))
    messages_.emplace_back("espeak-ng is not installed: the way is told on the instruments alone");
}

}  // namespace septet::server
