#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/piece.hpp"
#include "tests/engine/effects/debris/all_keyframes.hpp"

#include <doctest/doctest.h>

using namespace septet;
using namespace septet::debris;

namespace {
State scene() {
  State state;
  Random random(1);
  spawn_part(state, Part::bumper, {{12345.678, -9876.543, 1.2}, {1, 0, 0, 0}}, Vec3(0), Vec3(0), random);
  state.shards.push_back({{5, 6, 7}});
  return state;
}
}  // namespace

TEST_CASE("a keyframe comes back within half a millimetre and with the same triangles") {
  const Keyframe sent = keyframe_of(scene().pieces[0]);
  const auto received = decode(encode(sent));
  REQUIRE(received.has_value());
  CHECK(received->part == sent.part);
  CHECK(received->triangles == sent.triangles);
  REQUIRE(received->vertices_m.size() == sent.vertices_m.size());
  for (std::size_t i = 0; i < sent.vertices_m.size(); ++i)
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(received->vertices_m[i][c] - sent.vertices_m[i][c]) <= 0.5 * position_quantum_m + 1e-9);
}

TEST_CASE("ice brings its places at rest, which stay where they were however the piece moves") {
  Random random(3);
  Piece slab =
      make_part(Part::ice_slab, {{500, -20, 4}, orientation_from_angles(1.0, 0.2, 0.0)}, Vec3(0), Vec3(0), random);
  const Keyframe sent = keyframe_of(slab);
  REQUIRE(sent.rest_m.size() == sent.vertices_m.size());
  const auto received = decode(encode(sent));
  REQUIRE(received.has_value());
  for (std::size_t i = 0; i < sent.rest_m.size(); ++i)
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(received->rest_m[i][c] - sent.rest_m[i][c]) <= 0.5 * position_quantum_m + 1e-9);
  for (auto& place : slab.body.position_m) place.x() += 3.0;
  CHECK(keyframe_of(slab).rest_m == sent.rest_m);
  const Bytes good = encode(sent);
  for (std::size_t length = 0; length < good.size(); length += 3)
    CHECK_FALSE(decode(std::span(good).first(length)).has_value());
}

TEST_CASE("a piece of a vehicle tells whose it was and where in the whole part it belongs, whole, bent or broken") {
  Random random(5);
  for (const Part part : {Part::bumper, Part::door, Part::lamp}) {
    Piece piece = make_part(part, {{40, -3, 1}, orientation_from_angles(0.4, 0.1, 0.0)}, Vec3(0), Vec3(0), random);
    piece.origin = PieceOrigin{77, 3, 9, Mount::rear_bumper};
    for (std::size_t i = 0; i < piece.body.position_m.size(); ++i) piece.body.position_m[i].z() += 0.01 * double(i % 3);
    const Keyframe sent = keyframe_of(piece);
    const auto received = decode(encode(sent));
    REQUIRE(received.has_value());
    CHECK(received->origin == piece.origin);
    REQUIRE(received->lattice_nodes.size() == sent.vertices_m.size());
    // The first vertex of the first triangle is that node's.
    for (std::size_t n = 0; n < piece.surface.size(); ++n)
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 rest = from_eigen(piece.body.rest_position_m[piece.surface[n].nodes[c]]);
        const Vec3 told = lattice_place_m(part, received->lattice_nodes[received->triangles[n][c]]);
        CHECK(std::abs(told.x - rest.x) + std::abs(told.y - rest.y) + std::abs(told.z - rest.z) < 1e-9);
      }
    // Without an origin it costs nothing; with one, a byte a vertex and six at most.
    piece.origin.reset();
    const std::size_t with = encode(sent).size(), without = encode(keyframe_of(piece)).size();
    CHECK(with <= without + sent.vertices_m.size() + 6);
  }
}

TEST_CASE("an origin that no vehicle or part has is refused") {
  Random random(5);
  Piece piece = make_part(Part::door, {{4, 3, 1}, {1, 0, 0, 0}}, Vec3(0), Vec3(0), random);
  piece.origin = PieceOrigin{77, 3, 9, Mount::front_left_door};
  const Keyframe good = keyframe_of(piece);
  CHECK(decode(encode(good)).has_value());
  Keyframe bad = good;
  bad.origin->mount = static_cast<Mount>(mount_count);
  CHECK_FALSE(decode(encode(bad)).has_value());
  bad = good;
  bad.origin->model = static_cast<ModelIndex>(vehicle_models().size());
  CHECK_FALSE(decode(encode(bad)).has_value());
  bad = good;
  bad.lattice_nodes[2] = static_cast<std::uint8_t>(lattice_node_count(Part::door));
  CHECK_FALSE(decode(encode(bad)).has_value());
  const Bytes bytes = encode(good);
  for (std::size_t length = 0; length < bytes.size(); length += 3)
    CHECK_FALSE(decode(std::span(bytes).first(length)).has_value());
}

TEST_CASE("the snapshot gets one effect for the shards and one per piece in ascending order") {
  const auto effects = effect_keyframes(scene());
  REQUIRE(effects.size() == 2);
  CHECK(effects[0].id == first_effect_id);
  CHECK(effects[0].id < effects[1].id);
  for (const auto& effect : effects) {
    CHECK(effect.kind == keyframe_kind);
    CHECK(decode(effect.data).has_value());
  }
}

TEST_CASE("cut and damaged keyframes are refused or read within bounds and never crash") {
  const Bytes good = encode(keyframe_of(scene().pieces[0]));
  for (std::size_t length = 0; length < good.size(); ++length)
    CHECK_FALSE(decode(std::span(good).first(length)).has_value());
  Random random(9);
  int refused = 0;
  for (int k = 0; k < 5000; ++k) {
    Bytes bad = good;
    for (int flips = 0; flips < 4; ++flips) bad[random.below(bad.size())] = static_cast<std::byte>(random.below(256));
    const auto result = decode(bad);
    if (!result) {
      ++refused;
      continue;
    }
    for (const auto& triangle : result->triangles)
      for (const auto index : triangle) REQUIRE(index < result->vertices_m.size());
  }
  CHECK(refused > 100);
}
