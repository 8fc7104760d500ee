#include "engine/effects/ice/still_ice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/effects/ice/objects.hpp"
#include "tests/relative.hpp"

namespace septet::ice {
namespace {

StillIce some_ice() {
  StillIce ice;
  ice.thawed_kh = 3.5;
  ice.slabs = {{3, {-2.6, -0.2, 3.87}, {2.0, 1.2, 0.08}}, {17, {0.5, 0.0, 1.5}, {1.0, 1.0, 0.02}}};
  ice.rows = {{{812.25, -40.5, 6.6}, {812.25, -44.5, 6.6}, 0.9, 12345},
              {{812.25, -44.5, 6.6}, {812.25, -48.5, 6.6}, 0.6, 7}};
  Sheet sheet;
  for (int i = 0; i < 9; ++i) {
    sheet.left_m.emplace_back(900.0 + i, 3.25, 12.0);
    sheet.right_m.emplace_back(900.0 + i, 0.5, 12.0);
  }
  ice.sheets = {sheet};
  return ice;
}

}  // namespace

TEST_CASE("ice melts by degree-hours as the integral of a day's temperature says") {
  // T = 272.15 K + 6 K sin(2πt/24 h): above freezing between the times where the sine is 1/6.
  const double mean_k = freezing_k - 1.0, swing_k = 6.0, day_s = 86400.0, step_s = 1.0 / 60.0 * 60.0;
  double thawed_kh = 0.0;
  for (double t = 0.0; t < day_s; t += step_s)
    thawed_kh += degree_hours(mean_k + swing_k * std::sin(2.0 * M_PI * (t + 0.5 * step_s) / day_s), step_s);
  const double begin = std::asin(1.0 / swing_k);
  const double expected_kh = 24.0 / (2.0 * M_PI) * (2.0 * swing_k * std::cos(begin) - (M_PI - 2.0 * begin));
  CHECK(thawed_kh == relative(expected_kh, 1e-6));
  CHECK(left_m(0.08, thawed_kh) == relative(0.08 - 0.008 / 24.0 * expected_kh, 1e-9));
  CHECK(left_m(0.004, 12.0) == doctest::Approx(0.0).scale(1.0));  // Four millimetres: twelve degree-hours.
  CHECK(left_m(0.004, 11.9) > 0.0);
  CHECK(degree_hours(260.0, 1e6) == 0.0);
}

TEST_CASE("an icicle that thaws keeps its slope and its neighbours fall one after the other until none is left") {
  const IcicleRow row{{0, 0, 5}, {6, 0, 5}, 0.9, 3};
  const auto whole = icicles_of(row, 0.0);
  REQUIRE(whole.size() > 15);
  std::size_t last = whole.size();
  for (const double thawed_kh : {5.0, 15.0, 30.0, 60.0, 150.0}) {
    const auto left = icicles_of(row, thawed_kh);
    CHECK(left.size() <= last);
    last = left.size();
    for (const Icicle& icicle : left) {
      const auto before = std::ranges::find_if(whole, [&](const Icicle& w) { return w.root_m == icicle.root_m; });
      REQUIRE(before != whole.end());
      CHECK(icicle.radius_m == doctest::Approx(before->radius_m - melt_m_per_kh * thawed_kh));
      CHECK(icicle.radius_m / icicle.length_m == doctest::Approx(before->radius_m / before->length_m));
    }
  }
  CHECK(last == 0);
  CHECK(!icicles_of(row, 60.0).empty());
  CHECK(icicles_of(row, 60.0).size() < whole.size());
}

TEST_CASE("icicles and boxes are closed and face outwards") {
  Surface icicle;
  append_icicle(icicle, {{3.0, 1.0, 5.0}, 0.04, 0.7}, {3.0, 0.0, 5.0});
  fit(icicle);
  CHECK(told(faults(icicle)).empty());
  Surface box = box_surface({-1.0, -0.6, -0.04}, {1.0, 0.6, 0.04}, 1, 1);
  fit(box);
  CHECK(told(faults(box)).empty());
}

TEST_CASE("still ice comes back from the wire to the millimetre") {
  const StillIce ice = some_ice();
  const auto read = decode(encode(ice));
  REQUIRE(read);
  CHECK(encode(*read) == encode(ice));
  CHECK(read->thawed_kh == 3.5);
  REQUIRE(read->slabs.size() == 2);
  CHECK(read->slabs[1].vehicle == 17);
  CHECK(glm::length(read->slabs[1].foot_m - ice.slabs[1].foot_m) < 1e-3);
  REQUIRE(read->rows.size() == 2);
  CHECK(glm::length(read->rows[1].to_m - ice.rows[1].to_m) < 1e-3);
  CHECK(read->rows[0].seed == 12345);
  REQUIRE(read->sheets.size() == 1);
  CHECK(read->sheets[0].thickness_m == doctest::Approx(0.004));
  for (std::size_t i = 0; i < 9; ++i) CHECK(glm::length(read->sheets[0].right_m[i] - ice.sheets[0].right_m[i]) < 1e-3);
}

TEST_CASE("bytes that no encoder wrote are refused") {
  const Bytes whole = encode(some_ice());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    CHECK(!decode(std::span(whole).first(size)).has_value());
  }
  Bytes longer = whole;
  longer.push_back(std::byte{0});
  CHECK(!decode(longer).has_value());
  Bytes other = whole;
  other[0] = std::byte{9};
  CHECK(!decode(other).has_value());
  for (std::size_t at = 1; at < whole.size(); ++at) {  // Any accepted bytes come back unchanged.
    Bytes changed = whole;
    changed[at] ^= std::byte{0xff};
    if (const auto read = decode(changed)) CHECK(decode(encode(*read)).has_value());
  }
}

TEST_CASE("what is no number or too much is written as the nearest that can be told") {
  StillIce ice = some_ice();
  ice.rows[0].from_m = {NAN, INFINITY, -1e30};
  ice.thawed_kh = NAN;
  ice.slabs[0].size_m = Vec3(1e30);
  ice.sheets.resize(most_sheets + 5, ice.sheets[0]);
  const auto read = decode(encode(ice));
  CHECK((!read || read->sheets.size() == most_sheets));
}

}  // namespace septet::ice
