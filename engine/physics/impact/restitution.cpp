#include "engine/physics/impact/restitution.hpp"

#include <algorithm>
#include <cmath>

namespace septet::impact {
namespace {

struct Restitution {
  double least, slow, fall_mps;
};
struct Vehicles {
  double friction, corner_m;
};
struct Posts {
  double stiffness_share;
};
struct Entries {
  Restitution restitution;
  Vehicles vehicles;
  Posts posts;
};

constexpr Entries entries() {
  Entries all{};
#define SEPTET_ENTRY(name, ...) all.name = __VA_ARGS__;
#include "engine/physics/impact/impact.toml.inc"
  return all;
}

}  // namespace

double restitution(double closing_mps) {
  constexpr Restitution r = entries().restitution;
  return r.least + (r.slow - r.least) * std::exp(-std::max(0.0, closing_mps) / r.fall_mps);
}

double vehicle_friction() { return entries().vehicles.friction; }
double vehicle_corner_m() { return entries().vehicles.corner_m; }
double post_stiffness_share() { return entries().posts.stiffness_share; }

}  // namespace septet::impact
