#pragma once
/// What the driver is told, in words, as a driving instructor says it; and its arrow.

#include <string>
#include <string_view>

#include "engine/world/guidance.hpp"

namespace septet {

/// A sentence. `language`: "en", "de", "sv"; any other: English.
std::string guidance_sentence(const GuidanceWord& word, std::string_view language);

/// The next turn and its distance for the instruments: "◀ 120 m".
std::string guidance_arrow(const Guidance& guidance);

}  // namespace septet
