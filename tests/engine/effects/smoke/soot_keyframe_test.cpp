#include "engine/effects/smoke/soot_keyframe.hpp"

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "smoke_fixtures.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

/// A tunnel whose walls got soot in a stretch, as a fire's draught would leave it.
State sooty_tunnel() {
  State state = tunnel_fire(1, 100);
  Random random(3);
  for (std::size_t n = 0; n < state.soot.size(); ++n) {
    const int i = static_cast<int>(state.beside_wall[n]) % state.grid.nx;
    if (i >= 30 && i < 90) state.soot[n] = static_cast<float>(0.9 * random.uniform() + 0.05);
  }
  return state;
}

}  // namespace

TEST_CASE("a soot keyframe gives back every cell within half a level in its place") {
  const State state = sooty_tunnel();
  const Bytes bytes = encode_soot(state);
  REQUIRE(!bytes.empty());
  const auto keyframe = decode_soot(bytes);
  REQUIRE(keyframe);
  CHECK(keyframe->nx == 60);
  std::size_t found = 0;
  for (std::size_t n = 0; n < state.soot.size(); ++n) {
    const int cell = static_cast<int>(state.beside_wall[n]);
    const Vec3 middle(cell % state.grid.nx + 0.5, cell / state.grid.nx % state.grid.ny + 0.5,
                      cell / (state.grid.nx * state.grid.ny) + 0.5);
    const Vec3 at =
        inverse(keyframe->world_from_box) * state.grid.world_from_cells(middle) / static_cast<double>(keyframe->cell_m);
    const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y)),
              k = static_cast<int>(std::floor(at.z));
    const bool inside = i >= 0 && j >= 0 && k >= 0 && i < keyframe->nx && j < keyframe->ny && k < keyframe->nz;
    const int level = inside ? keyframe->level[static_cast<std::size_t>((k * keyframe->ny + j) * keyframe->nx + i)] : 0;
    REQUIRE(std::abs(std::sqrt(soot_of(static_cast<std::uint8_t>(level))) - std::sqrt(state.soot[n])) <=
            0.5f / (soot_levels - 1) + 1e-5f);
    if (level > 0) ++found;
  }
  CHECK(found > 500);
}

TEST_CASE("walls without soot are not sent") { CHECK(encode_soot(tunnel_fire(1, 100)).empty()); }

TEST_CASE("a soot keyframe that was cut or changed is refused or stays within bounds") {
  const Bytes bytes = encode_soot(sooty_tunnel());
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    CHECK_FALSE(decode_soot(std::span(bytes).first(length)));
  Random random(9);
  for (int n = 0; n < 2000; ++n) {
    Bytes changed = bytes;
    changed[static_cast<std::size_t>(random.uniform() * static_cast<double>(changed.size()))] =
        static_cast<std::byte>(random.uniform() * 256.0);
    const auto keyframe = decode_soot(changed);
    if (!keyframe) continue;
    REQUIRE(keyframe->level.size() == static_cast<std::size_t>(keyframe->nx) * keyframe->ny * keyframe->nz);
    REQUIRE(keyframe->level.size() <= max_soot_cells);
  }
}
