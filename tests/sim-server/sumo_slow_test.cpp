// Drives with SUMO as the traffic's engine, with the real program. Without SUMO on this machine they say so and pass.

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>

#include "engine/road/road_locate.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/server_step.hpp"
#include "program/resources.hpp"
#include "program/temporary_folder.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/traffic_choice.hpp"
#include "sim-server/sumo/sumo_client.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/road/road_text.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

bool has_sumo() {
  if (load_sumo_module() && ::access("/usr/bin/sumo", X_OK) == 0) return true;
  MESSAGE("skipped: SUMO is not installed");
  return false;
}

std::shared_ptr<const simulation::Model> motorway() {
  ::setenv("SEPTET_DATA", source_folder().c_str(), 1);
  const auto scenario = program::find_resource("behind-ambulance", "scenarios", ".xosc");
  const auto rig = program::find_resource("desktop", "rigs", ".toml");
  REQUIRE(scenario.has_value());
  REQUIRE(rig.has_value());
  auto drive = load_drive(DriveFiles{scenario->string(), rig->string(), 1});
  REQUIRE(drive.has_value());
  return drive->model;
}

/// Lanes of a road's two lane sections to the right of the reference line, and the road's course.
struct RoadText {
  std::string shape, first, second;
};

std::string lane_text(int id, const std::string& type, const std::string& link,
                      const std::string& width = R"(a="3.5" b="0" c="0" d="0")") {
  return fmt::format(R"(<lane id="{}" type="{}"><link>{}</link><width sOffset="0" {}/></lane>)", id, type, link, width);
}

/// 600 m with a limit, the driver's car at 60 m, twelve vehicles asked for.
std::shared_ptr<const simulation::Model> own_road(const std::filesystem::path& folder, const RoadText& text) {
  ::setenv("SEPTET_DATA", source_folder().c_str(), 1);
  const std::string left = road::left_lanes(1);
  const road::SmallRoad road{
      .length_m = 600.0,
      .geometry = text.shape,
      .sections = road::lane_section(left, text.first) +
                  (text.second.empty() ? std::string() : road::lane_section(left, text.second, 300.0)),
      .id = "7",
      .before_plan = R"(<type s="0" type="town"><speed max="50" unit="km/h"/></type>)"};
  std::ofstream(folder / "road.xodr") << road.xml();
  std::ofstream(folder / "road.xosc")
      << R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="2" date="2026-01-01T00:00:00" author="a" description="d"/>
<ParameterDeclarations/><CatalogLocations/><RoadNetwork><LogicFile filepath="road.xodr"/></RoadNetwork>
<Entities><ScenarioObject name="ego"><Vehicle name="volvo-s80" vehicleCategory="car" mass="1677"><BoundingBox><Center x="1.3" y="0" z="0.72"/>
<Dimensions width="1.83" length="4.82" height="1.44"/></BoundingBox><Performance maxSpeed="60" maxAcceleration="4" maxDeceleration="9"/><Axles>
<FrontAxle maxSteering="0.6" wheelDiameter="0.64" trackWidth="1.57" positionX="2.79" positionZ="0.32"/>
<RearAxle maxSteering="0" wheelDiameter="0.64" trackWidth="1.57" positionX="0" positionZ="0.32"/></Axles><Properties/></Vehicle></ScenarioObject></Entities>
<Storyboard><Init><Actions><GlobalAction><TrafficAction trafficName="t"><TrafficSwarmAction innerRadius="15" semiMajorAxis="560" semiMinorAxis="560" offset="0" numberOfVehicles="12">
<CentralObject entityRef="ego"/></TrafficSwarmAction></TrafficAction></GlobalAction><Private entityRef="ego"><PrivateAction><TeleportAction><Position>
<LanePosition roadId="7" laneId="-1" s="60" offset="0"/></Position></TeleportAction></PrivateAction><PrivateAction><LongitudinalAction><SpeedAction>
<SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/><SpeedActionTarget><AbsoluteTargetSpeed value="10"/></SpeedActionTarget></SpeedAction>
</LongitudinalAction></PrivateAction></Private></Actions></Init><StopTrigger/></Storyboard></OpenSCENARIO>)";
  const auto rig = program::find_resource("desktop", "rigs", ".toml");
  REQUIRE(rig.has_value());
  auto drive = load_drive(DriveFiles{(folder / "road.xosc").string(), rig->string(), 1});
  REQUIRE_MESSAGE(drive.has_value(), why_not(drive));
  return drive->model;
}

