#include "sim-client/sight/sight_program.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/document/table_line.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/world/rider.hpp"
#include "sim-client/sight/pairs.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/why_not.hpp"

namespace septet::sight {
namespace {
namespace fs = std::filesystem;

constexpr Tick last_tick = 240, left_tick = 120;
constexpr ParticipantId driver = 1, crosser = 4;

/// The driver's car drives along x towards a walker who comes from the right behind a wall; they touch at tick 228.
Snapshot crossing(Tick tick) {
  Snapshot world;
  world.tick = tick;
  world.simulated_time_s = static_cast<double>(tick) / 120.0;
  const auto add = [&](ParticipantId id, const char* model, const Vec3& place_m, double heading_rad) {
    Participant participant;
    participant.id = id;
    participant.model = *find_vehicle_model(model);
    participant.world_from_vehicle = {place_m, orientation_from_angles(heading_rad, 0.0, 0.0)};
    world.participants.push_back(participant);
  };
  add(driver, "volvo-s80", {10.0 * world.simulated_time_s, 0.0, 0.0}, 0.0);
  add(crosser, "pedestrian", {23.0, -3.0 + 1.5 * world.simulated_time_s, 0.0}, 1.5707963);
  world.driver_car.participant = driver;
  return world;
}

/// A cyclist who leaves the machine at tick 120 for a place 12 m to its left.
Snapshot thrown_cyclist(Tick tick) {
  Snapshot world = crossing(tick);
  world.participants.back().model = *find_vehicle_model("bicycle");
  if (tick < left_tick) return world;
  Participant rider = world.participants.back();
  rider.id = rider_of(crosser);
  rider.model = *find_vehicle_model("pedestrian");
  rider.world_from_vehicle.position_m.y += 12.0;
  world.participants.push_back(rider);
  return world;
}

fs::path record_crossing(const fs::path& file, bool with_scene, Snapshot (*world_at)(Tick) = crossing) {
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1": "ego", "4": "walker"})";
  auto writer = logging::SessionWriter::create(file, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  if (with_scene) {
    scene::Store store;
    scene::SceneBuilder builder(store, [&](const scene::Command& command) {
      Bytes bytes;
      scene::encode(command, bytes);
      writer->record(logging::SceneEdit{0, std::move(bytes)});
    });
    scenery::build_vehicles(builder);
    scene::ObjectParameters wall;
    wall.geometry = builder.add_mesh("wall", geometry::box({10.0f, -9.0f, 0.0f}, {22.0f, -1.6f, 3.0f}));
    wall.materials.push_back(builder.add_material("brick", {.roughness = 1.0f}));
    builder.add_object("wall", wall);
  }
  for (Tick tick = 0; tick <= last_tick; ++tick) writer->record(logging::taken(world_at(tick)));
  writer->record(logging::Event{.tick = 228,
                                .simulated_time_s = 1.9,
                                .kind = "collision",
                                .participant = crosser,
                                .detail = "closing_speed_mps=10.00"});
  REQUIRE(writer->finish().has_value());
  return file;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Row {
  Tick tick = 0;
  ParticipantId observer = 0, target = 0;
  double distance_m = 0.0, share = 0.0, transmittance = 0.0;
};

/// Rows of straight sight.
std::vector<Row> straight_rows(const fs::path& file) {
  std::istringstream lines(text_of(file));
  std::string line;
  std::getline(lines, line);
  REQUIRE(line == "time_s,tick,observer,target,mirror,distance_m,share,transmittance,size_deg2");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const auto cells = document::cells_of(line);
    REQUIRE(cells.size() == 9);
    if (!cells[4].empty()) continue;
    rows.push_back({*document::number_in<Tick>(cells[1]), *document::number_in<ParticipantId>(cells[2]),
                    *document::number_in<ParticipantId>(cells[3]), *document::number_in<double>(cells[5]),
                    *document::number_in<double>(cells[6]), *document::number_in<double>(cells[7])});
  }
  return rows;
}

}  // namespace

TEST_CASE("a session's sight is told both ways, and sentence, table and ticks agree") {
  const TemporaryFolder folder;
  SightOptions options;
  options.session = record_crossing(folder / "session.sqlite", true);
  options.out = folder / "sight";
  const auto done = run_sight(options);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  CHECK(*done == 0);
  const std::string text = text_of(options.out / "sight.txt");
  CAPTURE(text);
  const auto rows = straight_rows(options.out / "sight.csv");
  struct Way {
    ParticipantId observer, target;
    const char *observer_name, *target_name;
  };
  for (const Way& way : {Way{driver, crosser, "1 ego (volvo-s80)", "4 walker (pedestrian)"},
                         Way{crosser, driver, "4 walker (pedestrian)", "1 ego (volvo-s80)"}}) {
    const Row *before = nullptr, *first = nullptr;
    for (const Row& row : rows)
      if (row.observer == way.observer && row.target == way.target && !first)
        (row.share * row.transmittance >= 0.05 ? first : before) = &row;
    REQUIRE(first);
    REQUIRE(before);  // At the beginning the wall is between them.
    CHECK(before->tick < first->tick);
    const double first_s = static_cast<double>(first->tick) / 120.0;
    const std::string words =
        fmt::format("{} was unobstructed for {} from {:.2f} s on, {:.1f} m away, {:.2f} s before the contact at 1.90 s",
                    way.target_name, way.observer_name, first_s, first->distance_m, 1.9 - first_s);
    CAPTURE(words);
    CHECK(text.find(words) != std::string::npos);
    // Straight lines past the wall's corner: the walker's front is there from about here on.
    CHECK(first_s > 0.3);
    CHECK(first_s < 1.5);
  }
  CHECK(text_of(options.out / "sight.svg").find("</svg>") != std::string::npos);

  // Samples as dense as ticks find the same first tick: halving has missed none.
  SightOptions each_tick = options;
  each_tick.out = folder / "dense";
  each_tick.every_s = 1.0 / 120.0;
  each_tick.mirrors = false;
  REQUIRE(run_sight(each_tick).has_value());
  CHECK(text_of(each_tick.out / "sight.txt").substr(0, 90) == text.substr(0, 90));
}

TEST_CASE("sight is counted to the contact of two others as to one of the driver's car, and their pair comes first") {
  const TemporaryFolder folder;
  constexpr ParticipantId parked = 7;
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1": "ego", "4": "walker", "7": "parked"})";
  auto writer = logging::SessionWriter::create(folder / "session.sqlite", info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= last_tick; ++tick) {
    Snapshot world = crossing(tick);
    world.participants.push_back({.id = parked, .model = *find_vehicle_model("saloon")});
    writer->record(logging::taken(world));
  }
  writer->record(logging::Event{.tick = 180,
                                .simulated_time_s = 1.5,
                                .kind = "crash_of_others",
                                .participant = crosser,
                                .detail = "with=7 closing_speed_mps=1.50 by=4"});
  writer->record(logging::Event{.tick = 190,
                                .simulated_time_s = 190.0 / 120.0,
                                .kind = "crash_of_others",
                                .participant = parked,
                                .detail = "post closing_speed_mps=2.00"});
  REQUIRE(writer->finish().has_value());
  const auto session = logging::SessionReader::open(folder / "session.sqlite");
  REQUIRE_MESSAGE(session.has_value(), why_not(session));
  PairChoice choice{.eyes = "parked", .target = "walker", .from_s = 0.0, .to_s = 2.0};
  const auto both = choose_pairs(*session, choice);
  REQUIRE_MESSAGE(both.has_value(), why_not(both));
  CHECK(both->front().contact_s == std::optional(1.5));
  // The driver's car is nearer, at its start.
  choice.target.clear();
  const auto all = choose_pairs(*session, choice);
  REQUIRE_MESSAGE(all.has_value(), why_not(all));
  REQUIRE(all->size() == 2);
  CHECK(all->front().second.number == crosser);
  CHECK_FALSE(all->back().contact_s.has_value());
}

TEST_CASE("a session without a scene, unknown names and empty spans are refused in one line and nothing is written") {
  const TemporaryFolder folder;
  SightOptions options;
  options.session = record_crossing(folder / "bare.sqlite", false);
  options.out = folder / "sight";
  const auto refused = [&] {
    const auto done = run_sight(options);
    const std::string line = why_not(done);
    CHECK(line.find('\n') == std::string::npos);
    CHECK_FALSE(fs::exists(options.out));
    return line;
  };
  CHECK(refused().find("keeps no scene") != std::string::npos);
  // Where the results could not be written nothing is worked out: the scene is not even looked for.
  options.out = options.session / "sight";
  CHECK(refused().find("choose a folder that can be written") != std::string::npos);
  options.out = folder / "sight";
  options.eyes = "tram";
  CHECK(refused().find("nobody called \"tram\"") != std::string::npos);
  options.eyes = options.target = "walker";
  CHECK(refused().find("nobody looks at themselves") != std::string::npos);
  options.eyes.clear(), options.target.clear();
  options.range_m = 1.0;
  CHECK(refused().find("--range") != std::string::npos);
  options.from_s = 7.0;
  CHECK(refused().find("not a part of the session") != std::string::npos);
  options.session = folder / "none.sqlite";
  CHECK(refused().find("none.sqlite") != std::string::npos);
}

TEST_CASE("sight goes on with the rider who has left the machine, both ways, and says from when on") {
  const TemporaryFolder folder;
  SightOptions options;
  options.session = record_crossing(folder / "session.sqlite", true, thrown_cyclist);
  options.out = folder / "sight";
  options.mirrors = false;
  const auto done = run_sight(options);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  const auto rows = straight_rows(options.out / "sight.csv");
  bool looks_back = false;
  for (const Row& row : rows) {
    CAPTURE(row.tick);
    CHECK(((row.observer == driver && row.target == crosser) || (row.observer == crosser && row.target == driver)));
    looks_back |= row.observer == crosser && row.tick >= left_tick;
    if (row.observer != driver) continue;
    const double time_s = static_cast<double>(row.tick) / 120.0, aside_m = row.tick < left_tick ? 0.0 : 12.0;
    const double level_m = std::hypot(23.0 - 10.0 * time_s, -3.0 + 1.5 * time_s + aside_m);
    CHECK(std::abs(row.distance_m - level_m) < 1.5);  // The driver's eyes are ahead of and above the car's origin.
    if (row.tick == left_tick) CHECK(row.share > 0.5);
  }
  CHECK(looks_back);
  const std::string text = text_of(options.out / "sight.txt");
  CAPTURE(text);
  CHECK(text.find("from 1.00 s on 4 walker is the rider, off the machine") != std::string::npos);
  CHECK(text.find("8196") == std::string::npos);
}

}  // namespace septet::sight
