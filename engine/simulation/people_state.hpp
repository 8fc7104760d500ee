#pragma once
/// People of a swarm as a part of a drive's state: plain data. The stage: people_stage.hpp.

#include "engine/traffic/people/people.hpp"
#include "engine/world/people.hpp"

namespace septet::simulation {

struct PeopleOfDrive {
  PeopleWish wish;             ///< As it was told last.
  traffic::PeopleState swarm;  ///< Without those who were thrown.

  bool empty() const { return swarm.people.empty(); }
};

}  // namespace septet::simulation
