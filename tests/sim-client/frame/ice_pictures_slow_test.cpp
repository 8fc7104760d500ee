/// Ice of a drive in pictures of 1024 × 768, measured: cracks through a break, slabs on a roof, icicles below an edge.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/ice/cracks.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/frame/debris_drawing.hpp"
#include "sim-client/frame/ice_drawing.hpp"
#include "tests/engine/instant/ray_through.hpp"

namespace septet::frame {
namespace {

constexpr std::uint32_t wide_px = 1024, high_px = 768;
const double px_slope = 2.0 * std::tan(0.5) / wide_px;

/// View along x, turned down by `pitch_rad`.
instant::FrameInput seen_from(const Vec3& eye_m, double pitch_rad) {
  instant::FrameInput input;
  input.environment.sun_elevation_rad = 0.8;
  instant::FrameView view;
  view.projection = instant::symmetric_view(Vec3(0.0), 0.0, 0.0, 1.0, 2.0 * std::atan(px_slope * 0.5 * high_px));
  view.world_from_car = {eye_m, orientation_from_angles(0.0, pitch_rad, 0.0)};
  view.viewport = {0, 0, wide_px, high_px};
  input.views = {view};
  input.ice_surroundings_px = 32;
  return input;
}

/// Column and row of a place.
std::pair<double, double> pixel_of(const instant::FrameInput& input, const Vec3& place_m) {
  const RigidTransform& eye = input.views[0].world_from_car;
  const Vec3 p = glm::inverse(eye.orientation) * (place_m - eye.position_m);
  return {0.5 * wide_px - p.y / p.x / px_slope, 0.5 * high_px - p.z / p.x / px_slope};
}

render::Renderer software_renderer() {
  return *render::Renderer::create(
      {wide_px, high_px, render::DevicePreference::software, true, render::Antialiasing::none, nullptr});
}

render::RadianceImage picture_of(render::Renderer& renderer, const instant::FrameInput& input) {
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return *renderer.read_radiance();
}

bool is_marked(const glm::vec3& c) { return c.r > 0.2f && c.g < 0.75f * c.r; }

/// Body as a screen receives it, its cracks marked in red.
ice::IceBody marked_body(const debris::Piece& piece) {
  const auto sent = debris::decode(debris::encode(debris::keyframe_of(piece)));
  REQUIRE(sent);
  const DebrisWay way(*sent, *sent);
  auto body = way.ice_of(way.at(0.0), 0.0f);
  REQUIRE(body);
  for (ice::IceVertex& vertex : body->inside) vertex.rest_m.z = float(ice::InsideKind::mark);
  body->look = {};
  body->look.bump = 0.0f;
  body->look.reflects = false;
  return *body;
}

/// Distance of the marked pixel of `there` nearest to a place, at most 6 pixels.
double nearest_px(const render::RadianceImage& there, double x, double y) {
  double best = 6.0;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const double column = x + i, row = y + j;
      if (column < 0 || row < 0 || column >= wide_px || row >= high_px) continue;
      if (is_marked(there.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row))))
        best = std::min(best, std::hypot(i, j));
    }
  return best;
}

/// For all shifted marked pixels of `of`: the distance to the nearest of `there`, sorted.
std::vector<double> distances_px(const render::RadianceImage& of, const render::RadianceImage& there, double moved_px) {
  std::vector<double> distances;
  for (std::uint32_t y = 0; y < high_px; ++y)
    for (std::uint32_t x = 0; x < wide_px; ++x)
      if (is_marked(of.at(x, y))) distances.push_back(nearest_px(there, x + moved_px, y + moved_px));
  std::ranges::sort(distances);
  return distances;
}

}  // namespace

TEST_CASE("a crack stays in its place through the break of its slab, within a pixel of 1024 from seven metres") {
  Random random(1);
  const Vec3 slab_m(7.0, 0.3, 0.6);
  const debris::Piece slab = debris::make_part(debris::Part::ice_slab, {slab_m, orientation_from_angles(0.4, 0.5, 0.0)},
                                               Vec3(0.0), Vec3(0.0), random);
  debris::Piece pulled = slab;
  const auto& material = pulled.material;
  const double strain = 1.05 * material.strength_pa / material.elastic.young_modulus_pa;
  const Eigen::Vector3d middle = debris::to_eigen(slab_m);
  for (auto& x : pulled.body.position_m) x = middle + (1.0 + strain) * (x - middle);
  const debris::FractureResult broken = debris::fracture(pulled);
  REQUIRE(broken.pieces.size() > 2);
  render::Renderer renderer = software_renderer();
  instant::FrameInput input = seen_from({0.0, 0.0, 1.3}, 0.0);
  input.ice = {marked_body(slab)};
  const render::RadianceImage before = picture_of(renderer, input);
  input.ice.clear();
  for (const debris::Piece& piece : broken.pieces) input.ice.push_back(marked_body(piece));
  const render::RadianceImage after = picture_of(renderer, input);
  const std::vector<double> there = distances_px(after, before, 0.0), beside = distances_px(after, before, 4.0);
  REQUIRE(there.size() > 100);
  const auto share_within = [](const std::vector<double>& distances, double px) {
    return static_cast<double>(std::ranges::upper_bound(distances, px) - distances.begin()) /
           static_cast<double>(distances.size());
  };
  // The same pixel or one that touches it; newly uncovered ice is left over.
  constexpr double touching_px = 1.5;
  const double mean_px = std::accumulate(there.begin(), there.end(), 0.0) / static_cast<double>(there.size());
  MESSAGE(there.size() << " pixels of cracks after the break, " << mean_px << " px from one before, "
                       << share_within(there, touching_px) << " in the same or beside it; moved aside "
                       << share_within(beside, touching_px));
  CHECK(mean_px < 0.5);
  CHECK(share_within(there, touching_px) > 0.97);
  CHECK(share_within(beside, touching_px) < 0.6);
}

