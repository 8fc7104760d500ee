#pragma once
/// The palette of body colours that `Participant::paint` indexes, linear Rec. 709.

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace septet {

/// White, silver, greys, black, blues, reds, green, beige, yellow: about as frequent as on northern roads.
inline constexpr std::array<glm::vec3, 12> body_colors{{
    {0.80f, 0.80f, 0.79f},
    {0.50f, 0.51f, 0.53f},
    {0.19f, 0.20f, 0.21f},
    {0.022f, 0.023f, 0.026f},
    {0.05f, 0.11f, 0.30f},
    {0.34f, 0.022f, 0.026f},
    {0.085f, 0.095f, 0.11f},
    {0.02f, 0.045f, 0.12f},
    {0.72f, 0.70f, 0.62f},
    {0.05f, 0.14f, 0.09f},
    {0.42f, 0.30f, 0.17f},
    {0.80f, 0.55f, 0.03f},
}};

inline glm::vec3 body_color(std::uint8_t paint) { return body_colors[paint % body_colors.size()]; }

}  // namespace septet
