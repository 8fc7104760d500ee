#pragma once
/// Random numbers as an argument: xoshiro256++ (Blackman and Vigna 2019), seeded through SplitMix64.
///
/// The same seed gives the same sequence on every machine. A model that needs several independent streams takes one
/// `Random` per stream, made with `Random(seed, stream)`. Not safe to share between threads.

#include <array>
#include <cstdint>
#include <optional>

namespace septet {

class Random {
 public:
  using State = std::array<std::uint64_t, 4>;

  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  /// Continues from a saved state. Empty for the one state that no seed leads to, all zeros, in which every number
  /// would be zero.
  static std::optional<Random> from_state(const State& state);

  std::uint64_t next_bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal deviate (Marsaglia's polar method).
  double normal();
  /// Uniform integer in [0, count); count must be at least 1.
  std::uint64_t below(std::uint64_t count);

  /// The whole state, so that it can be hashed, stored and restored.
  const State& state() const { return state_; }

 private:
  State state_;
};

}  // namespace septet
