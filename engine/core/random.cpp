#include "engine/core/random.hpp"

#include <bit>
#include <cmath>

#include "engine/core/check.hpp"

namespace septet {
namespace {
std::uint64_t split_mix(std::uint64_t& counter) {
  counter += 0x9e3779b97f4a7c15u;
  std::uint64_t z = counter;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t stream_counter = stream;
  std::uint64_t counter = seed ^ split_mix(stream_counter);
  for (auto& word : state_) word = split_mix(counter);
}

std::optional<Random> Random::from_state(const State& state) {
  if (state == State{}) return std::nullopt;
  Random random(0);
  random.state_ = state;
  return random;
}

std::uint64_t Random::next_bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(next_bits() >> 11) * 0x1.0p-53; }

double Random::normal() {
  // The second deviate of each pair is dropped, so that the state stays four words.
  while (true) {
    const double x = 2.0 * uniform() - 1.0;
    const double y = 2.0 * uniform() - 1.0;
    const double r2 = x * x + y * y;
    if (r2 > 0.0 && r2 < 1.0) return x * std::sqrt(-2.0 * std::log(r2) / r2);
  }
}

std::uint64_t Random::below(std::uint64_t count) {
  SEPTET_CHECK(count > 0, "count {}", count);
  // Rejection keeps every value equally likely.
  const std::uint64_t threshold = (0 - count) % count;
  while (true) {
    const std::uint64_t bits = next_bits();
    if (bits >= threshold) return bits % count;
  }
}

}  // namespace septet
