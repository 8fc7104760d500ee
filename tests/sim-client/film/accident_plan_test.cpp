#include "sim-client/film/accident/accident_plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "engine/film_script/film_script.hpp"
#include "engine/film_script/script_text.hpp"
#include "engine/world/rider.hpp"
#include "engine/world/solid.hpp"
#include "sim-client/film/accident/read_plan.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/overlay/overlay_cast.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::film {
namespace {

constexpr double picture_shape = 16.0 / 9.0;

/// Two that cross at right angles: they meet at 6 s in the origin.
Snapshot crossing_world(Tick tick, bool with_driver) {
  Snapshot world;
  world.tick = tick;
  world.simulated_time_s = static_cast<double>(tick) / 120.0;
  const double until_s = world.simulated_time_s - 6.0;
  const auto add = [&](ParticipantId id, const Vec3& velocity_mps) {
    Participant participant;
    participant.id = id;
    participant.model = *find_vehicle_model("saloon");
    participant.world_from_vehicle = {until_s * velocity_mps,
                                      orientation_from_angles(std::atan2(velocity_mps.y, velocity_mps.x), 0, 0)};
    participant.velocity_mps = velocity_mps;
    world.participants.push_back(participant);
  };
  if (with_driver) add(1, {15.0, 0.0, 0.0});
  add(2, {0.0, 12.0, 0.0});
  add(3, {-10.0, 0.5, 0.0});
  world.driver_car.participant = with_driver ? 1 : 0;
  return world;
}

PlannedAccident planned(const TemporaryFolder& folder, const std::vector<logging::Event>& events, bool with_driver,
                        std::optional<std::size_t> event = std::nullopt,
                        const std::function<void(logging::SessionInfo&)>& alter = {}) {
  const auto file = folder / "session.sqlite";
  std::filesystem::remove(file);
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1":"ego","2":"crosser"})";
  info.other["driver"] = "novice";
  if (alter) alter(info);
  auto writer = logging::SessionWriter::create(file, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= 1200; tick += 1) writer->record(logging::taken(crossing_world(tick, with_driver)));
  for (const logging::Event& one : events) writer->record(one);
  REQUIRE(writer->finish().has_value());
  const auto session = logging::must_open(file);
  auto plan = read_plan(session, event, picture_shape);
  REQUIRE_MESSAGE(plan.has_value(), why_not(plan));
  return std::move(*plan);
}

logging::Event collision(double time_s, std::optional<ParticipantId> participant, const std::string& detail) {
  return {static_cast<Tick>(std::lround(120.0 * time_s)), time_s, "collision", participant, detail};
}

std::size_t shots_of(const AccidentPlan& plan, const std::string& word) {
  return static_cast<std::size_t>(std::ranges::count_if(
      plan.script.shots, [&](const Shot& shot) { return shot.title.find(word) != std::string::npos; }));
}

/// What every plan keeps to, whoever took part.
void check_is_a_film(const PlannedAccident& one) {
  const AccidentPlan& plan = one.plan;
  REQUIRE_FALSE(plan.script.shots.empty());
  CHECK(plan.words.size() == plan.script.shots.size());
  const std::string text = text_of(plan.script);
  const auto read = read_script(text, "storyboard.toml");
  REQUIRE_MESSAGE(read.has_value(), why_not(read));
  CHECK(text_of(*read) == text);
  const auto film = plan_film(*read, 25.0, one.facts.session_s);
  REQUIRE_MESSAGE(film.has_value(), why_not(film));
  for (const Shot& shot : plan.script.shots) {
    CHECK(shot.overlay);
    CHECK(shot.from_s >= one.facts.window_s.first);
    CHECK(shot.to_s <= one.facts.window_s.second);
  }
  CHECK(plan.script.overlay.notes.size() == 3);
}

}  // namespace

