#pragma once
/// Speeds as people are told them; everything else is in metres a second.

namespace septet {

inline constexpr double kmh_per_mps = 3.6;

}  // namespace septet
