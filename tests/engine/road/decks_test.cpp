#include "engine/road/decks.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/road/crossing_roads.hpp"

namespace septet::road {
namespace {

std::vector<RoadStructure> decks_of(const RoadNetwork& network, const char* id) {
  return network.roads.at(find_road(network, id).value()).structures;
}

}  // namespace

TEST_CASE("a road over another one is a bridge from 3 m before its lanes to 3 m behind them, without the file's word") {
  for (const double angle_rad : {std::numbers::pi / 2, 0.7}) {
    CAPTURE(angle_rad);
    const RoadNetwork network = two_levels(6.0, angle_rad);
    CHECK(decks_of(network, "low").empty());
    const auto decks = decks_of(network, "high");
    REQUIRE(decks.size() == 1);
    CHECK(decks[0].kind == RoadStructure::Kind::bridge);
    CHECK((decks[0].over_road && decks[0].inferred));
    // The upper road is 11 m wide with its pavements.
    const double half_m = (3.5 + 5.5 * std::cos(angle_rad)) / std::sin(angle_rad) + deck_beyond_m;
    CHECK(std::abs(decks[0].s_m + 0.5 * decks[0].length_m - 200.0) < 1.0);
    CHECK(std::abs(0.5 * decks[0].length_m - half_m) < 2.0);
  }
}

TEST_CASE("roads on one level, close under one another, or beside one another are no bridges") {
  for (const RoadNetwork& network : {two_levels(0.0), two_levels(3.5), terraces(), sharp_bend()})
    for (const Road& road : network.roads) CHECK(road.structures.empty());
}

TEST_CASE("a road that turns over itself is a bridge over its own lanes") {
  const auto decks = decks_of(spiral(), "spiral");
  REQUIRE(decks.size() == 1);
  CHECK(decks[0].over_road);
  CHECK(decks[0].length_m > 150.0);
}

TEST_CASE("a bridge that the file gives is kept, and known to cross a road") {
  LaidRoad low{.id = "low", .x_m = -100, .pieces = {{200, 0}}};
  LaidRoad high{
      .id = "high", .y_m = -100, .heading_rad = std::numbers::pi / 2, .pieces = {{200, 0}}, .heights = {{0, 6, 0}}};
  high.objects = R"(<bridge id="given" s="80" length="40" type="concrete"/>)";
  const auto decks = decks_of(laid({low, high}), "high");
  REQUIRE(decks.size() == 1);
  CHECK(decks[0].id == "given");
  CHECK(decks[0].over_road);
  CHECK_FALSE(decks[0].inferred);
  // Earth lies between a tunnel and the road over it.
  high.objects = "";
  low.objects = R"(<tunnel id="tube" s="50" length="100" type="standard"/>)";
  CHECK(decks_of(laid({low, high}), "high").empty());
}

TEST_CASE("a deck that begins near a road's end goes on over the road that is linked there") {
  LaidRoad low{.id = "low", .x_m = -100, .pieces = {{200, 0}}};
  LaidRoad first{
      .id = "first", .y_m = -100, .heading_rad = std::numbers::pi / 2, .pieces = {{104, 0}}, .heights = {{0, 6, 0}}};
  first.link = R"(<successor elementType="road" elementId="second" contactPoint="start"/>)";
  LaidRoad second{
      .id = "second", .y_m = 4, .heading_rad = std::numbers::pi / 2, .pieces = {{96, 0}}, .heights = {{0, 6, 0}}};
  second.link = R"(<predecessor elementType="road" elementId="first" contactPoint="end"/>)";
  const RoadNetwork network = laid({low, first, second});
  const auto decks = decks_of(network, "second");
  REQUIRE(decks.size() == 1);
  CHECK(decks[0].s_m == 0.0);
  CHECK(decks[0].length_m > 1.5);
  CHECK(decks[0].length_m < deck_beyond_m + 1.0);
}

}  // namespace septet::road
