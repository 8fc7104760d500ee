#pragma once
/// A four-stroke engine as the sum of its orders.
///
/// Order o turns o times with the crank. Each of N cylinders fires once in two turns, so the firing order is N/2 and
/// its multiples are loudest: 3, 6, 9 of a six (100 Hz at 2000 turns a minute), 2.5, 5 of a five, 2, 4 of a four.
/// Between them lie those of unequal cylinders; a five rocks with orders 1 and 2. With load they are louder and fall
/// off by 6 instead of 12 dB an octave; on the overrun there is no combustion. The exhaust is a pipe, closed at the
/// engine and open behind. Pure functions.

#include "engine/audio/harmonics.hpp"

namespace septet::audio {

struct EngineOrders {
  Harmonics front{}, rear{};  ///< Harmonics of half the crank's frequency: harmonic h (from 1) is order h/2.
};

/// `gain`: 0 for a standing engine to 1.
EngineOrders engine_orders(int cylinders, double engine_hz, double load, double fuel_cut, double gain);

}  // namespace septet::audio
