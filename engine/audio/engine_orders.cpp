#include "engine/audio/engine_orders.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/audio/levels.hpp"

namespace septet::audio {
namespace {

constexpr double unequal_db = -16.0, rocking_db = -12.0;
constexpr int multiples = 8;
constexpr double pipe_m = 2.0, gas_mps = 521.0, reflected = 0.5;  // Sound in gas of 700 K.

/// A pipe closed here and open there: louder where its length is an odd number of quarter waves.
double pipe_gain(double frequency_hz) {
  const double angle = 2.0 * std::numbers::pi * frequency_hz * 2.0 * pipe_m / gas_mps;
  return std::sqrt(1.0 - reflected * reflected) / std::abs(1.0 + reflected * std::polar(1.0, -angle));
}

}  // namespace

EngineOrders engine_orders(int cylinders, double engine_hz, double load, double fuel_cut, double gain) {
  EngineOrders orders;
  const int firing = std::clamp(cylinders, 1, 16);
  const double burning = pressure_pa(firing_order_db(engine_hz, load, false));
  const double pumping = pressure_pa(firing_order_db(engine_hz, load, true));
  const double peak = std::numbers::sqrt2 * gain * (burning + (pumping - burning) * fuel_cut);
  const double slope = 2.0 - load;
  const auto add = [&](int harmonic, double pressure) {
    if (harmonic < 1 || harmonic > static_cast<int>(most_harmonics)) return;
    const double hz = 0.5 * engine_hz * harmonic;
    const auto h = static_cast<std::size_t>(harmonic - 1);
    orders.front[h] += static_cast<float>(0.65 * pressure);
    orders.rear[h] += static_cast<float>(0.35 * pressure * pipe_gain(hz));
  };
  for (int n = 1; n <= multiples; ++n) add(firing * n, peak * std::pow(n, -slope));
  const double unequal = peak * std::pow(10.0, unequal_db / 20.0), rocking = peak * std::pow(10.0, rocking_db / 20.0);
  if (firing % 2 == 0) {
    add(firing / 2, unequal);
    add(firing * 3 / 2, unequal);
  } else {
    add(2, rocking);
    add(4, rocking);
    add(1, unequal);
    add(3, unequal);
  }
  return orders;
}

}  // namespace septet::audio
