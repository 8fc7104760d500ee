#include "engine/effects/debris/debris_state.hpp"

#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

State::State() = default;
State::State(const State&) = default;
State::State(State&&) noexcept = default;
State& State::operator=(const State&) = default;
State& State::operator=(State&&) noexcept = default;
State::~State() = default;

}  // namespace septet::debris