TEST_CASE(
    "an accident is planned from 5 s before its contact to 3 s after with each participant's eyes and both at once") {
  const TemporaryFolder folder;
  const auto one = planned(folder, {collision(6.0, 2, "closing_speed_mps=15.00 delta_v_mps=7.50")}, true);
  check_is_a_film(one);
  CHECK(one.facts.window_s == std::pair(1.0, 9.0));
  REQUIRE(one.facts.involved.size() == 2);
  CHECK(one.facts.involved[0].name == "ego");
  CHECK(one.facts.involved[0].moved_by == MovedBy::simulated_driver);
  CHECK(one.facts.involved[1].moved_by == MovedBy::scenario);
  const AccidentPlan& plan = one.plan;
  CHECK(plan.script.overlay.contact_s == 6.0);
  CHECK(plan.script.shots.front().from_s == 1.0);
  CHECK(plan.script.shots.front().to_s == 9.0);
  CHECK(plan.script.shots.front().paths);
  CHECK(shots_of(plan, "ego: eyes, gaze as logged") == 2);
  CHECK(shots_of(plan, "crosser: eyes, gaze assumed straight on") == 1);
  const auto both = std::ranges::find_if(plan.script.shots, [](const Shot& shot) { return shot.beside.has_value(); });
  REQUIRE(both != plan.script.shots.end());
  CHECK(both->participant == "ego");
  CHECK(both->beside->participant == "crosser");
  CHECK(std::ranges::count_if(plan.script.shots, [](const Shot& shot) { return shot.speed == 0.25; }) == 2);
  CHECK(plan.title == "ego and crosser meet, 6.00 s");
  const auto closing = std::ranges::find(plan.figures, "closing speed", &Figure::name);
  REQUIRE(closing != plan.figures.end());
  CHECK(closing->value == doctest::Approx(54.0));
  CHECK(text_of(planned(folder, {collision(6.0, 2, "closing_speed_mps=15.00 delta_v_mps=7.50")}, true).plan.script) ==
        text_of(plan.script));
}

TEST_CASE("ways, speeds and labels are the rider's once he has left his bicycle") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1":"ego","2":"cyclist"})";
  const auto world_at = [](Tick tick) {
    Snapshot world = crossing_world(tick, true);
    Participant& bicycle = world.participants[1];
    bicycle.model = *find_vehicle_model("bicycle");
    if (tick <= 720) return world;
    Participant rider = bicycle;
    rider.id = rider_of(bicycle.id);
    rider.model = *find_vehicle_model("pedestrian");
    rider.world_from_vehicle.position_m.x += 100.0;
    world.participants.push_back(rider);
    return world;
  };
  auto writer = logging::SessionWriter::create(file, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= 1200; ++tick) writer->record(logging::taken(world_at(tick)));
  writer->record(collision(6.0, 2, "closing_speed_mps=15.00"));
  REQUIRE(writer->finish().has_value());
  const auto session = logging::must_open(file);
  const auto planned = read_plan(session, {}, picture_shape);
  REQUIRE_MESSAGE(planned.has_value(), why_not(planned));
  const Involved& cyclist = planned->facts.involved[1];
  CHECK(vehicle_models()[cyclist.model].name == "bicycle");
  for (const WayPoint& point : cyclist.way) {
    const auto tick = static_cast<Tick>(std::lround(120.0 * point.time_s));
    const Vec3 bicycle_m = world_at(tick).participants[1].world_from_vehicle.position_m;
    CHECK(std::abs(point.position_m.x - bicycle_m.x - (tick <= 720 ? 0.0 : 100.0)) < 0.01);
  }
  const auto people = OverlayCast::of(session, planned->plan.script);
  REQUIRE_MESSAGE(people.has_value(), why_not(people));
  REQUIRE(people->ways.size() == 2);
  CHECK(people->ways[1].places_m.back().x - people->ways[1].places_m.front().x > 50.0);
}

TEST_CASE("a film of a drive by a table, and of a changed drive, says so") {
  const TemporaryFolder folder;
  const std::vector<logging::Event> events{collision(6.0, 2, "closing_speed_mps=15.00 delta_v_mps=7.50")};
  const auto given = planned(folder, events, true, {}, [](logging::SessionInfo& info) {
    info.files.push_back({"motion", "recorder.csv", "time_s,speed_mps\n"});
  });
  check_is_a_film(given);
  CHECK(given.facts.involved[0].moved_by == MovedBy::table);
  const std::vector<std::string>& notes = given.plan.script.overlay.notes;
  CHECK(notes[0] == "simulation from a log; given: the car's way, by recorder.csv");
  CHECK(notes[2].find("driver") == std::string::npos);
  CHECK(shots_of(given.plan, "ego: eyes, gaze assumed straight on") > 0);
  const auto changed = planned(folder, events, true, {},
                               [](logging::SessionInfo& info) { info.other["what_if_changes"] = "brake:-0.5s"; });
  CHECK(changed.plan.script.overlay.notes[0] == "simulation from a log; measured: nothing; changed: brake:-0.5s");
}

