#pragma once
/// The paper's update, once per cell instead of once per particle.
///
/// All particles of a cell read the same 46 cells, so figure 1 is a convolution of the attraction with the pattern. It
/// is linear in the bias: the sum over the samples above is kept apart, and a particle adds it times its own bias. The
/// sums over the 3×3×3 block are made from sums along rows, then in layers. Equal to `mean_sample` but for rounding.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace septet::smoke {

struct State;

/// Cells of a row in the roof or the floor and their mirror images, in the padded attraction.
struct MirroredRun {
  std::ptrdiff_t from, to;
  int count;
};

/// Cross-section of a tube at one slice of cells: its floor and roof, in cells; none (0, 0) where it is blocked.
struct TubeSlice {
  float floor = 0.0f, roof = 0.0f, width = 0.0f;
};

/// One cell of the field: the velocity of a particle in it is (rest + bias·above), in multiples of `velocity_quantum`
/// cells/s. Small, because a tick's time goes into reading these.
struct CellVelocity {
  std::int16_t rest[3];
  std::int16_t crowding;  ///< max(0, ½ − f) of the cell itself, which the 46 samples do not see, in the same multiples.
  std::int16_t above[3];
  std::int16_t unused;
};
static_assert(sizeof(CellVelocity) == 16, "a particle's look-up is a quarter of a cache line");
inline constexpr float velocity_quantum = 1.0f / 256.0f;
/// Limit of one sum; larger ones are clamped.
inline constexpr float greatest_velocity = 127.0f;

/// Sums of the attraction over some cells around each of a layer: the differences along x and y, the sum, the sum of
/// magnitudes.
struct LayerSums {
  std::vector<float> along_x, along_y, sum, magnitude;
};

/// Memory of the convolution, kept so that a tick allocates nothing. Holds no state.
struct VelocityField {
  std::vector<CellVelocity> cells;  ///< Valid where a row of cells along x has a particle.
  std::vector<float> attraction;    ///< Padded by 3.
  LayerSums rows;                   ///< Over 3 cells along x; along_y is not used. Of one layer at a time.
  std::array<LayerSums, 3> layers;  ///< Over 3 × 3 cells; layer k is in place k mod 3.
  std::vector<std::uint8_t> row_used;
  std::vector<MirroredRun> mirrored;  ///< Cells in the roof and the floor.
  std::vector<TubeSlice> slices;
  std::vector<float> current;  ///< Along x in each layer of each slice, x fastest, in velocity_quantum.
};

/// Computes the field from State::density and State::full.
void update_velocity_field(const State& state, std::span<const float> table, VelocityField& field);

}  // namespace septet::smoke
