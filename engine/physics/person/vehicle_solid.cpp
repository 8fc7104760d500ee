#include "engine/physics/person/vehicle_solid.hpp"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/world/vehicle_body.hpp"

namespace septet::person {
namespace {

/// More than anybody is pressed into a flat front at 25 m/s. Its underside is at the knees: shins that it pressed down
/// took two metres a second of the body with them, and throws by lorries fell short of Searle's band. Shins do slip
/// under the low bumper of a car or van.
constexpr double flat_front_gives_m = 0.6;

struct FrontLines {
  double bumper_top, edge_height, edge_behind, bonnet_rear, windscreen_behind, roof_behind;
};

std::optional<FrontLines> front_lines(ParticipantKind kind) {
  switch (kind) {
#define SEPTET_ENTRY(name, ...) \
  case ParticipantKind::name:   \
    return FrontLines __VA_ARGS__;
#include "engine/physics/person/fronts.toml.inc"
    default:
      return std::nullopt;
  }
}

/// Face above the line from a point to one behind it, in side view.
Face above(const Vec2& front_xz, const Vec2& rear_xz, Part part) {
  const Vec2 back = glm::normalize(rear_xz - front_xz);
  const Vec3 normal(back.y, 0.0, -back.x);
  return {{normal, normal.x * front_xz.x + normal.z * front_xz.y}, part};
}

}  // namespace

std::vector<Piece> vehicle_pieces(const VehicleModel& model) {
  const double front = model.front_m(), rear = -model.rear_overhang_m, half = 0.5 * model.width_m;
  const double low = vehicle_body(model.kind).clearance_m, high = model.height_m;
  const auto sides = [&](double half_m) {
    return Piece{
        {{{0, 1, 0}, half_m}, Part::side}, {{{0, -1, 0}, half_m}, Part::side}, {{{-1, 0, 0}, -rear}, Part::rear}};
  };
  Piece body = sides(half);
  const auto lines = front_lines(model.kind);
  body.push_back({{{1, 0, 0}, front}, Part::bumper});
  body.push_back({{{0, 0, -1}, -low}, Part::below, lines ? 0.0 : flat_front_gives_m});
  if (!lines) {
    body.push_back({{{0, 0, 1}, high}, Part::roof});
    return {body};
  }
  const Vec2 bumper(front, lines->bumper_top * high),
      edge(front - lines->edge_behind * model.length_m, lines->edge_height * high),
      foot(front - lines->windscreen_behind * model.length_m, lines->bonnet_rear * high),
      head(front - lines->roof_behind * model.length_m, high);
  body.push_back(above(bumper, edge, Part::bumper));
  body.push_back(above(edge, foot, Part::bonnet));
  body.push_back({{{0, 0, 1}, foot.y}, Part::bonnet});
  constexpr double cabin_share = 0.85;  // Cabins lean in.
  Piece cabin = sides(cabin_share * half);
  cabin.push_back(above(foot, head, Part::windscreen));
  cabin.push_back({{{0, 0, 1}, high}, Part::roof});
  cabin.push_back({{{0, 0, -1}, -low}, Part::below});
  return {body, cabin};
}

Depth depth_in(const Piece& piece, const Vec3& centre_m, double radius_m) {
  Depth least{INFINITY, {}, Part::side};
  double behind_front_m = INFINITY;
  for (const Face& face : piece) {
    const double depth_m = face.plane.offset_m + radius_m - glm::dot(face.plane.normal, centre_m);
    if (face.part == Part::bumper) behind_front_m = std::min(behind_front_m, depth_m);
    if (depth_m > radius_m && behind_front_m < face.behind_front_m) continue;
    if (depth_m < least.depth_m) least = {depth_m, face.plane.normal, face.part};
    if (depth_m <= 0.0) return least;
  }
  return least;
}

}  // namespace septet::person