/// A drive with the accelerator held, tick by tick.
struct Ride {
  std::shared_ptr<const simulation::Model> model;
  simulation::State state;
  std::vector<simulation::Event> events;
  DriverInput input;

  explicit Ride(const std::string& engine, std::shared_ptr<const simulation::Model> of = motorway())
      : model(std::move(of)) {
    auto traffic = open_traffic(engine, *model);
    INFO(why_not(traffic));
    REQUIRE(traffic.has_value());
    auto begun = simulation::initial_state(*model, std::move(*traffic));
    INFO(why_not(begun));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    input.accelerator = 0.3;
  }
  Snapshot step() { return simulation::server_step(*model, input, state, events); }
};

std::vector<Participant> traffic_of(const Snapshot& snapshot) {
  std::vector<Participant> traffic;
  for (const auto& p : snapshot.participants)
    if (p.id >= simulation::first_traffic_participant) traffic.push_back(p);
  return traffic;
}

}  // namespace

TEST_CASE("SUMO moves the swarm that the scenario asks for and every tick follows from the one before") {
  if (!has_sumo()) return;
  Ride ride("sumo");
  std::map<ParticipantId, Participant> last;
  double worst_m = 0.0, worst_turn_rad = 0.0, worst_outside_m = 0.0;
  std::size_t least = 1000, count = 0, rough = 0, recycled = 0, braking = 0, indicating = 0;
  constexpr int ticks = 30 * 120;
  for (int tick = 0; tick < ticks; ++tick) {
    const auto traffic = traffic_of(ride.step());
    const auto error = ride.state.traffic->take_error();
    REQUIRE_MESSAGE(!error, describe(*error));
    least = std::min(least, traffic.size());
    std::map<ParticipantId, Participant> now;
    for (const Participant& p : traffic) {
      now[p.id] = p;
      ++count;
      braking += p.lamps.has(Lamp::brake);
      indicating += p.lamps.has(Lamp::indicator_left) || p.lamps.has(Lamp::indicator_right);
      if (tick % 60 == 0) {
        const Vec3& at = p.world_from_vehicle.position_m;
        const auto place = road::locate(ride.model->roads, {at.x, at.y});
        REQUIRE(place.has_value());
        worst_outside_m = std::max(worst_outside_m, place->lanes.outside_m);
      }
      const auto before = last.find(p.id);
      if (before == last.end()) continue;
      const Vec3 expected = before->second.world_from_vehicle.position_m +
                            0.5 / simulation::tick_rate_hz * (before->second.velocity_mps + p.velocity_mps);
      const double off_m = glm::length(p.world_from_vehicle.position_m - expected);
      if (off_m > 50.0) {
        ++recycled;  // Out of the swarm at its rim, in again at the other or, where the car stands, at the same one.
        continue;
      }
      rough += off_m > 0.05;
      worst_m = std::max(worst_m, off_m);
      worst_turn_rad = std::max(worst_turn_rad,
                                std::abs(road::wrap_angle(heading_rad(p.world_from_vehicle.orientation) -
                                                          heading_rad(before->second.world_from_vehicle.orientation))));
    }
    last = std::move(now);
  }
  const double mean = static_cast<double>(count) / ticks;
  MESSAGE(mean << " vehicles, at least " << least << ", recycled " << recycled << "; worst step " << worst_m
               << " m, above 5 cm " << rough << ", turn " << worst_turn_rad << " rad; braking " << braking
               << ", indicating " << indicating << " of " << count);
  CHECK(mean > 100.0);
  CHECK(worst_outside_m == 0.0);
  CHECK(worst_m < 0.5);
  CHECK(rough < count / 1000);
  CHECK(worst_turn_rad < 0.01);
  CHECK(braking > 0);
  CHECK(indicating > 0);
}

