#pragma once
/// Smoke on the wire and between keyframes. The format is written down in SMOKE.md.
///
/// Particles go in chunks by their numbers, `chunk_slots` to each; a chunk is one EffectKeyframe, renewed every
/// `keyframe_ticks` ticks, each chunk on a tick of its own, so that the load is even. A keyframe holds each particle's
/// place at the chunk's last keyframe and now; a screen draws the path between them during the time until the next. The
/// picture is therefore one renewal late, without a jump, and needs no other keyframe.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/effects/smoke/smoke_state.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::smoke {

inline constexpr std::uint16_t keyframe_kind = 1;
/// Effect ids: a base plus the number of the chunk.
inline constexpr std::uint32_t first_effect_id = 0x01000000, max_chunks = 1 << 16;
inline constexpr std::size_t chunk_slots = 512;
inline constexpr std::uint64_t keyframe_ticks = 30;
/// Coordinates on the wire are multiples of a cell over this; the error of one is at most half of it.
inline constexpr int steps_per_cell = 8;

/// The encoder's memory between ticks: it belongs to the server's state, and follows wholly from the smoke's history.
struct KeyframeTrack {
  struct Chunk {
    double time_s = 0.0;
    std::vector<std::array<std::int32_t, 3>> place;  ///< Place of each slot, quantised.
    std::vector<std::uint8_t> known;                 ///< 1 where the slot's particle was in the last keyframe.
    Bytes data;                                      ///< Empty where no particle is alive.
  };
  /// Distinguishes several smokes of a world: each numbers its chunks from its own first.
  std::uint32_t first_chunk = 0;
  std::vector<Chunk> chunks;
};

/// Call once a tick, after advance_smoke: all smoke of this instant, ascending id, ready for a snapshot.
std::vector<EffectKeyframe> advance_keyframes(KeyframeTrack& track, const State& state);

/// One chunk on a screen.
struct Keyframe {
  struct Look {
    std::array<float, 3> albedo{};
    float extinction_area_m2 = 0.0f;
    float glow = 0.0f;
    float lifetime_s = 0.0f;  ///< 0: it does not thin out.
  };
  struct Particle {
    std::uint16_t slot = 0;  ///< Within the chunk.
    std::uint8_t look = 0;
    bool newborn = false;            ///< Since the last keyframe: fades in.
    float age_s = 0.0f;              ///< At `time_s`; steps of lifetime/255, or of a quarter second up to 64 s.
    glm::vec3 from{0.0f}, to{0.0f};  ///< Grid coordinates, cells.
    std::uint16_t births = 1;        ///< Times its look's cross-section.
  };
  RigidTransform world_from_grid;
  float cell_m = 0.5f;
  double time_s = 0.0;      ///< Time at which `to` was taken and `from` is shown.
  float duration_s = 0.0f;  ///< Time after which `to` is shown.
  std::uint32_t chunk = 0;
  std::vector<Look> looks;
  std::vector<Particle> particles;
};

/// Error: bytes that the encoder would not write; safe on hostile bytes.
Expected<Keyframe> decode(std::span<const std::byte> bytes);

/// One puff to draw: a ball of smoke whose density falls off as a Gaussian.
struct Puff {
  Vec3 position_m{0.0};
  float radius_m = 0.5f;            ///< Standard deviation of the density.
  float extinction_area_m2 = 0.0f;  ///< Optical depth through its middle is this over 2π radius².
  glm::vec3 albedo{0.25f};
  float glow = 0.0f;       ///< Glow of the flame, 1 at birth.
  std::uint32_t seed = 0;  ///< Constant for the particle: turns its texture.
};

/// Appends the puffs of a keyframe as they stand at a simulated time (clamped to the keyframe's span).
void add_puffs(const Keyframe& keyframe, double time_s, std::vector<Puff>& puffs);

}  // namespace septet::smoke
