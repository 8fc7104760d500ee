#include "sim-client/frame/ice_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "sim-client/frame/ice_looks.hpp"

namespace septet::frame {
namespace {

/// Ranges of drawing; an icicle is a pixel wide at about the first.
constexpr double row_reach_m = 60.0, sheet_reach_m = 120.0;
/// Height of a sheet over the road's surface, which is drawn with chords of some metres.
constexpr double over_road_m = 0.008;

/// Rotates vertices from the frame at rest into the world, relative to the body's origin.
void place(std::vector<ice::IceVertex>& vertices, const glm::dmat3& turn) {
  const glm::mat3 turned(turn);
  for (ice::IceVertex& vertex : vertices) {
    vertex.position_m = glm::vec3(turn * Vec3(vertex.position_m));
    vertex.normal = turned * vertex.normal;
  }
}

}  // namespace

ice::IceBody slab_body(const ice::LyingSlab& slab, double thawed_kh, const RigidTransform& world_from_vehicle,
                       float film) {
  ice::IceBody body;
  const double thickness_m = ice::left_m(slab.size_m.z, thawed_kh);
  if (!(thickness_m > 0.0)) return body;
  const Vec3 half = 0.5 * Vec3(slab.size_m.x, slab.size_m.y, thickness_m);
  body.look = slab_look(film);
  body.vertices = ice::box_surface(-half, half, 8, 5);
  const std::array corners{-half, half};
  body.inside = cracks_between(corners, slab_crack_cell_m);
  body.origin_m = world_from_vehicle * (slab.foot_m + Vec3(0.0, 0.0, half.z));
  const glm::dmat3 turn = glm::mat3_cast(world_from_vehicle.orientation);
  place(body.vertices, turn);
  place(body.inside, turn);
  return body;
}

ice::IceBody row_body(const ice::IcicleRow& row, double thawed_kh, float film) {
  ice::IceBody body;
  body.look = icicle_look(film);
  body.origin_m = 0.5 * (row.from_m + row.to_m);
  for (const ice::Icicle& icicle : ice::icicles_of(row, thawed_kh))
    ice::append_icicle(body.vertices, icicle, body.origin_m);
  return body;
}

std::vector<ice::IceBody> sheet_bodies(const ice::Sheet& sheet, double thawed_kh, float film) {
  constexpr std::size_t points_each = 8;
  constexpr float crack_cell_m = 0.8f;
  std::vector<ice::IceBody> bodies;
  const double thickness_m = ice::left_m(sheet.thickness_m, thawed_kh);
  const std::size_t points = std::min(sheet.left_m.size(), sheet.right_m.size());
  if (!(thickness_m > 0.0)) return bodies;
  double along_m = 0.0;
  for (std::size_t first = 0; first + 1 < points; first += points_each) {
    const std::size_t last = std::min(first + points_each, points - 1);
    ice::IceBody body;
    body.look = sheet_look(film);
    body.origin_m = 0.5 * (sheet.left_m[first] + sheet.right_m[last]);
    struct Row {
      Vec3 left, right, up;
      double along_m;
    };
    std::vector<Row> rows;
    for (std::size_t i = first; i <= last; ++i) {
      const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, points - 1);
      const Vec3 ahead = sheet.left_m[after] + sheet.right_m[after] - sheet.left_m[before] - sheet.right_m[before];
      Vec3 up = glm::cross(ahead, sheet.left_m[i] - sheet.right_m[i]);
      up = glm::length(up) > 1e-9 ? glm::normalize(up) : Vec3(0.0, 0.0, 1.0);
      if (i > first)
        along_m += 0.5 * glm::length(sheet.left_m[i] + sheet.right_m[i] - sheet.left_m[i - 1] - sheet.right_m[i - 1]);
      rows.push_back({sheet.left_m[i] - body.origin_m, sheet.right_m[i] - body.origin_m, up, along_m});
    }
    const auto vertex = [&](const Row& row, bool left, bool top, const Vec3& normal) {
      const Vec3& edge = left ? row.left : row.right;
      const double up_m = over_road_m + (top ? thickness_m : 0.0), half_m = 0.5 * glm::length(row.left - row.right);
      return ice::IceVertex{glm::vec3(edge + up_m * row.up), glm::vec3(normal),
                            glm::vec3(row.along_m, left ? half_m : -half_m, top ? thickness_m : 0.0)};
    };
    const auto quad = [&](const std::array<ice::IceVertex, 4>& corners) {
      for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) body.vertices.push_back(corners[i]);
    };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const Row &a = rows[i], &b = rows[i + 1];
      quad({vertex(a, false, true, a.up), vertex(b, false, true, b.up), vertex(b, true, true, b.up),
            vertex(a, true, true, a.up)});
      quad({vertex(a, false, false, -a.up), vertex(a, true, false, -a.up), vertex(b, true, false, -b.up),
            vertex(b, false, false, -b.up)});
      const Vec3 left = glm::length(a.left - a.right) > 1e-6 ? glm::normalize(a.left - a.right) : Vec3(0.0, 1.0, 0.0);
      quad({vertex(a, true, true, left), vertex(b, true, true, left), vertex(b, true, false, left),
            vertex(a, true, false, left)});
      quad({vertex(a, false, false, -left), vertex(b, false, false, -left), vertex(b, false, true, -left),
            vertex(a, false, true, -left)});
    }
    // Its cracks lie in the frame of its middle row; the bend of a road within eight metres is less than the ice is
    // uneven.
    const Row& middle = rows[rows.size() / 2];
    const Vec3 y = glm::length(middle.left - middle.right) > 1e-6 ? glm::normalize(middle.left - middle.right)
                                                                  : Vec3(0.0, 1.0, 0.0);
    const glm::dmat3 turn(glm::normalize(glm::cross(y, middle.up)), y, middle.up);
    std::vector<Vec3> rest;
    for (const ice::IceVertex& v : body.vertices) rest.emplace_back(v.rest_m);
    body.inside = cracks_between(rest, crack_cell_m);
    const Vec3 centre = 0.5 * (middle.left + middle.right) + over_road_m * middle.up;
    for (ice::IceVertex& v : body.inside) v.position_m -= glm::vec3(middle.along_m, 0.0, 0.0);
    place(body.inside, turn);
    for (ice::IceVertex& v : body.inside) v.position_m += glm::vec3(centre);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

