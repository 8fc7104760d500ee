#include "engine/roadside/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/geometry/noise.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/town.hpp"

namespace septet::roadside {
namespace {

constexpr double sample_step_m = 20.0, sample_cell_m = 128.0;
constexpr std::size_t coarse_stride = 12;
constexpr double yard_below_m = 0.45;  ///< Depth of a town's ground below its streets' edges.

std::pair<std::int64_t, std::int64_t> cell_of(const Vec2& p) {
  return {static_cast<std::int64_t>(std::floor(p.x / sample_cell_m)),
          static_cast<std::int64_t>(std::floor(p.y / sample_cell_m))};
}

}  // namespace

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double Terrain::meander_m(double across_m) {
  return 14.0 * std::sin(across_m / 85.0) * smooth_step(30.0, 160.0, std::abs(across_m));
}

std::vector<glm::i64vec2> squares_near(const std::vector<Vec2>& places, double side_m, double reach_m) {
  // Sorted by y, then by x; neighbours in the list mostly name the same squares.
  std::set<std::pair<std::int64_t, std::int64_t>> found;
  for (const Vec2& place : places) {
    const Vec2 first = glm::floor((place - reach_m) / side_m - 0.5), last = glm::ceil((place + reach_m) / side_m - 0.5);
    for (auto y = static_cast<std::int64_t>(first.y); y <= static_cast<std::int64_t>(last.y); ++y)
      for (auto x = static_cast<std::int64_t>(first.x); x <= static_cast<std::int64_t>(last.x); ++x)
        found.emplace(y, x);
  }
  std::vector<glm::i64vec2> squares;
  squares.reserve(found.size());
  for (const auto& [y, x] : found) squares.emplace_back(x, y);
  return squares;
}

void Terrain::add_samples(const RoadShape& roads, road::RoadIndex index) {
  const road::Road& road = roads.road(index);
  struct Stretch {
    double from_m, to_m;
    bool after_deck, before_deck;
  };
  // Decks have no ground of their own.
  std::vector<Stretch> stretches{{roads.begin_m(index), roads.end_m(index), false, false}};
  std::vector<std::pair<double, double>> decks;
  for (const road::RoadStructure& structure : road.structures)
    if (structure.over_road) decks.emplace_back(structure.s_m, structure.s_m + structure.length_m);
  std::sort(decks.begin(), decks.end());
  for (const auto& [from_m, to_m] : decks) {
    Stretch& last = stretches.back();
    const Stretch after{to_m, last.to_m, true, false};
    last.to_m = from_m;
    last.before_deck = true;
    stretches.push_back(after);
  }
  for (const Stretch& stretch : stretches) {
    const double length = stretch.to_m - stretch.from_m;
    if (length < 0.01 && stretches.size() > 1) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(length / sample_step_m)));
    const double step = stretches.size() > 1 ? length / count : sample_step_m;
    for (int i = 0; i <= count; ++i) {
      const double s = stretch.from_m + length * i / count;
      const road::RoadPoint p = roads.at(index, s, 0.0);
      const road::RoadExtent extent = road::road_extent(road, s);
      samples_.push_back({index, s, p.position_m, Vec2(std::cos(p.heading_rad), std::sin(p.heading_rad)), p.roll_rad,
                          extent.left_t_m, extent.right_t_m, step, i == 0 && stretch.after_deck ? 0.0 : 0.5 * step,
                          i == count && stretch.before_deck ? 0.0 : 0.5 * step, is_in_town(roads.network(), index, s)});
    }
  }
}

