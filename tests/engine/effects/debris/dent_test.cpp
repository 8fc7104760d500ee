// Dents of a crash: their depth, their shape, and their few bytes.

#include "engine/effects/debris/dent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/world/vehicle_body.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// In the middle of a front that lies at x = 3.7 m.
Dent front_dent(double depth_m) {
  return {
      .place_m = {3.7, 0.1}, .heading_rad = std::numbers::pi, .depth_m = depth_m, .half_width_m = 0.4, .top_m = 0.8};
}

}  // namespace

TEST_CASE("residual crush grows with the speed above that which leaves nothing, and less beyond the crumple zone") {
  // Campbell: V = b0 + b1 C, here with b0 = 3 m/s and b1 = 23.5 /s.
  CHECK(residual_crush_m(2.9) == 0.0);
  CHECK(residual_crush_m(15.56) == doctest::Approx((15.56 - 3.0) / 23.5));  // The wall at 56 km/h: 0.53 m.
  CHECK(residual_crush_m(8.0) == doctest::Approx(5.0 / 23.5));
  const Crush& crush = passenger_car_crush();
  const double whole_mps = 3.0 + 23.5 * crush.crumple_m;
  CHECK(residual_crush_m(whole_mps + 2.35) == doctest::Approx(crush.crumple_m + 0.1 / std::sqrt(crush.harder_times)));
  CHECK(residual_crush_m(200.0) == most_depth_m);
  CHECK(residual_crush_m(std::nan("")) == 0.0);
}

TEST_CASE("what was struck is pushed in by the dent's depth, and what is beside, above or behind it is not") {
  const std::vector<Dent> dents{front_dent(0.3)};
  const Vec3 struck(3.7, 0.1, 0.5);
  const Vec3 way = dented(dents, struck) - struck;
  CHECK(way.x == relative(-0.3, 0.08));  // Up to its folds.
  CHECK(std::hypot(way.y, way.z) < 0.03);
  for (const Vec3& kept : {Vec3(3.7, 0.9, 0.5), Vec3(3.7, -0.7, 0.5), Vec3(3.7, 0.1, 1.35), Vec3(2.85, 0.1, 0.5)}) {
    CAPTURE(kept.x);
    CHECK(dented(dents, kept) == kept);
    CHECK_FALSE(reaches(dents, kept));
    CHECK(dented_normal(dents, kept, {0, 0, 1}).z == doctest::Approx(1.0));
  }
  CHECK(reaches(dents, struck));
}

TEST_CASE("sheet metal is pressed together and never through itself") {
  for (const double depth : {0.05, 0.2, 0.45, 0.7}) {
    CAPTURE(depth);
    const std::vector<Dent> dents{front_dent(depth)};
    for (const double y : {-0.2, 0.1, 0.5})
      for (const double z : {0.4, 0.75, 1.0}) {
        double before = INFINITY;
        for (double x = 3.8; x > 1.8; x -= 0.01) {
          const double now = dented(dents, {x, y, z}).x;
          REQUIRE(now < before);
          before = now;
        }
      }
  }
}

TEST_CASE("a normal stays across the sheet that it stood on") {
  const std::vector<Dent> dents{front_dent(0.4)};
  // A bonnet: level, its front edge pushed in and its middle raised.
  for (double x = 3.6; x > 2.9; x -= 0.07)
    for (const double y : {-0.3, 0.05, 0.6}) {
      const Vec3 at(x, y, 0.85), normal = dented_normal(dents, at, {0, 0, 1});
      CHECK(glm::length(normal) == doctest::Approx(1.0));
      for (const Vec3& step : {Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0)}) {
        const Vec3 along = glm::normalize(dented(dents, at + step) - dented(dents, at - step));
        CHECK(std::abs(glm::dot(along, normal)) < 0.01);
      }
    }
}

