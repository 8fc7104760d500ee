#pragma once
/// A session of a car that drives along a straight road into a standing van: at 14 m/s, the brake pressed too late.

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/scene/builder.hpp"
#include "engine/scenery/vehicles/debris_looks.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/checkout.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline std::string crash_scenario(double van_s_m) {
  const auto vehicle = [](const char* name, const char* model, const char* kind, double length_m, double wheelbase_m) {
    return fmt::format(
        R"(<ScenarioObject name="{}"><Vehicle name="{}" vehicleCategory="{}" mass="1700"><BoundingBox>)"
        R"(<Center x="1.3" y="0" z="0.7"/><Dimensions width="1.83" length="{}" height="1.44"/></BoundingBox>)"
        R"(<Performance maxSpeed="60" maxAcceleration="4" maxDeceleration="9"/><Axles>)"
        R"(<FrontAxle maxSteering="0.6" wheelDiameter="0.64" trackWidth="1.57" positionX="{}" positionZ="0.32"/>)"
        R"(<RearAxle maxSteering="0" wheelDiameter="0.64" trackWidth="1.57" positionX="0" positionZ="0.32"/>)"
        R"(</Axles></Vehicle></ScenarioObject>)",
        name, model, kind, length_m, wheelbase_m);
  };
  const auto stands = [](const char* name, double s_m, double speed_mps) {
    return fmt::format(
        R"(<Private entityRef="{}"><PrivateAction><TeleportAction><Position>)"
        R"(<LanePosition roadId="1" laneId="-1" s="{}" offset="0"/></Position></TeleportAction></PrivateAction>)"
        R"(<PrivateAction><LongitudinalAction><SpeedAction>)"
        R"(<SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/><SpeedActionTarget>)"
        R"(<AbsoluteTargetSpeed value="{}"/></SpeedActionTarget></SpeedAction></LongitudinalAction></PrivateAction>)"
        R"(</Private>)",
        name, s_m, speed_mps);
  };
  return R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2026-11-27T12:00:00" author="" description=""/>)"
         R"(<CatalogLocations/><RoadNetwork><LogicFile filepath="straight.xodr"/></RoadNetwork><Entities>)" +
         vehicle("ego", "volvo-s80", "car", 4.822, 2.791) + vehicle("parked", "van", "van", 5.9, 3.66) +
         "</Entities><Storyboard><Init><Actions>" + stands("ego", 10.0, 14.0) + stands("parked", van_s_m, 0.0) +
         "</Actions></Init><StopTrigger/></Storyboard></OpenSCENARIO>";
}

inline const char* straight_road() {
  return R"(<OpenDRIVE><header revMajor="1" revMinor="6"/><road name="" length="600" id="1" junction="-1"><link/>)"
         R"(<planView><geometry s="0" x="0" y="0" hdg="0" length="600"><line/></geometry></planView>)"
         R"(<lanes><laneSection s="0"><center><lane id="0" type="none"/></center><right>)"
         R"(<lane id="-1" type="driving" level="false"><width sOffset="0" a="3.75" b="0" c="0" d="0"/></lane>)"
         R"(<lane id="-2" type="shoulder" level="false"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>)"
         R"(</right></laneSection></lanes></road></OpenDRIVE>)";
}

struct LoggedCrash {
  static constexpr Tick brake_tick = 1380, last_tick = 1800;  ///< 11.5 and 15 s.
  static constexpr double brake = 0.6;

  TemporaryFolder folder;
  LoadedDrive loaded;
  std::filesystem::path session = folder / "session.sqlite";

  /// The accelerator holds the speed until the brake is pressed.
  static DriverInput pedals(Tick tick) {
    return {.accelerator = tick < brake_tick ? 0.13 : 0.0, .brake = tick >= brake_tick ? brake : 0.0};
  }

  explicit LoggedCrash(double van_s_m = 190.0) {
    std::ofstream(folder / "straight.xodr") << straight_road();
    std::ofstream(folder / "crash.xosc") << crash_scenario(van_s_m);
    auto read = load_drive(DriveFiles{(folder / "crash.xosc").string(), source_folder() + "/rigs/desktop.toml"});
    REQUIRE_MESSAGE(read.has_value(), why_not(read));
    loaded = std::move(*read);
    auto live = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, loaded.model->seed), {});
    REQUIRE_MESSAGE(live.has_value(), why_not(live));
    auto log = SessionLog::create(loaded, {.out = folder.path(), .participant = "P07", .no_screens = true});
    REQUIRE_MESSAGE(log.has_value(), why_not(log));
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_debris_looks(builder);
    log->record_scene(store);
    (*live)->log_to(*log);
    ServeResult result{.end = logging::DriveEnd::time_over};
    while ((*live)->state().tick < last_tick) REQUIRE((*live)->next(pedals((*live)->state().tick + 1)).has_value());
    result.ticks = last_tick;
    result.simulated_s = (*live)->state().time_s();
    result.state_hash = (*live)->newest().state_hash;
    REQUIRE(log->finish(log->outcome(result, {})).has_value());
  }
};

}  // namespace septet::server
