#include "engine/effects/smoke/particle_population.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"

namespace septet::smoke {
namespace {

constexpr int reach = 6;

const std::vector<CellPlace>& offsets_by_distance() {
  static const std::vector<CellPlace> offsets = [] {
    std::vector<CellPlace> all;
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (i * i + j * j + k * k <= reach * reach) all.push_back({i, j, k});
    std::ranges::stable_sort(all, {}, [](const CellPlace& o) { return o.i * o.i + o.j * o.j + o.k * o.k; });
    return all;
  }();
  return offsets;
}

}  // namespace

std::optional<CellPlace> nearest_free_cell(const State& state, int i, int j, int k) {
  const Grid& grid = state.grid;
  for (const CellPlace& o : offsets_by_distance()) {
    const CellPlace place{i + o.i, j + o.j, k + o.k};
    if (!grid.inside(place.i, place.j, place.k)) continue;
    const int cell = grid.index(place.i, place.j, place.k);
    if (!state.full[cell] && state.density[cell] < state.parameters.most_in_cell) return place;
  }
  return std::nullopt;
}

void remove_particle(Particles& particles, std::size_t at) {
  particles.free_numbers.push_back(particles.number[at]);
  const auto drop = [&](auto& values) {
    values[at] = values.back();
    values.pop_back();
  };
  drop(particles.x), drop(particles.y), drop(particles.z), drop(particles.age_s);
  drop(particles.emitter), drop(particles.births), drop(particles.number);
}

void sort_by_cell(State& state) {
  Particles& particles = state.particles;
  const std::size_t count = particles.size();
  std::vector<std::uint32_t> first(static_cast<std::size_t>(state.grid.cells()) + 1, 0), to(count);
  for (std::size_t n = 0; n < count; ++n) {
    to[n] = static_cast<std::uint32_t>(state.grid.index(
        static_cast<int>(particles.x[n]), static_cast<int>(particles.y[n]), static_cast<int>(particles.z[n])));
    ++first[to[n] + 1];
  }
  for (std::size_t cell = 1; cell < first.size(); ++cell) first[cell] += first[cell - 1];
  for (std::uint32_t& place : to) place = first[place]++;
  const auto scatter = [&](auto& values) {
    auto sorted = values;
    for (std::size_t n = 0; n < count; ++n) sorted[to[n]] = values[n];
    values = std::move(sorted);
  };
  scatter(particles.x), scatter(particles.y), scatter(particles.z), scatter(particles.age_s);
  scatter(particles.emitter), scatter(particles.births), scatter(particles.number);
}

bool add_particle(State& state, const Vec3& grid_position, std::uint8_t emitter, float age_s) {
  SEPTET_CHECK(emitter < state.emitters.size(), "emitter {} of {}", emitter, state.emitters.size());
  Particles& particles = state.particles;
  if (particles.size() >= state.capacity) return false;
  const Vec3 bounded = glm::clamp(grid_position, Vec3(-1e6), Vec3(1e6));
  const int i = static_cast<int>(std::floor(bounded.x)), j = static_cast<int>(std::floor(bounded.y)),
            k = static_cast<int>(std::floor(bounded.z));
  const auto place = nearest_free_cell(state, i, j, k);
  if (!place) return false;
  const bool as_asked = place->i == i && place->j == j && place->k == k;
  const Vec3 at = as_asked ? bounded : Vec3(place->i + 0.5, place->j + 0.5, place->k + 0.5);
  if (particles.free_numbers.empty()) particles.free_numbers.push_back(particles.numbers++);
  // A double just below a whole number may round up to it, which is the next cell.
  const auto within = [](double value, int cell) {
    return std::min(static_cast<float>(value), std::nextafter(static_cast<float>(cell + 1), 0.0f));
  };
  particles.x.push_back(within(at.x, place->i));
  particles.y.push_back(within(at.y, place->j));
  particles.z.push_back(within(at.z, place->k));
  particles.age_s.push_back(std::max(age_s, 0.0f));
  particles.emitter.push_back(emitter);
  particles.births.push_back(1);
  particles.number.push_back(particles.free_numbers.back());
  particles.free_numbers.pop_back();
  ++state.density[state.grid.index(place->i, place->j, place->k)];
  return true;
}

int join_neighbours(State& state) {
  constexpr float furthest_cells = 2.0f;
  constexpr int most_births = 1 << 14;
  Particles& p = state.particles;
  const std::size_t enough = state.capacity - state.capacity / 8;
  const auto loss_s = static_cast<float>(state.parameters.warmth_loss_s);
  std::vector<std::uint8_t> gone(p.size(), 0);
  std::size_t left = p.size();
  const auto join = [&](std::size_t into, std::size_t from) {
    const auto a = static_cast<float>(p.births[into]), b = static_cast<float>(p.births[from]);
    const float warmth =
        (a * remaining_warmth(p.age_s[into], 1.0f / loss_s) + b * remaining_warmth(p.age_s[from], 1.0f / loss_s)) /
        (a + b);
    p.age_s[into] = 16.0f * loss_s * (std::pow(warmth, -0.0625f) - 1.0f);
    p.births[into] = static_cast<std::uint16_t>(p.births[into] + p.births[from]);
    gone[from] = 1;
    --left;
  };
  for (int heaviest = 2; heaviest <= most_births && left > enough; heaviest *= 2) {
    std::size_t last = p.size();  // The last one that is not joined yet.
    for (std::size_t n = 0; n < p.size() && left > enough; ++n) {
      if (gone[n] || state.emitters[p.emitter[n]].lifetime_s > 0.0) continue;
      const bool fits = last < p.size() && p.emitter[last] == p.emitter[n] &&
                        p.births[last] + p.births[n] <= heaviest && std::abs(p.x[last] - p.x[n]) < furthest_cells &&
                        std::abs(p.y[last] - p.y[n]) < furthest_cells && std::abs(p.z[last] - p.z[n]) < furthest_cells;
      if (fits) join(p.births[last] >= p.births[n] ? last : n, p.births[last] >= p.births[n] ? n : last);
      last = fits ? p.size() : n;
    }
  }
  const int joined = static_cast<int>(p.size() - left);
  for (std::size_t n = gone.size(); n-- > 0;) {
    if (!gone[n]) continue;
    --state.density[state.grid.index(static_cast<int>(p.x[n]), static_cast<int>(p.y[n]), static_cast<int>(p.z[n]))];
    remove_particle(p, n);
  }
  return joined;
}

int emit(State& state, double step_s) {
  int born = 0;
  const std::uint64_t key = mixed(state.seed + 1);
  for (std::size_t e = 0; e < state.emitters.size(); ++e) {
    Emitter& emitter = state.emitters[e];
    emitter.owed += std::max(0.0, emitter.rate_per_s) * step_s;
    const Vec3 centre = state.grid.grid_from_world(emitter.position_m);
    const double radius = emitter.radius_m / state.grid.cell_m;
    for (; emitter.owed >= 1.0; emitter.owed -= 1.0) {
      const auto u = uniform_of(key, (state.births++ << 1) | 1);
      // Uniform in the ball: cosine of the polar angle, azimuth, cube root of the radius.
      const double z = 2.0 * u[0] - 1.0, azimuth = 2.0 * 3.14159265358979323846 * u[1];
      const double r = radius * std::cbrt(u[2]), across = r * std::sqrt(1.0 - z * z);
      const Vec3 from_centre(across * std::cos(azimuth), across * std::sin(azimuth), r * z);
      const bool is_born = add_particle(state, centre + from_centre, static_cast<std::uint8_t>(e));
      born += is_born;
      state.refused += !is_born;
      if (is_born && !(emitter.lifetime_s > 0.0)) state.ledger.emitted_m2 += emitter.extinction_area_m2;
    }
  }
  return born;
}

}  // namespace septet::smoke
