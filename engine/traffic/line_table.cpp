#include "engine/traffic/line_table.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/cross_section.hpp"

namespace septet::traffic {
namespace {

using Numbers = std::array<double, 8>;
constexpr double tolerance = 1e-6;  ///< Metres; the orientation's and the curvature's are stricter.

RoadLine exact_line(const road::Road& road, double s_m) {
  const road::CrossSection section = road::cross_section_at(road, s_m);
  const Vec2 heading = half_turn(section.plan.direction.x, section.plan.direction.y);
  const Vec2 pitch = half_turn(section.cos_pitch, section.sin_pitch);
  const Vec2 roll = half_turn(section.cos_roll, section.sin_roll);
  return {{section.place(0.0, 0.0),
           Quat(heading.x, 0.0, 0.0, heading.y) * Quat(pitch.x, 0.0, pitch.y, 0.0) * Quat(roll.x, roll.y, 0.0, 0.0)},
          section.plan.curvature_per_m};
}

double station(const CorridorPiece& piece, double x_m) {
  const double along = std::clamp(x_m - piece.x_m, 0.0, piece.length_m);
  return piece.along_s ? along : piece.length_m - along;
}

/// The frame as eight numbers; of the two quaternions of the same rotation the one nearer to `near`.
Numbers numbers_of(const RoadLine& line, const Quat& near) {
  const Vec3& p = line.world_from_line.position_m;
  Quat q = line.world_from_line.orientation;
  if (glm::dot(q, near) < 0.0) q = -q;
  return {p.x, p.y, p.z, q.w, q.x, q.y, q.z, line.curvature_per_m};
}

Numbers evaluate(const LineTable::Cubics& cubics, double u) {
  const auto& [c0, c1, c2, c3] = cubics;
  Numbers value;
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = c0[i] + u * (c1[i] + u * (c2[i] + u * c3[i]));
  return value;
}

double largest_error(const Numbers& a, const Numbers& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double weight = i < 3 ? 1.0 : 10.0;
    largest = std::max(largest, weight * std::abs(a[i] - b[i]));
  }
  return largest;
}

void add_step(const road::RoadNetwork& network, const Corridor& corridor, double begin_m, double end_m,
              LineTable& table) {
  const CorridorPiece& piece = piece_at(corridor, begin_m);
  const road::Road& road = network.roads[piece.road];
  const Quat near = exact_line(road, station(piece, begin_m)).world_from_line.orientation;
  const auto at = [&](double u) {
    return numbers_of(exact_line(road, station(piece, glm::mix(begin_m, end_m, u))), near);
  };
  // Through u = 0, 1/3, 2/3 and 1 (Lagrange).
  LineTable::Cubics cubics;
  const Numbers f0 = at(0.0), f1 = at(1.0 / 3.0), f2 = at(2.0 / 3.0), f3 = at(1.0);
  for (std::size_t i = 0; i < f0.size(); ++i) {
    cubics[0][i] = f0[i];
    cubics[1][i] = -5.5 * f0[i] + 9.0 * f1[i] - 4.5 * f2[i] + f3[i];
    cubics[2][i] = 9.0 * f0[i] - 22.5 * f1[i] + 18.0 * f2[i] - 4.5 * f3[i];
    cubics[3][i] = -4.5 * f0[i] + 13.5 * f1[i] - 13.5 * f2[i] + 4.5 * f3[i];
  }
  bool smooth = &piece == &piece_at(corridor, end_m);
  for (const double u : {0.1, 0.5, 0.9}) smooth = smooth && largest_error(evaluate(cubics, u), at(u)) < tolerance;
  table.cubics.push_back(cubics);
  table.pieces.push_back(smooth ? static_cast<std::uint32_t>(&piece - corridor.pieces.data()) : LineTable::no_piece);
}

}  // namespace

Vec2 half_turn(double cosine, double sine) {
  const double c = std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)));
  const double s = std::copysign(std::sqrt(std::max(0.0, 0.5 * (1.0 - cosine))), sine);
  return {c, s};
}

LineTable make_line_table(const road::RoadNetwork& network, const Corridor& corridor) {
  LineTable table;
  const auto count = static_cast<std::size_t>(corridor.length_m / LineTable::step_m);
  for (std::size_t k = 0; k < count; ++k) {
    const double begin = LineTable::step_m * static_cast<double>(k);
    add_step(network, corridor, begin, begin + LineTable::step_m, table);
  }
  return table;
}

LineAt line_at(const road::RoadNetwork& network, const Corridor& corridor, const LineTable& table, double x_m) {
  const double at = x_m * (1.0 / LineTable::step_m);
  const auto k = static_cast<std::size_t>(at);
  if (k >= table.pieces.size() || table.pieces[k] == LineTable::no_piece) {
    const CorridorPiece& piece = piece_at(corridor, x_m);
    const double s = station(piece, x_m);
    return {piece, s, exact_line(network.roads[piece.road], s)};
  }
  const CorridorPiece& piece = corridor.pieces[table.pieces[k]];
  const Numbers n = evaluate(table.cubics[k], at - static_cast<double>(k));
  // Unit length to the tolerance: one step of Newton's method for 1/√ is exact to its square.
  const double scale = 1.5 - 0.5 * (n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6]);
  return {piece,
          station(piece, x_m),
          {{{n[0], n[1], n[2]}, {scale * n[3], scale * n[4], scale * n[5], scale * n[6]}}, n[7]}};
}

}  // namespace septet::traffic