TEST_CASE("a contact whose record the log has brings its figures, and what was not measured brings none") {
  const TemporaryFolder folder;
  CrashRecord crash;
  crash.tick = 720;
  crash.first = 1;
  crash.second = 2;
  crash.closing_speed_mps = 15.0;
  crash.of_first.delta_v_mps = Vec2(-8.0, 6.0);
  crash.of_first.principal_direction_rad = 0.5 * std::numbers::pi;
  crash.ledger = CrashLedger{200e3, 120e3, 70e3, 6e3, 500.0, 3500.0};
  const logging::Event record{734, 6.12, std::string(crash_event), 1, text_of(crash)};
  const auto one = planned(folder, {collision(6.0, 2, "closing_speed_mps=15.00 delta_v_mps=7.50"), record}, true);
  const auto figure = [&](const std::string& name) {
    const auto found = std::ranges::find_if(
        one.plan.figures, [&](const Figure& each) { return each.name.find(name) != std::string::npos; });
    return found == one.plan.figures.end() ? std::optional<double>() : std::optional(found->value);
  };
  CHECK(figure("ego, change of velocity in the crash").value_or(0.0) == doctest::Approx(36.0));
  CHECK(figure("ego, principal direction").value_or(0.0) == doctest::Approx(90.0));
  CHECK(figure("energy of the crush").value_or(0.0) == doctest::Approx(70.0));
  CHECK_FALSE(figure("crosser, change of velocity").has_value());
  CHECK_FALSE(figure("by the contact").has_value());
  CHECK_FALSE(figure("overlap").has_value());
  CHECK_FALSE(figure(", crush").has_value());
}

TEST_CASE("from above all of both ways lies within the picture") {
  const TemporaryFolder folder;
  const auto one = planned(folder, {collision(6.0, 2, "closing_speed_mps=15.00")}, true);
  const Shot& above = one.plan.script.shots.front();
  REQUIRE(above.place_m.has_value());
  const auto view = instant::symmetric_view(*above.place_m, above.heading_rad, above.pitch_rad, above.field_of_view_rad,
                                            2.0 * std::atan(std::tan(0.5 * above.field_of_view_rad) / picture_shape));
  for (const Involved& each : one.facts.involved)
    for (const WayPoint& at : each.way) {
      const auto clip = view.clip_from_eye_relative * glm::dvec4(at.position_m - view.eye_m, 1.0);
      CHECK(clip.w > 0.0);
      CHECK(std::abs(clip.x) < clip.w);
      CHECK(std::abs(clip.y) < clip.w);
    }
}

TEST_CASE("without a contact the nearest approach is planned and said to be one") {
  const TemporaryFolder folder;
  const auto one = planned(folder, {}, true);
  check_is_a_film(one);
  CHECK_FALSE(one.facts.chosen.has_value());
  REQUIRE(one.facts.nearest_s.has_value());
  CHECK(std::abs(*one.facts.nearest_s - 6.0) <= 0.1);
  CHECK(one.plan.title.find("no contact") == 0);
  REQUIRE(one.facts.involved.size() == 2);
  CHECK(one.facts.involved[0].name == "ego");  // 2 and 3 come as near to each other.
  CHECK(one.plan.script.overlay.contact == "the nearest approach");
  CHECK(one.plan.script.overlay.notes[2].find("impact") == std::string::npos);
}

TEST_CASE(
    "the nearest approach is that of the outlines, not of the middles, and its distance stands in title, words and "
    "figures") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1":"ego","2":"lorry","3":"walker","4":"above"})";
  auto writer = logging::SessionWriter::create(file, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  const VehicleModel &saloon = vehicle_models()[*find_vehicle_model("saloon")],
                     &lorry = vehicle_models()[*find_vehicle_model("lorry")];
  // The lorry's rear passes 0.4 m ahead of the car's front at 8 s, its middle far away; at 4 s the walker is 1.5 m beside
  // the car's flank, much nearer to its middle. Somebody crosses 6 m higher.
  const double rear_gap_m = 0.4, beside_m = 1.5;
  for (Tick tick = 0; tick <= 1200; ++tick) {
    Snapshot world;
    world.tick = tick;
    world.simulated_time_s = static_cast<double>(tick) / 120.0;
    const auto add = [&](ParticipantId id, const char* model, const Vec3& position_m) {
      Participant participant;
      participant.id = id;
      participant.model = *find_vehicle_model(model);
      participant.world_from_vehicle.position_m = position_m;
      world.participants.push_back(participant);
    };
    const double lorry_from_s = std::abs(world.simulated_time_s - 8.0),
                 walker_from_s = std::abs(world.simulated_time_s - 4.0);
    add(1, "saloon", Vec3(0.0));
    add(2, "lorry", Vec3(saloon.front_m() + rear_gap_m + lorry.rear_overhang_m + lorry_from_s, 0.0, 0.0));
    const double walker_half_m = 0.5 * vehicle_models()[*find_vehicle_model("pedestrian")].width_m;
    add(3, "pedestrian",
        Vec3(saloon.centre_x_m(), 0.5 * saloon.width_m + beside_m + walker_half_m + walker_from_s, 0.0));
    add(4, "saloon", Vec3(0.0, 0.0, 6.0));
    world.driver_car.participant = 1;
    writer->record(logging::taken(world));
  }
  REQUIRE(writer->finish().has_value());
  const auto plan = read_plan(logging::must_open(file), std::nullopt, picture_shape);
  REQUIRE_MESSAGE(plan.has_value(), why_not(plan));
  REQUIRE(plan->facts.involved.size() == 2);
  CHECK(plan->facts.involved[1].name == "lorry");
  CHECK(std::abs(plan->facts.nearest_s.value_or(0.0) - 8.0) < 0.1);
  CHECK(plan->facts.nearest_m == relative(rear_gap_m, 1e-3));
  CHECK(plan->plan.title == "no contact: ego and lorry come within 0.40 m, 8.00 s");
  CHECK(std::ranges::any_of(plan->plan.words, [](const std::string& words) {
    return words == "The nearest approach: 0.40 m between their outlines.";
  }));
  const auto told = std::ranges::find(plan->plan.figures, "distance of the two outlines then", &Figure::name);
  REQUIRE(told != plan->plan.figures.end());
  CHECK(told->value == plan->facts.nearest_m);
}

