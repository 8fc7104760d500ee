#pragma once
/// Contents of accessors: rows of numbers in a buffer (glTF 2.0, 3.6.2), with those of a sparse part written over them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// `width` numbers a row, row after row; normalised integers as 0…1 or −1…1.
struct Rows {
  std::size_t count = 0, width = 0;
  std::vector<float> numbers;
};

/// Error: no such accessor, another width than one from `least_width` to `most_width`, an unknown type, more than
/// `most_rows`, rows beyond their view, a non-finite number.
Expected<Rows> read_rows(const Container& container, std::int64_t accessor, std::size_t least_width,
                         std::size_t most_width, std::size_t most_rows);

/// The indices of vertices, each below `vertices`. Error: as before, or one that is not below it.
Expected<std::vector<std::uint32_t>> read_indices(const Container& container, std::int64_t accessor,
                                                  std::size_t most_rows, std::size_t vertices);

}  // namespace septet::gltf