TEST_CASE("a blow where there is a dent deepens it, and of too many the shallowest gives way") {
  std::vector<DentedVehicle> vehicles;
  note_dent(7, front_dent(0.0), vehicles);
  CHECK(vehicles.empty());
  note_dent(7, front_dent(0.3), vehicles);
  note_dent(7, front_dent(0.4), vehicles);
  REQUIRE(vehicles.size() == 1);
  REQUIRE(vehicles[0].dents.size() == 1);
  CHECK(vehicles[0].dents[0].depth_m == doctest::Approx(0.5));
  for (int i = 1; i < 20; ++i) {
    Dent dent = front_dent(0.01 * i);
    dent.place_m.x -= 0.4 * i;
    note_dent(7, dent, vehicles);
  }
  REQUIRE(vehicles[0].dents.size() == most_dents);
  CHECK(std::ranges::min_element(vehicles[0].dents, {}, &Dent::depth_m)->depth_m == doctest::Approx(0.13));
  for (ParticipantId id = 100; id < 400; ++id) note_dent(id, front_dent(0.1), vehicles);
  CHECK(vehicles.size() == most_dented_vehicles);
}

TEST_CASE("all screens are told the same dent in a few bytes") {
  std::vector<DentedVehicle> vehicles{{2, {front_dent(0.337)}}, {4'000'000'000u, {front_dent(0.1), front_dent(0.9)}}};
  vehicles[1].dents[0].heading_rad = -1.0;
  const Bytes bytes = encode_dents(vehicles);
  CHECK(bytes.size() < 4 + 7 + 3 * 10);
  const auto told = decode_dents(bytes);
  REQUIRE(told);
  REQUIRE(told->size() == 2);
  CHECK(told->at(1).vehicle == 4'000'000'000u);
  const Dent &first = told->at(0).dents.at(0), &turned = told->at(1).dents.at(0);
  CHECK(first.place_m.x == doctest::Approx(3.7));
  CHECK(std::abs(first.depth_m - 0.337) <= 0.0025);
  CHECK(std::abs(std::remainder(turned.heading_rad + 1.0, 2.0 * std::numbers::pi)) <= std::numbers::pi / 256.0);
  CHECK(encode_dents(*told) == bytes);  // A decoded dent is encoded again without loss.
}

TEST_CASE("what a vehicle has lost is told beside its dents, and adds up over its crashes") {
  std::vector<DentedVehicle> vehicles;
  note_torn(5, 0, vehicles);
  CHECK(vehicles.empty());
  note_dent(2, front_dent(0.3), vehicles);
  const std::size_t before = encode_dents(vehicles).size();
  note_torn(5, bit_of(Mount::windscreen), vehicles);
  note_torn(5, bit_of(Mount::front_left_door), vehicles);
  const auto told = decode_dents(encode_dents(vehicles));
  REQUIRE(told);
  REQUIRE(told->size() == 2);
  CHECK(told->at(0).torn == 0);
  CHECK(told->at(0).dents.size() == 1);
  CHECK(told->at(1).vehicle == 5);
  CHECK(told->at(1).torn == (bit_of(Mount::windscreen) | bit_of(Mount::front_left_door)));
  CHECK(told->at(1).dents.empty());
  CHECK(encode_dents(vehicles).size() <= before + 6);
  vehicles[1].torn = static_cast<Mounts>(1u << mount_count);
  CHECK_FALSE(decode_dents(encode_dents(vehicles)));
}

TEST_CASE("bytes that tell no dents are refused, and dents that make no sense are told as some that do") {
  const Bytes bytes = encode_dents(std::vector<DentedVehicle>{{2, {front_dent(0.3), front_dent(0.2)}}});
  for (std::size_t length = 0; length < bytes.size(); ++length)
    CHECK_FALSE(decode_dents(std::span(bytes).first(length)));
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  CHECK_FALSE(decode_dents(longer));
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int value : {0, 1, 127, 128, 255}) {
      Bytes damaged = bytes;
      damaged[at] = static_cast<std::byte>(value);
      const auto told = decode_dents(damaged);
      if (!told) continue;
      for (const DentedVehicle& vehicle : *told)
        for (const Dent& dent : vehicle.dents) {
          CHECK(dent.depth_m <= most_depth_m);
          const Vec3 moved = dented(vehicle.dents, {dent.place_m, 0.5});
          CHECK(glm::length(moved - Vec3(dent.place_m, 0.5)) < 2.5);
        }
    }
  const double none = std::nan("");
  const Bytes odd = encode_dents(std::vector<DentedVehicle>{{2, {{{none, 1e300}, INFINITY, none, -1.0, none}}}});
  CHECK(decode_dents(odd));
}
