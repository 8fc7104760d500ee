#pragma once
/// Smoke as particles that read the density of the cells around them.
///
/// Source: Gustavsson, Engström and Gustavsson, "A multi-sampling approach for smoke behavior in real-time graphics"
/// (SIGRAD 2006): a particle is drawn to thin cells and pushed from dense ones, 46 samples in three shells around it,
/// with a bias to the samples above while it is hot. SMOKE.md lists our additions and their reasons.
///
/// `advance_smoke` is the tick. State is plain data; the same state, air, obstacles and step give the same smoke, on
/// every machine. One thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/hash.hpp"
#include "engine/effects/smoke/smoke_grid.hpp"
#include "engine/effects/smoke/velocity_field.hpp"

namespace septet::smoke {

inline constexpr std::size_t max_emitters = 16;
inline constexpr std::size_t max_particles = 1'000'000;
inline constexpr std::uint64_t extinction_ticks = 4;
inline constexpr double full_layer_depth = 3.9;  ///< Optical depth of a full layer of soot, m² on a m² of wall.

struct Parameters {
  double steepness = 1.0;           ///< k of the logistic function of the density.
  double crowd = 5.0;               ///< Particles in a cell from which it repels.
  double speed_cells_per_s = 20.0;  ///< Speed of a particle whose mean sample vector (figure 1) is one cell long.
  /// Random walk out of crowded cells: the steps of a second along an axis add up to this standard deviation for each ½
  /// by which the cell's attraction is below ½.
  double jitter_cells = 2.4;
  std::uint16_t most_in_cell = 12;  ///< Limit of particles in a cell.
  double deposition_mps = 0.0003;   ///< Of soot to walls: 0.1 to 0.5 mm/s by thermophoresis at 50 to 100 K.
  bool roof_mirrors = false;  ///< Samples in roof and floor read their mirror images in the air (mirrored_height).
  double froude = 1.7;  ///< Speed of a warm layer over √(g′h(1 − h/H)); fitted to Li's layers (ceiling.hpp).
  double warmth_loss_s = 110.0;  ///< Time in which smoke loses all but 1/e of its warmth to the roof; fitted likewise.
};

/// A source of smoke. The scenario moves it and sets its rate; 0 stops it.
struct Emitter {
  Vec3 position_m{0.0};   ///< World frame.
  double radius_m = 0.5;  ///< Particles are born anywhere within.
  double rate_per_s = 0.0;
  double heat = 0.5;         ///< Excess of the bias of the samples above a newborn particle; 0 is cold.
  double cooling_s = 10.0;   ///< Time within which the heat falls to zero, and then at the same rate to −sinking.
  double sinking = 0.0;      ///< What the bias of a cold particle lacks: it falls.
  double warmth_j = 0.0;     ///< Heat of a newborn particle's gas above that of the air: drives the layer under a roof.
  double lifetime_s = 60.0;  ///< Time after which a particle has thinned out; 0: it stays for ever.
  std::array<float, 3> albedo{0.25f, 0.24f, 0.23f};  ///< Linear Rec. 709: of the light it scatters.
  double extinction_area_m2 = 0.25;  ///< Cross-section of one particle: density per m³ times this is extinction per m.
  double glow = 0.0;                 ///< 0 to 1: brightness of a newborn particle, of the flame that it left.
  double owed = 0.0;                 ///< Part of a particle not yet born.
};

/// A vehicle or another box that smoke goes around.
struct Obstacle {
  RigidTransform world_from_box;  ///< Origin at the centre.
  Vec3 half_size_m{1.0};
};

/// Particles in grid coordinates, in the order of their cells as of the last sorting: neighbours in space are
/// neighbours in memory. A particle keeps its number until it dies, so that a screen can follow it.
struct Particles {
  std::vector<float> x, y, z, age_s;
  std::vector<std::uint8_t> emitter;  ///< Index of the emitter it came from.
  std::vector<std::uint16_t> births;  ///< Births that it stands for: more than one where particles were joined.
  std::vector<std::uint32_t> number;
  std::vector<std::uint32_t> free_numbers;  ///< The last one is used first.
  std::uint32_t numbers = 0;                ///< All those ever used are below.

  std::size_t size() const { return x.size(); }
};

/// Warmth of the smoke in the slices across a tube, whose axis is the grid's x.
struct Warmth {
  std::vector<float> slice_j, slice_j_cells;  ///< Sum in each slice; the same times the height over the grid's floor.
  std::array<float, max_emitters> of_emitter_j{};  ///< What is left of that which each emitter gave.
};

/// Cross-sections of all births of emitters whose particles stay for ever.
struct Ledger {
  double emitted_m2 = 0.0, left_m2 = 0.0;  ///< Left: through an open face.
  double on_walls_m2 = 0.0;                ///< Soot on walls; of it not yet taken out of the air:
  double owed_to_walls_m2 = 0.0;
};

struct State {
  Grid grid;
  Parameters parameters;
  std::vector<Emitter> emitters;  ///< At most max_emitters; an index stays an emitter's for good.
  Particles particles;
  std::size_t capacity = 20'000;  ///< Where it is near, particles that stay for ever are joined.
  std::uint64_t seed = 1;
  std::uint64_t tick = 0;
  std::uint64_t births = 0, refused = 0;  ///< Refused: of the births, those that found no place.
  double time_s = 0.0;
  std::vector<std::uint32_t> beside_wall;  ///< Free cells that touch a wall, ascending.
  std::vector<float> soot;                 ///< Soot on those walls in full layers (full_layer_depth); as many.
  Ledger ledger;
  Warmth warmth;  ///< Counted every `extinction_ticks` ticks.
  // Follow from the above and the obstacles of the last step.
  std::vector<std::uint16_t> density;     ///< Particles in each cell.
  std::vector<float> extinction_area_m2;  ///< Their cross-sections in each cell, every `extinction_ticks` ticks.
  std::vector<std::uint8_t> full;         ///< Walls and vehicles: 1 where nothing can be.
  VelocityField field;                    ///< Memory of the step.
};

/// Smoke without a particle in it.
State make_smoke(const Grid& grid, std::vector<Emitter> emitters, std::uint64_t seed, std::size_t capacity = 20'000,
                 const Parameters& parameters = {});

struct StepReport {
  int born = 0, died = 0, left = 0;  ///< Left: through an open face.
  int pushed = 0;                    ///< Out of cells that became full.
  int joined = 0;
};

/// One tick. `wind_mps` is the draught (world frame); obstacles may move between ticks.
StepReport advance_smoke(State& state, const Vec3& wind_mps, std::span<const Obstacle> obstacles, double step_s);

/// Puts a particle into the nearest cell that is not full. False: at capacity, or no free cell within reach. Its
/// extinction is not counted before the next tick.
bool add_particle(State& state, const Vec3& grid_position, std::uint8_t emitter, float age_s = 0.0f);

/// Remaining share of a particle's extinction at this share of its lifetime: all of it for the first 70 %, then less,
/// steadily, to zero.
inline double remaining_extinction(double lifetime_share) {
  return lifetime_share <= 0.7 ? 1.0 : lifetime_share >= 1.0 ? 0.0 : (1.0 - lifetime_share) / 0.3;
}

/// What is left of a particle's warmth: e^(−age/loss_s) within 3 % up to `loss_s`, 12 % up to twice it.
inline float remaining_warmth(float age_s, float per_loss_s) {
  float root = 1.0f / (1.0f + age_s * per_loss_s * 0.0625f);
  root *= root, root *= root, root *= root;
  return root * root;
}

void add_to_hash(const State& state, StateHash& hash);

}  // namespace septet::smoke
