/// What crashes do with energy.

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/effects/debris/energy_ledger.hpp"
#include "tests/engine/effects/debris/ledger_scenes.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// What a scene's energy came to.
struct Followed {
  StoredEnergy start, end;
  EnergyLedger ledger;
  double open_share = 0.0;  ///< Greatest unexplained energy at the end of a tick, of all that had passed by then.
  /// How far the losses fell behind their highest: energy that soft gaps gave back, or a step made.
  double most_returned_j = 0.0;
  double passed_j() const { return debris::passed_j(start, end, ledger); }
};

Followed follow(Scene& scene) {
  constexpr double tick_s = 1.0 / 60.0;
  Followed followed;
  followed.start = followed.end = stored_energy(scene.state);
  EnergyLedger& ledger = followed.ledger;
  double highest_j = 0.0;
  for (int k = 0; k * tick_s < scene.seconds; ++k) {
    advance(scene, k * tick_s, tick_s, &ledger);
    followed.end = stored_energy(scene.state);
    const double open_j = std::abs(unexplained_j(followed.start, followed.end, ledger));
    if (open_j > 1e-6) followed.open_share = std::max(followed.open_share, open_j / followed.passed_j());
    highest_j = std::max(highest_j, ledger.lost_j());
    followed.most_returned_j = std::max(followed.most_returned_j, highest_j - ledger.lost_j());
  }
  return followed;
}

}  // namespace

TEST_CASE("the energy of twelve crashes is explained to half a thousandth and no step makes any") {
  for (Scene& scene : scenes::all()) {
    const Followed followed = follow(scene);
    const EnergyLedger& ledger = followed.ledger;
    const double passed_j = followed.passed_j();
    INFO(scene.name << ": " << passed_j << " J passed, returned " << followed.most_returned_j << "; lost by pressing "
                    << ledger.pressing_loss_j << ", friction " << ledger.friction_loss_j << ", meeting "
                    << ledger.meeting_loss_j << ", rubbing " << ledger.rubbing_loss_j << ", flow "
                    << ledger.plastic_loss_j << ", cracks " << ledger.fracture_loss_j << ", beta "
                    << ledger.viscous_loss_j << ", step " << ledger.numerical_loss_j << ", bound "
                    << ledger.bound_loss_j << ", settling " << ledger.settling_loss_j << ", stiffening "
                    << ledger.stiffening_loss_j << "; air " << ledger.air_work_j << ", boxes " << ledger.box_work_j);
    CHECK(passed_j > 50.0);
    CHECK(followed.open_share < 0.0005);
    CHECK(followed.most_returned_j < 0.005 * passed_j);
    // Whatever one of them makes another one takes.
    CHECK(ledger.numerical_loss_j + ledger.viscous_loss_j + ledger.bound_loss_j > 0.0);
    CHECK(ledger.pressing_loss_j > 0.0);
    for (const double loss_j : {ledger.friction_loss_j, ledger.rubbing_loss_j, ledger.plastic_loss_j,
                                ledger.fracture_loss_j, ledger.viscous_loss_j, ledger.bound_loss_j,
                                ledger.settling_loss_j, ledger.stiffening_loss_j, ledger.lost_j()})
      CHECK(loss_j >= 0.0);
  }
}

TEST_CASE("a ledger closes where two cars that cannot yield press on each other through a piece") {
  Scene scene = scenes::between_two_cars();
  const Followed followed = follow(scene);
  CHECK(followed.ledger.box_work_j > 1e6);  // Which they give each other: the step takes only a share of it.
  CHECK(followed.ledger.bound_loss_j > 0.0);
  CHECK(followed.open_share < 1e-5);
}
