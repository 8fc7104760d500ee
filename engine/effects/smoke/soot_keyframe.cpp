#include "engine/effects/smoke/soot_keyframe.hpp"

#include <algorithm>
#include <cmath>

namespace septet::smoke {
namespace {

constexpr std::uint8_t soot_version = 1;

std::uint8_t level_of(float soot) {
  return static_cast<std::uint8_t>(std::lround(std::sqrt(std::min(soot, 1.0f)) * (soot_levels - 1)));
}

/// The box of all cells with soot; empty (high below low) where there is none.
struct CellBox {
  std::array<int, 3> low{max_cells_along, max_cells_along, max_cells_along}, high{-1, -1, -1};
  void add(const std::array<int, 3>& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  }
  int size(std::size_t axis) const { return high[axis] - low[axis] + 1; }
};

std::array<int, 3> place_of(const Grid& grid, std::uint32_t cell) {
  const int at = static_cast<int>(cell);
  return {at % grid.nx, at / grid.nx % grid.ny, at / (grid.nx * grid.ny)};
}

void put_runs(ByteWriter& writer, std::span<const std::uint8_t> level) {
  for (std::size_t begin = 0, end; begin < level.size(); begin = end) {
    end = begin;
    while (end < level.size() && level[end] == level[begin]) ++end;
    writer.put_varint((end - begin) * soot_levels + level[begin]);
  }
}

tl::unexpected<Error> refuse_soot(const char* what) {
  return failure(what, "soot keyframe", "send what the same version of Septet wrote");
}

}  // namespace

Bytes encode_soot(const State& state) {
  const Grid& grid = state.grid;
  CellBox box;
  for (std::size_t n = 0; n < state.soot.size(); ++n)
    if (level_of(state.soot[n]) > 0) box.add(place_of(grid, state.beside_wall[n]));
  if (box.high[0] < 0) return {};
  const std::size_t cells = static_cast<std::size_t>(box.size(0)) * box.size(1) * box.size(2);
  if (cells > max_soot_cells) return {};
  std::vector<std::uint8_t> level(cells, 0);
  for (std::size_t n = 0; n < state.soot.size(); ++n) {
    const std::uint8_t value = level_of(state.soot[n]);
    if (value == 0) continue;
    const auto [i, j, k] = place_of(grid, state.beside_wall[n]);
    level[(static_cast<std::size_t>(k - box.low[2]) * box.size(1) + (j - box.low[1])) * box.size(0) +
          (i - box.low[0])] = value;
  }
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.put(soot_version);
  const Vec3 corner = grid.world_from_cells(Vec3(box.low[0], box.low[1], box.low[2]));
  for (int c = 0; c < 3; ++c) writer.put(corner[c]);
  const Quat& q = grid.world_from_grid.orientation;
  for (const double part : {q.w, q.x, q.y, q.z}) writer.put(part);
  writer.put(static_cast<float>(grid.cell_m));
  for (std::size_t axis = 0; axis < 3; ++axis) writer.put_varint(static_cast<std::uint64_t>(box.size(axis)));
  put_runs(writer, level);
  return bytes.size() <= max_soot_bytes ? bytes : Bytes{};
}

Expected<SootKeyframe> decode_soot(std::span<const std::byte> bytes) {
  if (bytes.size() > max_soot_bytes) return refuse_soot("too long");
  ByteReader reader(bytes);
  if (reader.get<std::uint8_t>() != soot_version) return refuse_soot("unknown version");
  SootKeyframe keyframe;
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  bool good = true;
  for (int c = 0; c < 3; ++c) {
    keyframe.world_from_box.position_m[c] = reader.get_double();
    good = good && within(keyframe.world_from_box.position_m[c], -1e7, 1e7);
  }
  Quat& q = keyframe.world_from_box.orientation;
  for (double* part : {&q.w, &q.x, &q.y, &q.z}) *part = reader.get_double();
  keyframe.cell_m = reader.get_float();
  good = good && within(glm::length(q), 0.999, 1.001) && within(keyframe.cell_m, 1e-3, 1e3);
  for (int* size : {&keyframe.nx, &keyframe.ny, &keyframe.nz})
    *size = static_cast<int>(reader.get_count(max_cells_along));
  const std::int64_t cells = std::int64_t{keyframe.nx} * keyframe.ny * keyframe.nz;
  if (!reader.ok() || !good || cells < 1 || cells > static_cast<std::int64_t>(max_soot_cells))
    return refuse_soot("header out of bounds");
  while (!reader.at_end()) {
    const std::uint64_t run = reader.get_varint(), length = run / soot_levels;
    if (!reader.ok() || length == 0 || length > static_cast<std::uint64_t>(cells) - keyframe.level.size())
      return refuse_soot("run out of bounds");
    keyframe.level.insert(keyframe.level.end(), static_cast<std::size_t>(length),
                          static_cast<std::uint8_t>(run % soot_levels));
  }
  if (keyframe.level.size() != static_cast<std::size_t>(cells)) return refuse_soot("length does not fit");
  return keyframe;
}

}  // namespace septet::smoke