Terrain::Terrain(const RoadShape& roads, std::uint64_t seed) : seed_(seed), lanes_(roads) {
  const road::RoadNetwork& network = roads.network();
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    add_samples(roads, index);
    for (const road::RoadStructure& structure : network.roads[index].structures) {
      structures_.push_back({index, structure.s_m, structure.s_m + structure.length_m});
      if (structure.kind == road::RoadStructure::Kind::tunnel) {
        tunnels_.push_back({index, structure.s_m, structure.s_m + structure.length_m});
        continue;
      }
      if (structure.over_road) continue;
      const road::RoadPoint p = roads.at(index, structure.s_m + structure.length_m / 2, 0.0);
      Valley valley{p.position_m, Vec2(std::cos(p.heading_rad), std::sin(p.heading_rad)), 15.0, 0.0};
      valley.bottom_z_m = p.position_m.z - 1.0 - valley.depth_m;
      valleys_.push_back(valley);
    }
  }
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    low_m_ = glm::min(low_m_, Vec2(samples_[i].position_m));
    high_m_ = glm::max(high_m_, Vec2(samples_[i].position_m));
    cells_[cell_of(Vec2(samples_[i].position_m))].push_back(i);
    if (i % coarse_stride == 0) coarse_.push_back(samples_[i]);
  }
  lowered_ = LoweredLand(lanes_, [this](const Vec2& p) { return land_m(p, nearest(p)); });
}

void Terrain::look_in(const Cell& cell, const Vec2& p, Nearest& best) const {
  const auto found = cells_.find(cell);
  if (found == cells_.end()) return;
  for (const std::uint32_t i : found->second) {
    const Sample& sample = samples_[i];
    const Vec2 offset = p - Vec2(sample.position_m);
    const Vec2 left(-sample.along.y, sample.along.x);
    const double ahead = glm::dot(offset, sample.along), t = glm::dot(offset, left);
    const double end = std::max(0.0, ahead > 0.0 ? ahead - sample.forward_m : -ahead - sample.back_m);
    const double side = std::max({t - sample.left_m, sample.right_m - t, 0.0});
    const double outside = std::hypot(end, side);
    // Among samples that are all beside the point the one straight beside it counts.
    const bool better = !best.found || outside < best.outside_m - 1e-9 ||
                        (outside < best.outside_m + 1e-9 && std::abs(ahead) < std::abs(best.s_m - sample.s_m));
    if (!better || outside > reach_m) continue;
    best.found = true;
    best.road = sample.road;
    best.in_town = sample.in_town;
    best.outside_m = outside;
    best.s_m = sample.s_m + std::clamp(ahead, -sample.step_m, sample.step_m);
    best.t_m = t;
    const std::size_t next = ahead > 0 ? i + 1 : i - 1;
    double z = sample.position_m.z;
    if (next < samples_.size() && samples_[next].road == sample.road)
      z = std::lerp(z, samples_[next].position_m.z, std::min(1.0, std::abs(ahead) / sample.step_m));
    best.axis_z_m = z;
    best.edge_z_m = z + std::clamp(t, sample.right_m, sample.left_m) * std::sin(sample.roll_rad);
  }
}

Nearest Terrain::nearest(const Vec2& p) const {
  Nearest best;
  const Cell home = cell_of(p);
  const auto rings = static_cast<std::int64_t>(reach_m / sample_cell_m) + 1;
  std::int64_t last = rings;
  for (std::int64_t ring = 0; ring <= last; ++ring) {
    for (std::int64_t y = -ring; y <= ring; ++y)
      for (std::int64_t x = -ring; x <= ring; ++x)
        if (std::max(std::abs(x), std::abs(y)) == ring) look_in({home.first + x, home.second + y}, p, best);
    // A road found in this ring may still be beaten from the next one.
    if (best.found && last == rings) last = std::min(rings, ring + 1);
  }
  return best;
}

double Terrain::distance_m(const Vec2& p) const {
  double least = 1e9;
  for (const Sample& sample : coarse_) least = std::min(least, glm::distance(p, Vec2(sample.position_m)));
  return least;
}

std::vector<glm::i64vec2> Terrain::squares_near(double side_m, double within_m) const {
  std::vector<Vec2> places;
  for (const Sample& sample : coarse_) places.emplace_back(sample.position_m);
  return roadside::squares_near(places, side_m, within_m);
}