void IceDrawing::show(const Snapshot& instant, const scene::ResolvedScene& scene) {
  slabs_.clear();
  shadows_.clear();
  const auto effect = std::ranges::lower_bound(instant.effects, ice::effect_id, {}, &EffectKeyframe::id);
  if (effect == instant.effects.end() || effect->id != ice::effect_id || effect->kind != ice::keyframe_kind) {
    ice_.reset();
    standing_.clear();
    return;
  }
  const auto film = static_cast<float>(ice::film(instant.environment.temperature_k));
  if (!ice_ || effect->tick != tick_ || film != film_) {
    tick_ = effect->tick;
    film_ = film;
    standing_.clear();
    auto read = ice::decode(effect->data);
    if (!read) {
      ice_ = ice::StillIce{};
      return;
    }
    ice_ = std::move(*read);
    for (const ice::IcicleRow& row : ice_->rows)
      standing_.push_back({row_body(row, ice_->thawed_kh, film), row_reach_m});
    for (const ice::Sheet& sheet : ice_->sheets)
      for (ice::IceBody& body : sheet_bodies(sheet, ice_->thawed_kh, film))
        standing_.push_back({std::move(body), sheet_reach_m});
    std::erase_if(standing_, [](const Standing& standing) { return standing.body.vertices.empty(); });
  }
  const auto look = std::ranges::find(scene.prototypes, "debris/ice", &scene::Prototype::name);
  for (const ice::LyingSlab& slab : ice_->slabs) {
    const Participant* vehicle = find_participant(instant, slab.vehicle);
    if (!vehicle) continue;
    ice::IceBody body = slab_body(slab, ice_->thawed_kh, vehicle->world_from_vehicle, film);
    if (body.vertices.empty()) continue;
    if (look != scene.prototypes.end()) {
      instant::DynamicMesh shadow;
      shadow.prototype = static_cast<std::uint32_t>(look - scene.prototypes.begin());
      shadow.origin_m = body.origin_m;
      shadow.radius_m = static_cast<float>(0.5 * glm::length(slab.size_m));
      shadow.seen = false;
      for (const ice::IceVertex& vertex : body.vertices)
        shadow.vertices.push_back({vertex.position_m, vertex.normal, {}});
      shadows_.push_back(std::move(shadow));
    }
    slabs_.push_back(std::move(body));
  }
}

void IceDrawing::add_to(instant::FrameInput& frame) const {
  frame.ice.insert(frame.ice.end(), slabs_.begin(), slabs_.end());
  frame.meshes.insert(frame.meshes.end(), shadows_.begin(), shadows_.end());
  for (const Standing& standing : standing_) {
    const bool near = std::ranges::any_of(frame.views, [&](const instant::FrameView& view) {
      return glm::length(standing.body.origin_m - instant::world_eye(view)) < standing.reach_m;
    });
    if (near) frame.ice.push_back(standing.body);
  }
}

}  // namespace septet::frame
