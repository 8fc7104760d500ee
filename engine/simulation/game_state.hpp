#pragma once
/// State of a game (game.hpp).

#include "engine/core/random.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct GameState {
  GameStanding standing;
  double next_move_s = 0.0;  ///< Time at which the leader next considers another lane, in seconds survived.
  Random random{1};
};

}  // namespace septet::simulation
