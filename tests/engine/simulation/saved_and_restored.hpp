#pragma once
/// A drive's state through its file and back.

#include <utility>

#include <doctest/doctest.h>

#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/state.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {

/// Of a drive with Septet's own traffic.
inline State saved_and_restored(const Model& model, const State& state) {
  const auto bytes = save_state(model, state);
  REQUIRE(bytes.has_value());
  auto again = restore_state(model, traffic::own_traffic(model.roads, 1), *bytes, "test");
  REQUIRE_MESSAGE(again.has_value(), why_not(again));
  CHECK(hash_state(*again) == hash_state(state));
  return std::move(*again);
}

}  // namespace septet::simulation
