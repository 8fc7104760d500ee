#pragma once
/// Pairs of bodies whose impact was worked out elsewhere, by hand and by another program: masses, arms and motion in,
/// motion out to the last digit given. Bodies stand so that the contact is at the world's origin.

#include <array>
#include <cstdint>
#include <numbers>

#include "engine/physics/impact/impulse.hpp"

namespace septet::impact {

inline constexpr std::uint64_t seed = 20261127;  ///< Of all random trials of impacts.

struct WorkedPair {
  const char* name;
  Body first, second;
  double normal_deg;
  Rule rule;
  bool sticks;
  Vec2 first_velocity_mps, second_velocity_mps;  ///< After.
  double first_yaw_radps, second_yaw_radps;
  double normal_ns, tangential_ns, loss_j;

  Place place() const {
    const double angle = normal_deg * std::numbers::pi / 180.0;
    return {Vec2(0.0), Vec2(std::cos(angle), std::sin(angle))};
  }
};

inline Vec2 polar(double length, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  return length * Vec2(std::cos(angle), std::sin(angle));
}

inline Body body_at(double mass_kg, double inertia_kgm2, const Vec2& arm_m, const Vec2& velocity_mps,
                    double yaw = 0.0) {
  return {mass_kg, inertia_kgm2, -arm_m, velocity_mps, yaw};
}

inline std::array<WorkedPair, 8> worked_pairs() {
  const double g = 20.0 * std::numbers::pi / 180.0;
  const Vec2 wall_arm(1.75 * std::cos(g) - 0.75 * std::sin(g), 1.75 * std::sin(g) + 0.75 * std::cos(g));
  const Body fast{};
  return {{
      {"A, rear-end",
       body_at(1500, 2500, {2, 0}, {20, 0}),
       body_at(1200, 1900, {-1.9, 0}, {10, 0}),
       0,
       {.15, .6},
       true,
       {14.888889, 0},
       {16.388889, 0},
       0,
       0,
       7666.667,
       0,
       32583.333},
      {"B, into the side behind the mass centre",
       body_at(1500, 2500, {2, 0}, {15, 0}),
       body_at(1200, 1900, {-.8, -1}, {0, 12}),
       0,
       {.10, .6},
       true,
       {9.975572, 1.944940},
       {6.280535, 9.568825},
       2.333928,
       5.195037,
       7536.642,
       -2917.410,
       66626.347},
      {"C, offset head-on",
       body_at(1500, 2500, {1.9, .6}, {15, 0}),
       body_at(1800, 3200, {-2, -.7}, {-15, 0}),
       0,
       {.05, .5},
       true,
       {-.963609, -3.642154},
       {-1.696993, 3.035128},
       1.594844,
       1.823540,
       23945.413,
       5463.231,
       341222.137},
      {"D, sideswipe",
       body_at(1500, 2500, {1.6, .9}, {25, 1.5}),
       body_at(1500, 2500, {-1.2, -.9}, {15, 0}),
       90,
       {.20, .3},
       false,
       {24.863166, 1.043888},
       {15.136834, .456112},
       -.363977,
       -.254510,
       684.168,
       -205.250,
       2492.044},
      {"E, lorry on the rear quarter",
       body_at(18000, 110000, {3.5, .9}, {22, 2}),
       body_at(1300, 2000, {-1.7, -.75}, {20, 0}),
       80,
       {.10, .4},
       false,
       {21.954802, 1.927107},
       {20.625822, 1.009292},
       -.035092,
       -.810180,
       1433.421,
       -573.369,
       2544.261},
      {"F, oblique, both turning",
       body_at(1400, 2200, {1.8, -.4}, polar(16, 30), .2),
       body_at(1600, 2700, {-1.5, .5}, {-10, 0}, -.1),
       15,
       {.12, .55},
       true,
       {1.024023, 8.328155},
       {1.228336, -.287136},
       -2.690538,
       -3.171682,
       17234.277,
       -5093.535,
       187156.429},
      {"G, wall",
       body_at(900, 1300, wall_arm, polar(100 / 3.6, 20)),
       fast,
       90,
       {.15, .2},
       false,
       {25.053641, 4.255899},
       {0, 0},
       -4.093084,
       0,
       4720.194,
       -944.039,
       45723.637},
      {"H, pole beside the middle",
       body_at(1500, 2500, {2, .5}, {12, 0}),
       fast,
       0,
       {.05, .6},
       true,
       {-.067606, -2.129577},
       {0, 0},
       1.064789,
       0,
       18101.408,
       3194.366,
       103178.028},
  }};
}

}  // namespace septet::impact