TEST_CASE(
    "SUMO drives on roads of several sections, bends and lanes that begin or are not linked, and a count that is not "
    "met is told") {
  if (!has_sumo()) return;
  const std::string on = R"(<successor id="-1"/>)", on2 = R"(<successor id="-2"/>)", from = R"(<predecessor id="-1"/>)",
                    from2 = R"(<predecessor id="-2"/>)";
  const std::string two = lane_text(-1, "driving", on) + lane_text(-2, "driving", on2),
                    two_go_on = lane_text(-1, "driving", from) + lane_text(-2, "driving", from2),
                    unlinked = lane_text(-1, "driving", "") + lane_text(-2, "driving", "");
  const std::string widens = R"(a="0" b="0" c="0.0042" d="-0.000056"/><width sOffset="50" a="3.5" b="0" c="0" d="0")";
  const std::string begins =
      lane_text(-1, "driving", "", widens) + lane_text(-2, "driving", from) + lane_text(-3, "driving", from2);
  const std::string shifted = lane_text(-1, "driving", on2) + lane_text(-2, "driving", R"(<successor id="-3"/>)");
  const RoadText roads[] = {{"<line/>", two, two_go_on},
                            {R"(<arc curvature="0.006667"/>)", two, two_go_on},
                            {R"(<arc curvature="0.0025"/>)", shifted, begins},
                            {"<line/>", unlinked, unlinked},
                            {R"(<arc curvature="-0.01"/>)", two, ""}};
  const auto folder = program::TemporaryFolder::make("septet-test-sumo");
  REQUIRE(folder.has_value());
  for (const RoadText& road : roads) {
    CAPTURE(road.shape + road.second);
    Ride ride("sumo", own_road(folder->path(), road));
    std::size_t after_a_second = 0, fast = 0, seen = 0;
    std::map<ParticipantId, Participant> last;
    for (int tick = 0; tick < 8 * 120; ++tick) {
      const auto traffic = traffic_of(ride.step());
      const auto error = ride.state.traffic->take_error();
      REQUIRE_MESSAGE(!error, describe(*error));
      if (tick == 120) after_a_second = traffic.size();
      std::map<ParticipantId, Participant> now;
      for (const Participant& p : traffic) {
        now[p.id] = p;
        const auto before = last.find(p.id);
        if (before == last.end()) continue;
        const Vec3 moved = 120.0 * (p.world_from_vehicle.position_m - before->second.world_from_vehicle.position_m);
        if (glm::length(moved) > 100.0 || glm::length(p.velocity_mps) < 3.0) continue;
        ++seen;
        fast += std::abs(glm::length(moved) / glm::length(0.5 * (p.velocity_mps + before->second.velocity_mps)) - 1.0) >
                0.02;
      }
      last = std::move(now);
    }
    const auto said = std::ranges::find(ride.events, "traffic", &simulation::Event::kind);
    MESSAGE(road.shape << ": " << after_a_second << " of 12 after a second, " << last.size() << " at the end, "
                       << (said == ride.events.end() ? "nothing said" : said->detail) << "; speed off in " << fast
                       << " of " << seen);
    CHECK(after_a_second > 0);
    CHECK((said != ride.events.end()) == (after_a_second != 12));
    CHECK(fast < seen / 50);
  }
}

namespace {

/// The nearest in the driver's own direction from 150 m ahead on; null: there is none.
const Participant* one_ahead(const std::vector<Participant>& traffic, const Participant& car) {
  const Vec3 forward = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const auto ahead_m = [&](const Participant& p) {
    return glm::dot(p.world_from_vehicle.position_m - car.world_from_vehicle.position_m, forward);
  };
  const Participant* chosen = nullptr;
  for (const Participant& p : traffic)
    if (glm::dot(p.velocity_mps, forward) > 10.0 && ahead_m(p) > 150.0 &&
        (chosen == nullptr || ahead_m(p) < ahead_m(*chosen)))
      chosen = &p;
  return chosen;
}

/// What becomes of traffic that comes to a wreck.
struct AtWreck {
  std::size_t passed = 0;
  double longest_stand_s = 0.0;                               ///< Of one within 200 m behind it.
  std::size_t standing_at_end = 0;                            ///< Of those for longer than 20 s.
  std::set<std::pair<ParticipantId, ParticipantId>> touched;  ///< Pairs whose outlines overlapped.
  std::map<ParticipantId, double> along_m;                    ///< Of those near it that go its way.
  std::map<ParticipantId, double> stands_s;

