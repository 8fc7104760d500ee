#pragma once
/// Conversion of a signal's physical value to and from the bits of a frame, in its DBC file's layout.
///
/// The signal comes from `read_dbc`, so that it lies within a message's bytes; shorter data hold no value. Values
/// beyond the bits' range, or the file's own if given, are clamped; NaN becomes the value nearest to 0. Whole signals
/// round to the nearest, ties to even. Beyond 53 bits a double loses the lowest ones.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "car-io/can/dbc.hpp"

namespace septet::car_io::dbc {

/// Empty if the data are too short, or if the frame carries another multiplexed signal in its place.
std::optional<double> decode(const Message& message, const Signal& signal, std::span<const std::byte> data);
void encode(const Signal& signal, double physical, std::span<std::byte> data);

/// The first two signals of a message that share a bit and can be in one frame, or empty.
std::optional<std::pair<const Signal*, const Signal*>> overlap(const Message& message);

}  // namespace septet::car_io::dbc
