// Crashes as the log has them are those of its snapshots: the Python reader reckons them anew.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/world/participant_shape.hpp"
#include "sim-server/drive/who_is_who.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/engine/simulation/shipped_drives/staged_crash.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

constexpr const char* of_one =
    "closing_speed_mps delta_v_x_mps delta_v_y_mps delta_v_mps delta_yaw_rate_radps principal_direction_rad";
constexpr const char* of_two =
    "normal_rad overlap_m overlap_share depth_m kinetic_lost_j its_delta_v_x_mps its_delta_v_y_mps its_delta_v_mps "
    "its_delta_yaw_rate_radps its_principal_direction_rad";

/// A session that is written tick by tick.
class Log {
 public:
  Log(const std::filesystem::path& file, const Model& model) : file_(file), writer_(created(file, model)) {}

  void add(const Snapshot& now, const std::vector<Event>& events) {
    for (; told_ < events.size(); ++told_) {
      const Event& event = events[told_];
      writer_.record(logging::Event{now.tick, now.simulated_time_s, event.kind, event.participant, event.detail});
    }
    writer_.record(logging::taken(now));
  }
  /// Ends the session; true where its crashes are those of its snapshots.
  bool is_reckoned(const std::string& figures) {
    REQUIRE(writer_.finish().has_value());
    return std::system(fmt::format("/usr/bin/python3 -B '{}/tests/logging/crash_check.py' '{}' {}", source_folder(),
                                   file_.string(), figures)
                           .c_str()) == 0;
  }

 private:
  static logging::SessionWriter created(const std::filesystem::path& file, const Model& model) {
    logging::SessionInfo info = logging::example_info();
    info.other.merge(server::who_is_who(model));
    auto writer = logging::SessionWriter::create(file, info);
    REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
    return std::move(*writer);
  }

  std::filesystem::path file_;
  logging::SessionWriter writer_;
  std::size_t told_ = 0;
};

/// Two on a plane, as they are when they still drive freely.
struct Pair {
  const char* name;
  const char* first_model;
  Vec2 first_mps;
  double first_heading_rad, first_yaw_rate_radps;
  const char* second_model;
  Vec2 second_m, second_mps;
  double second_heading_rad, second_yaw_rate_radps;
};

Participant placed(ParticipantId id, const char* model, const Vec2& place_m, const Vec2& velocity_mps,
                   double heading_rad, double yaw_rate_radps) {
  Participant one = placed_participant(id, model, place_m.x, place_m.y, heading_rad, 0.0);
  one.velocity_mps = Vec3(velocity_mps, 0.0);
  one.angular_velocity_radps = Vec3(0.0, 0.0, yaw_rate_radps);
  return one;
}

Snapshot snapshot_of(const CrashSite& site) {
  Snapshot now;
  now.tick = site.state.tick;
  now.simulated_time_s = site.state.time_s();
  now.driver_car.participant = driver_participant;
  now.participants = site.participants;
  return now;
}

}  // namespace

TEST_CASE("figures of six kinds of crashes of two follow from the snapshots within 1 %") {
  const TemporaryFolder folder;
  constexpr double quarter_rad = 1.5707963267948966, half_rad = 2.0 * quarter_rad;
  const std::vector<Pair> pairs{
      {"rear-end", "saloon", {20.0, 0.0}, 0.0, 0.0, "saloon", {8.0, 0.0}, {10.0, 0.0}, 0.0, 0.0},
      {"t-bone", "saloon", {15.0, 0.0}, 0.0, 0.0, "saloon", {11.0, -5.5}, {0.0, 12.0}, quarter_rad, 0.0},
      {"offset-head-on", "saloon", {15.0, 0.0}, 0.0, 0.0, "van", {30.0, 1.3}, {-15.0, 0.0}, half_rad, 0.0},
      {"sideswipe", "saloon", {25.0, 1.5}, 0.0, 0.0, "saloon", {4.8, 2.1}, {15.0, 0.0}, 0.0, 0.0},
      {"rear-quarter", "lorry", {22.0, 2.0}, 0.0, 0.0, "saloon", {7.5, 2.5}, {20.0, 0.0}, 0.0, 0.0},
      {"oblique", "saloon", {13.86, 8.0}, 0.5236, 0.2, "saloon", {18.0, 4.0}, {-10.0, 0.0}, half_rad, -0.1}};
  for (const Pair& pair : pairs) {
    CAPTURE(std::string(pair.name));
    CrashSite site({placed(first_scripted_participant + 1, pair.first_model, Vec2(0.0), pair.first_mps,
                           pair.first_heading_rad, pair.first_yaw_rate_radps),
                    placed(first_scripted_participant + 2, pair.second_model, pair.second_m, pair.second_mps,
                           pair.second_heading_rad, pair.second_yaw_rate_radps)});
    Log log(folder.path() / (std::string(pair.name) + ".sqlite"), site.model);
    log.add(snapshot_of(site), site.events);
    for (int i = 0; i < 400; ++i) {
      site.tick();
      log.add(snapshot_of(site), site.events);
    }
    CHECK(log.is_reckoned(fmt::format("{} {}", of_one, of_two)));
  }
}

TEST_CASE("figures of a crash with a box follow from the snapshots within 1 %, whatever it measures") {
  const TemporaryFolder folder;
  const Vec3 size_m{3.2, 2.1, 1.6};
  Model model = plane_model(2);
  scenario::Entity& crate = model.scenario.entities[2];
  crate.kind = scenario::EntityKind::misc_object;
  crate.category = "obstacle";
  crate.mass_kg = 900.0;
  crate.box = {{0.0, 0.0, 0.5 * size_m.z}, size_m.x, size_m.y, size_m.z};
  Participant box = placed_participant(first_scripted_participant + 2, "box", 12.0, 1.3, 0.3, 0.0);
  set_box_size(size_m, box);
  CrashSite site(std::move(model), {{0.0, 1e4, 0.0}, {}}, 0.0,
                 {placed(first_scripted_participant + 1, "saloon", Vec2(0.0), {14.0, 0.0}, 0.0, 0.0), box});
  Log log(folder.path() / "box.sqlite", site.model);
  log.add(snapshot_of(site), site.events);
  for (int i = 0; i < 400; ++i) {
    site.tick();
    log.add(snapshot_of(site), site.events);
  }
  CHECK(log.is_reckoned(fmt::format("{} {}", of_one, of_two)));
}

TEST_CASE("figures of the crashes of three shipped scenarios follow from the snapshots within 1 %") {
  struct Shipped {
    const char* scenario;
    const char* driver;
    double seconds;
    std::string figures;
  };
  const std::string both = fmt::format("{} {}", of_one, of_two);
  const TemporaryFolder folder;
  for (const Shipped& shipped :
       {Shipped{"crossing-crash", "plain", 14.0, both}, Shipped{"pile-up", "experienced", 20.0, both},
        Shipped{"walker-behind-van", "plain", 9.0, "closing_speed_mps"}}) {
    const std::string name = shipped.scenario;
    CAPTURE(name);
    StagedCrash crash(server::shipped_drive(name, "desktop"), shipped.driver);
    Log log(folder.path() / (name + ".sqlite"), *crash.loaded.model);
    log.add(crash.now, crash.events);
    while (crash.state.time_s() < shipped.seconds) {
      crash.step();
      log.add(crash.now, crash.events);
    }
    CHECK(log.is_reckoned(shipped.figures));
  }
}

}  // namespace septet::simulation