double Terrain::height_m(const Vec2& p, const Nearest& near) const { return land_m(p, near) - lowered_.by_m(p); }

double Terrain::land_m(const Vec2& p, const Nearest& near) const {
  // Level of the roads around, and hills that grow with the distance from them.
  double weights = 0.0, level = 0.0, least = 1e9;
  for (const Sample& sample : coarse_) {
    const double square = glm::dot(p - Vec2(sample.position_m), p - Vec2(sample.position_m));
    const double weight = 1.0 / ((square + 160000.0) * (square + 160000.0));
    weights += weight;
    level += weight * sample.position_m.z;
    least = std::min(least, square);
  }
  const double distance = std::sqrt(least);
  double land = level / weights + 11.0 * geometry::fractal_noise(p.x / 620.0, p.y / 620.0, 4, seed_);
  land += smooth_step(500.0, 3600.0, distance) *
          (55.0 + 85.0 * geometry::fractal_noise(p.x / 1700.0, p.y / 1700.0, 4, seed_ + 1));
  if (!near.found) {
    // Unchanged: too far from every road for cut and fill.
  } else {
    const double below_m = near.outside_m <= 0.0 ? 1.3 : 0.9;
    const double fill = near.edge_z_m - (near.in_town && near.outside_m > 0.0 ? yard_below_m : below_m);
    land = std::lerp(fill, land,
                     near.in_town ? smooth_step(Nearest::yards_m, 4.0 * Nearest::yards_m, near.outside_m)
                                  : smooth_step(9.0, 150.0, near.outside_m));
    for (const Mouth& tunnel : tunnels_) {
      if (near.road != tunnel.road) continue;
      const double s = near.s_m;
      const double rise = std::min(10.0 * smooth_step(tunnel.s0_m - 120.0, tunnel.s0_m, s) +
                                       15.0 * smooth_step(tunnel.s0_m, tunnel.s0_m + 150.0, s),
                                   10.0 * (1.0 - smooth_step(tunnel.s1_m, tunnel.s1_m + 120.0, s)) +
                                       15.0 * (1.0 - smooth_step(tunnel.s1_m - 150.0, tunnel.s1_m, s)));
      const bool over = s >= tunnel.s0_m && s <= tunnel.s1_m;
      const double cover = over ? 1.0 : smooth_step(4.0, 40.0, near.outside_m);
      const double share = cover * (1.0 - smooth_step(90.0, 420.0, near.outside_m));
      if (rise > 0.0) land = std::lerp(land, std::max(land, near.axis_z_m + rise), share);
    }
  }
  for (const Valley& valley : valleys_) {
    const Vec2 offset = p - Vec2(valley.middle_m);
    const double across = glm::dot(offset, Vec2(-valley.along.y, valley.along.x));
    const double along = glm::dot(offset, valley.along) - meander_m(across);
    const double reach = 1.0 - smooth_step(350.0, 1000.0, std::abs(across));
    land -= valley.depth_m * reach * std::exp(-along * along / (42.0 * 42.0));
  }
  return land;
}

bool Terrain::is_kept_clear(const Nearest& near) const {
  if (!near.found || near.outside_m > 30.0) return false;
  for (const Mouth& structure : structures_)
    if (near.road == structure.road && near.s_m > structure.s0_m - 30.0 && near.s_m < structure.s1_m + 30.0)
      return true;
  return false;
}

bool Terrain::is_at_portal(const Nearest& near) const {
  if (!near.found || near.outside_m > 54.0) return false;
  for (const Mouth& tunnel : tunnels_)
    if (near.road == tunnel.road && std::min(std::abs(near.s_m - tunnel.s0_m), std::abs(near.s_m - tunnel.s1_m)) < 27.0)
      return true;
  return false;
}

double Terrain::woodland(const Vec2& p) const {
  return smooth_step(0.10, 0.22, geometry::fractal_noise(p.x / 420.0, p.y / 420.0, 3, seed_ + 2));
}

}  // namespace septet::roadside
