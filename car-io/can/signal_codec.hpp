#pragma once
/// A signal's physical value into the bits of a frame and out of them, as its DBC file lays it out.
///
/// The signal comes from `read_dbc`, so that it lies within a message's bytes; data shorter than that hold nothing for it. Values that the
/// bits cannot hold are taken to the nearest that they can, and to the file's own range where it gives one; what is no number becomes the
/// value nearest to 0. Whole signals round to the nearest, ties to even. Beyond 53 bits a double loses the lowest ones.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "car-io/can/dbc.hpp"

namespace septet::car_io::dbc {

/// Nothing where the data are too short, or where the frame carries another multiplexed signal in its place.
std::optional<double> decode(const Message& message, const Signal& signal, std::span<const std::byte> data);
void encode(const Signal& signal, double physical, std::span<std::byte> data);

/// The two first signals of a message that share a bit and can be in one frame, or nothing.
std::optional<std::pair<const Signal*, const Signal*>> overlap(const Message& message);

}  // namespace septet::car_io::dbc
