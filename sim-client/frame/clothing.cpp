#include "sim-client/frame/clothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sim-client/frame/surface_vertices.hpp"

namespace septet::frame {
namespace {

using debris::Mount;
using scene::SurfaceVertex;

constexpr float longest_edge_m = 0.12f;  ///< A panel's triangles are smaller than a lattice's cubes.

bool looks_back(Mount mount) {
  return mount == Mount::rear_bumper || mount == Mount::rear_left_lamp || mount == Mount::rear_right_lamp;
}

/// Halves the longest edge until all are short enough: triangles that share one halve it alike.
void divide(const SheetTriangle& triangle, Sheet& into) {
  std::size_t longest = 0;
  float length_m = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    if (const float edge_m = glm::length(triangle.corners[(k + 1) % 3].position_m - triangle.corners[k].position_m);
        edge_m > length_m)
      length_m = edge_m, longest = k;
  if (length_m <= longest_edge_m) {
    into.push_back(triangle);
    return;
  }
  const SurfaceVertex a = triangle.corners[longest], b = triangle.corners[(longest + 1) % 3],
                      c = triangle.corners[(longest + 2) % 3], m = between(a, b);
  SheetTriangle half = triangle;
  half.corners = {a, m, c};
  divide(half, into);
  half.corners = {m, b, c};
  divide(half, into);
}

/// The panel in the part's frame, its skin's box in the middle.
struct PlacedPanel {
  Sheet sheet;
  Vec3 size_m{0.0};
};

PlacedPanel placed(const Sheet& panel, Mount mount) {
  PlacedPanel result;
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const SheetTriangle& triangle : panel) {
    divide(triangle, result.sheet);
    if (!triangle.is_skin) continue;
    for (const SurfaceVertex& corner : triangle.corners)
      low = glm::min(low, corner.position_m), high = glm::max(high, corner.position_m);
  }
  if (!(high.x > low.x)) return {};
  const float turn = looks_back(mount) ? -1.0f : 1.0f;
  for (SheetTriangle& triangle : result.sheet)
    for (SurfaceVertex& corner : triangle.corners)
      corner.position_m = (corner.position_m - 0.5f * (low + high)) * glm::vec3(turn, turn, 1.0f);
  result.size_m = Vec3(glm::max(high - low, 1e-3f));
  return result;
}

/// True within a closed surface: its triangles' solid angles add up to a whole sphere (van Oosterom and Strackee 1983).
bool lies_in(const Vec3& place_m, std::span<const Vec3> vertices_m,
             std::span<const std::array<std::uint16_t, 3>> triangles) {
  double angle = 0.0;
  for (const auto& t : triangles) {
    const Vec3 a = vertices_m[t[0]] - place_m, b = vertices_m[t[1]] - place_m, c = vertices_m[t[2]] - place_m;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return angle > 2.0 * std::numbers::pi;
}

Vec3 mean_of(std::span<const Vec3> places_m) {
  Vec3 sum(0.0);
  for (const Vec3& place : places_m) sum += place;
  return sum / static_cast<double>(std::max<std::size_t>(1, places_m.size()));
}

}  // namespace

Clothing::Clothing(const Sheet& panel, const debris::Keyframe& piece)
    : origin_(piece.origin), nodes_(piece.lattice_nodes), lattice_(piece.triangles) {
  if (!origin_ || panel.empty() || nodes_.size() != piece.vertices_m.size() || nodes_.size() < 4) return;
  std::vector<Vec3> rest_m;
  rest_m.reserve(nodes_.size());
  for (const std::uint8_t node : nodes_) rest_m.push_back(debris::lattice_place_m(piece.part, node));
  PlacedPanel whole = placed(panel, origin_->mount);
  const Vec3 box_m = debris::part_recipe(piece.part).size_m, per_m = box_m / glm::max(whole.size_m, 1e-3);
  // Deep enough in the lattice that no rounding puts a place outside of it.
  const auto in_lattice = [&](const Vec3& place_m) { return glm::clamp(place_m * per_m, -0.49 * box_m, 0.49 * box_m); };
  std::stable_sort(whole.sheet.begin(), whole.sheet.end(),
                   [](const SheetTriangle& a, const SheetTriangle& b) { return a.material < b.material; });
  const Vec3 middle_m = mean_of(rest_m);
  std::map<std::uint64_t, std::uint16_t> known;
  for (const SheetTriangle& triangle : whole.sheet) {
    const auto& c = triangle.corners;
    if (!lies_in(in_lattice(Vec3(c[0].position_m + c[1].position_m + c[2].position_m) / 3.0), rest_m, lattice_))
      continue;
    if (vertices_.size() + 3 > UINT16_MAX) break;
    std::array<std::uint16_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, fresh] =
          known.try_emplace(place_key(c[k].position_m), static_cast<std::uint16_t>(vertices_.size()));
      corners[k] = found->second;
      uvs_.push_back(c[k].uv);
      if (!fresh) continue;
      Thread& thread = vertices_.emplace_back();
      const Vec3 at = in_lattice(Vec3(c[k].position_m));
      thread.rest_m = Vec3(c[k].position_m) - middle_m / per_m;
      std::vector<std::pair<double, std::uint32_t>> near;
      for (std::uint32_t i = 0; i < rest_m.size(); ++i) near.emplace_back(glm::length(rest_m[i] - at), i);
      std::partial_sort(near.begin(), near.begin() + 4, near.end());
      double sum = 0.0;
      for (std::size_t n = 0; n < 4; ++n) {
        thread.nearest[n] = near[n].second;
        thread.weights[n] = 1.0 / (near[n].first * near[n].first + 1e-4);
        sum += thread.weights[n];
      }
      for (double& weight : thread.weights) weight /= sum;
    }
    if (runs_.empty() || runs_.back().material != triangle.material)
      runs_.push_back({static_cast<std::uint32_t>(triangles_.size()), 0, triangle.material});
    ++runs_.back().count;
    triangles_.push_back(corners);
  }
  for (const Vec3& place : rest_m) lattice_rest_m_.push_back(place - middle_m);
}

bool Clothing::fits(const debris::Keyframe& piece) const {
  return piece.origin == origin_ && piece.lattice_nodes == nodes_ && piece.triangles == lattice_;
}

debris::Keyframe Clothing::worn(const debris::Keyframe& piece) const {
  const Vec3 middle_m = mean_of(piece.vertices_m);
  glm::dmat3 moments(1e-9), moved(1e-9);
  for (std::size_t i = 0; i < lattice_rest_m_.size(); ++i) {
    moments += glm::outerProduct(lattice_rest_m_[i], lattice_rest_m_[i]);
    moved += glm::outerProduct(piece.vertices_m[i] - middle_m, lattice_rest_m_[i]);
  }
  const glm::dmat3 turn = moved * glm::inverse(moments);
  std::vector<Vec3> bends_m;
  bends_m.reserve(lattice_rest_m_.size());
  for (std::size_t i = 0; i < lattice_rest_m_.size(); ++i)
    bends_m.push_back(piece.vertices_m[i] - middle_m - turn * lattice_rest_m_[i]);
  debris::Keyframe result;
  result.part = piece.part;
  result.material = piece.material;
  result.asleep = piece.asleep;
  result.origin = piece.origin;
  result.triangles = triangles_;
  result.vertices_m.reserve(vertices_.size());
  for (const Thread& thread : vertices_) {
    Vec3 place = middle_m + turn * thread.rest_m;
    for (std::size_t n = 0; n < 4; ++n) place += thread.weights[n] * bends_m[thread.nearest[n]];
    result.vertices_m.push_back(place);
  }
  return result;
}

}  // namespace septet::frame