TEST_CASE("a slab's pixels lie on the roof that it lies on") {
  Snapshot snapshot;
  Participant lorry;
  lorry.id = 2;
  lorry.world_from_vehicle = {{16.0, 0.5, 0.0}, orientation_from_angles(0.3, 0.0, 0.0)};
  snapshot.participants.push_back(lorry);
  snapshot.environment.temperature_k = 268.0;
  ice::StillIce still;
  still.slabs = {{2, {-2.6, -0.2, 3.87}, {2.0, 1.2, 0.08}}, {2, {1.8, 0.5, 3.87}, {2.0, 1.2, 0.08}}};
  snapshot.effects.push_back({ice::effect_id, ice::keyframe_kind, ice::encode(still), 4});
  IceDrawing drawing;
  drawing.show(snapshot, {});
  instant::FrameInput input = seen_from({0.0, 0.0, 9.0}, 0.35);
  render::Renderer renderer = software_renderer();
  const render::RadianceImage bare = picture_of(renderer, input);
  drawing.add_to(input);
  REQUIRE(input.ice.size() == 2);
  const render::RadianceImage iced = picture_of(renderer, input);
  int pixels = 0, off_roof = 0;
  const double slack_m = 1.5 * px_slope * 16.0;
  for (std::uint32_t y = 0; y < high_px; ++y)
    for (std::uint32_t x = 0; x < wide_px; ++x) {
      if (glm::length(iced.at(x, y) - bare.at(x, y)) < 1e-3f) continue;
      ++pixels;
      // Where its ray passes between the slab's underside and its top, it is over the roof of 11.9 × 2.55 m.
      const Vec3 ray = instant::ray_through(input.views[0], x + 0.5, y + 0.5);
      bool over = false;
      for (const double height_m : {3.87, 3.91, 3.95}) {
        const Vec3 at = inverse(lorry.world_from_vehicle) * (Vec3(0, 0, 9.0) + (height_m - 9.0) / ray.z * ray);
        over |= std::abs(at.x - 1.7) < 5.95 + slack_m && std::abs(at.y) < 1.275 + slack_m;
      }
      off_roof += !over;
    }
  // Two slabs of 2 × 1.2 m from 16 m and 20° above, about.
  const double expected = 2.0 * 2.0 * 1.2 * 0.35 / std::pow(px_slope * 16.5, 2.0);
  MESSAGE(pixels << " pixels of slabs, " << off_roof << " off the roof; " << expected << " expected");
  CHECK(off_roof == 0);
  CHECK(pixels > 0.7 * expected);
  CHECK(pixels < 1.6 * expected);
}

TEST_CASE("icicles hang below their edge, no longer than they are, and are lighter than the dark behind them") {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene::SurfaceMaterial dark;
  dark.revision = 1;
  dark.base_color = glm::vec3(0.02f);
  scene.materials = {dark};
  scene::SurfaceMesh wall;
  wall.revision = 1;
  wall.vertices = {{{0, -8, -5}, {-1, 0, 0}, {}},
                   {{0, 8, -5}, {-1, 0, 0}, {}},
                   {{0, 8, 5}, {-1, 0, 0}, {}},
                   {{0, -8, 5}, {-1, 0, 0}, {}}};
  wall.indices = {0, 2, 1, 0, 3, 2, 0, 1, 2, 0, 2, 3};
  wall.parts = {{0, 12, 0}};
  wall.bounds_min_m = {0, -8, -5};
  wall.bounds_max_m = {0, 8, 5};
  scene.meshes = {wall};
  scene.instances.emplace_back().world_from_object.position_m = {14.0, 0.0, 3.0};
  const ice::IcicleRow row{{10.0, 2.0, 5.0}, {10.0, -2.0, 5.0}, 0.9, 7};
  instant::FrameInput input = seen_from({0.0, 0.0, 1.3}, -0.3);
  render::Renderer renderer = software_renderer();
  REQUIRE(renderer.upload(scene).has_value());
  const render::RadianceImage bare = picture_of(renderer, input);
  input.ice = {row_body(row, 0.0, 0.0f)};
  const render::RadianceImage iced = picture_of(renderer, input);
  const double edge = pixel_of(input, {10.0, 0.0, 5.0}).second, end = pixel_of(input, {10.0, 0.0, 4.1}).second;
  int pixels = 0, above = 0, below = 0;
  double lighter = 0.0;
  for (std::uint32_t y = 0; y < high_px; ++y)
    for (std::uint32_t x = 0; x < wide_px; ++x) {
      const float change = iced.at(x, y).g - bare.at(x, y).g;
      if (std::abs(change) < 1e-3f) continue;
      ++pixels;
      above += y + 1.0 < edge - 4.0;  // A root is some centimetres wide, and its near side is seen higher up.
      below += y > end + 4.0;
      lighter += change > 0.0f;
    }
  MESSAGE(pixels << " pixels of icicles, " << lighter / pixels << " of them lighter than the dark behind");
  CHECK(pixels > 500);
  CHECK(above == 0);
  CHECK(below == 0);
  CHECK(lighter > 0.9 * pixels);
}

}  // namespace septet::frame