TEST_CASE("a contact with a solid is labelled by the name that the event has, else by its number") {
  const TemporaryFolder folder;
  const auto title_of = [&](const std::string& detail) {
    const auto file = folder / "session.sqlite";
    std::filesystem::remove(file);
    auto writer = logging::SessionWriter::create(file, logging::example_info());
    REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
    for (Tick tick = 0; tick <= 1200; ++tick) {
      Snapshot world = crossing_world(tick, true);
      world.participants[2].id = first_solid_participant;
      writer->record(logging::taken(world));
    }
    writer->record(logging::Event{1, 0.0, std::string(logging::operator_command_kind), std::nullopt,
                                  "stand solid=0 x_m=0 name=\"stimuli/later\""});
    writer->record(collision(6.0, first_solid_participant, detail));
    REQUIRE(writer->finish().has_value());
    auto plan = read_plan(logging::must_open(file), std::nullopt, picture_shape);
    REQUIRE_MESSAGE(plan.has_value(), why_not(plan));
    CHECK(plan->facts.involved[1].moved_by == MovedBy::editor);
    return plan->plan.title;
  };
  CHECK(title_of("closing_speed_mps=4.00 by=driver what=\"stimuli/wall\"").ends_with("and stimuli/wall meet, 6.00 s"));
  CHECK(title_of("closing_speed_mps=4.00 by=driver").ends_with("and stimuli/later meet, 6.00 s"));
}

TEST_CASE("of three contacts the first is planned unless another is asked for by its number") {
  const TemporaryFolder folder;
  const std::vector events{collision(6.0, 2, "closing_speed_mps=15.00"),
                           collision(7.0, std::nullopt, "guard rail closing_speed_mps=4.00"),
                           collision(8.0, 3, "closing_speed_mps=2.00")};
  CHECK(planned(folder, events, true).facts.involved[1].number == 2);
  const auto third = planned(folder, events, true, 3);
  check_is_a_film(third);
  CHECK(third.facts.involved[1].number == 3);
  CHECK(third.plan.script.overlay.participants == std::vector<std::string>{"ego", "3"});
  const auto rail = planned(folder, events, true, 2);
  check_is_a_film(rail);
  CHECK(rail.facts.involved.size() == 1);
  CHECK(rail.plan.title == "ego meets guard rail, 7.00 s");
  const auto both =
      std::ranges::find_if(rail.plan.script.shots, [](const Shot& shot) { return shot.beside.has_value(); });
  REQUIRE(both != rail.plan.script.shots.end());
  CHECK(both->beside->place_m.has_value());
  const auto session = logging::must_open(folder / "session.sqlite");
  const auto fourth = read_accident(session, 4);
  CHECK(why_not(fourth).find("3 contacts") != std::string::npos);
}

TEST_CASE("a contact of two others is planned though there is no driver") {
  const TemporaryFolder folder;
  const logging::Event crash{720, 6.0, "crash_of_others", 2, "with=3 closing_speed_mps=12.00 delta_v_mps=6.00 by=2"};
  const auto one = planned(folder, {crash}, false);
  check_is_a_film(one);
  REQUIRE(one.facts.involved.size() == 2);
  CHECK(one.facts.involved[0].number == 2);
  CHECK(one.facts.involved[1].number == 3);
  CHECK(one.facts.involved[1].moved_by == MovedBy::traffic);
  CHECK(shots_of(one.plan, "as logged") == 0);
  CHECK(one.plan.script.overlay.notes[0].find("measured: nothing") != std::string::npos);
  check_is_a_film(planned(folder, {}, false));
}

}  // namespace septet::film
