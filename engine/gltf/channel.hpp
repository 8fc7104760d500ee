#pragma once
/// Channels of animations: numbers by time (glTF 2.0, 3.11 and appendix C).

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/core/expected.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

struct Channel {
  enum class Interpolation : std::uint8_t { linear, step, cubic };
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;  ///< Rising, from 0 on.
  Rows values;                 ///< One row a time; of a cubic one three: the slope before, the value, the slope behind.
};

/// A row of the file has `width` numbers; `joined` of them are one of the channel. Error: no such accessor, other rows
/// than times, times that do not rise, more than 10,000 of them.
Expected<Channel> read_channel(const Container& container, const Json& sampler, std::size_t width, std::size_t joined,
                               const std::string& where);

/// Row of a value by its time, and what it counts.
struct WeightedRow {
  std::size_t row;
  float factor;
};

/// Rows whose sum is the value at a time, where nothing turns; `before`: just before it. Outside of its times that of
/// the nearest (3.11).
std::vector<WeightedRow> rows_at(const Channel& channel, double time_s, bool before);

/// The value at a time, of a channel with at most four numbers a row; `is_turn`: unit quaternions, x first.
glm::vec4 value_at(const Channel& channel, double time_s, bool before, bool is_turn);

}  // namespace septet::gltf