  void see(const Snapshot& now, const Participant& wreck, const Vec3& forward, double dt_s);
};

void AtWreck::see(const Snapshot& now, const Participant& wreck, const Vec3& forward, double dt_s) {
  std::vector<const Participant*> near;
  standing_at_end = 0;
  for (const Participant& p : now.participants) {
    const Vec3 off = p.world_from_vehicle.position_m - wreck.world_from_vehicle.position_m;
    const double x = glm::dot(off, forward);
    if (glm::length(off) > 200.0 || glm::dot(p.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0), forward) < 0.0) {
      along_m.erase(p.id), stands_s.erase(p.id);
      continue;
    }
    near.push_back(&p);
    if (p.id < simulation::first_traffic_participant || p.id == wreck.id) continue;
    const auto [known, is_new] = along_m.try_emplace(p.id, x);
    passed += known->second < 0.0 && x >= 0.0;
    known->second = x;
    double& stands = stands_s[p.id];
    stands = x < 0.0 && glm::length(p.velocity_mps) < 0.3 ? stands + dt_s : 0.0;
    longest_stand_s = std::max(longest_stand_s, stands);
    standing_at_end += stands > 20.0;
  }
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t k = i + 1; k < near.size(); ++k)
      if (simulation::overlap(*near[i], *near[k])) touched.emplace(near[i]->id, near[k]->id);
}

}  // namespace

TEST_CASE(
    "one of SUMO's own that has left its rails stays as a wreck, is passed, and nobody stands behind it for good") {
  if (!has_sumo()) return;
  Ride ride("sumo");
  ride.input.accelerator = 0.0, ride.input.brake = 0.4;
  Snapshot now;
  int begins_s = 0;
  SUBCASE("after 12 s, in the second lane from the right") { begins_s = 12; }
  SUBCASE("after 15 s, in the left-most lane") { begins_s = 15; }
  SUBCASE("after 20 s, in the right-most lane") { begins_s = 20; }
  for (int tick = 0; tick < begins_s * 120; ++tick) now = ride.step();
  const Participant car = now.participants.front();
  const Vec3 forward = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const auto traffic = traffic_of(now);
  const Participant* chosen = one_ahead(traffic, car);
  REQUIRE(chosen != nullptr);
  const ParticipantId wreck = chosen->id;
  REQUIRE(simulation::leave_rails(*ride.model, *chosen, car, ride.state, ride.events));

  AtWreck seen;
  std::size_t lost = 0;
  double travelled_m = 0.0;
  Vec3 stood{0.0};
  for (int tick = 0; tick < 100 * 120; ++tick) {
    now = ride.step();
    const auto error = ride.state.traffic->take_error();
    REQUIRE_MESSAGE(!error, describe(*error));
    const Participant* there = find_participant(now.participants, wreck);
    if (there == nullptr) {
      ++lost;
      continue;
    }
    if (tick == 20 * 120) stood = there->world_from_vehicle.position_m;
    if (tick > 20 * 120)
      travelled_m = std::max(travelled_m, glm::distance(stood, there->world_from_vehicle.position_m));
    if (tick % 12 == 0) seen.see(now, *there, forward, 12.0 / simulation::tick_rate_hz);
  }
  const auto hits = std::ranges::count_if(
      ride.events, [](const simulation::Event& event) { return event.kind.find("crash") != std::string::npos; });
  MESSAGE(seen.passed << " passed it, the longest stood " << seen.longest_stand_s << " s, " << seen.standing_at_end
                      << " stand at the end; " << seen.touched.size() << " pairs touched, " << hits
                      << " crashes, lost in " << lost << " ticks, moved by " << travelled_m << " m");
  CHECK(lost == 0);
  CHECK(hits == 0);
  CHECK(seen.touched.empty());
  CHECK(travelled_m < 0.01);
  CHECK(seen.passed > 15);
  CHECK(seen.standing_at_end == 0);
  CHECK(seen.longest_stand_s < 60.0);
}

}  // namespace septet::server
