/// Help texts of the programs, and options that change a drive.

#include <csignal>
#include <cstdio>

#include "car-io/driving_keys.hpp"
#include "engine/core/version.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/checkout.hpp"
#include "tests/pipeline/process_rig.hpp"
#include "tests/relative.hpp"

namespace septet::pipeline {
namespace {

/// Standard output of a command that succeeds.
std::string output_of(const std::string& command) {
  FILE* pipe = ::popen(fmt::format("SEPTET_DATA={} {}/{} 2>&1", source_folder(), build_folder(), command).c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) output += buffer;
  INFO(output);
  CHECK(::pclose(pipe) == 0);
  return output;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("every program names its version with the revision") {
  for (const char* program : {"septet", "septet-server", "septet-screen", "septet-film", "septet-sound", "septet-sight",
                              "septet-ice", "septet-car"}) {
    CAPTURE(program);
    CHECK(output_of(std::string(program) + " --version") == version_text() + "\n");
  }
}

TEST_CASE("no program takes a number that is none, and each ends with status 2 for a wrong command line") {
  const TemporaryFolder folder;
  using Line = std::vector<std::string>;
  const std::string out = (folder / "out").string();
  for (const Line& line :
       {Line{"septet", "drive", "--no-screens", "--seconds", "nan", "--out", out},
        Line{"septet", "drive", "--no-screens", "--seed=-1", "--out", out},
        Line{"septet", "drive", "--no-screens", "--seed", "99999999999999999999", "--out", out},
        Line{"septet", "replay", "x.sqlite", "--from", "nan"},
        Line{"septet", "vehicle", "test", "--manoeuvre", "stop", "--speed", "nan"},
        Line{"septet", "film", "x.sqlite", "--fps", "nan"}, Line{"septet", "ice", "--bump", "nan"},
        Line{"septet", "ice", "--mode", "glass"}, Line{"septet-server", "--keys", "keys", "--seconds", "nan"},
        Line{"septet-server", "--keys", "keys", "--wait-for-screens", "nan"}, Line{"septet-server", "--nonsense"},
        Line{"septet-screen", "--nonsense"}, Line{"septet-car", "--nonsense"}}) {
    const Ended ended = run(line.front(), {line.begin() + 1, line.end()}, folder / "err");
    CAPTURE(line.front());
    CAPTURE(line.back());
    CAPTURE(ended.error);
    CHECK(ended.code == 2);
  }
  CHECK(!fs::exists(out));
}

TEST_CASE("a drive off-screen may be shorter than a second, and than a tick") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(2));
  for (const auto& [seconds, tick] : {std::pair("0.25", 24), std::pair("0.001", 1)}) {
    const fs::path out = folder / seconds;
    const Ended ended = run(
        "septet",
        {"drive", "--virtual", "--seconds", seconds, "--rig", (folder / "small.toml").string(), "--out", out.string()},
        folder / "err");
    INFO(ended.error);
    CHECK(ended.code == 0);
    CHECK(fs::exists(out / "panorama.png"));
    CHECK(newest_picture(out / "screens" / "a") == tick);
  }
}

TEST_CASE("a drive into a folder where another one is going on is refused, and the other goes on") {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  auto first = start("septet", {"drive", "--no-screens", "--seconds", "0", "--out", out}, folder / "first.err");
  REQUIRE(becomes_true([&] { return fs::exists(folder / "out" / "session.sqlite") || first.poll(); }));
  const Ended second =
      run("septet", {"drive", "--no-screens", "--seconds", "0.5", "--out", out}, folder / "second.err");
  CHECK(second.code == 1);
  CHECK(has(second.error, "another drive is going on in this folder"));
  CHECK(!fs::exists(folder / "out.1"));
  CHECK(!first.poll());
  first.send_signal(SIGTERM);
  CHECK(exit_code(first) == 3);
  CHECK(fs::exists(folder / "out" / "summary.json"));
}

TEST_CASE("the help of a drive has the keys and every default") {
  const std::string help = output_of("septet drive --help");
  for (const auto& key : car_io::driving_keys()) CHECK(has(help, key.does));
  for (const char* words :
       {"--rig TEXT=desktop with a display, else seven-screens", "=out/latest", "--scenario TEXT=motorway-ambulance",
        "--seed UINT=1", "--traffic TEXT=own", "--driver TEXT=the rig's", "--vehicle TEXT=the rig's",
        "--parameter NAME=VALUE", "--participant TEXT=none"}) {
    CAPTURE(words);
    CHECK(has(help, words));
  }
  CHECK(has(output_of("septet film --help"), "--size WIDTHxHEIGHT=1280x720"));
  CHECK(has(output_of("septet-screen --help"), "--server TEXT=127.0.0.1:4750"));
}

TEST_CASE("a place on a road is found again from its coordinates on the command line") {
  const TemporaryFolder folder;
  const std::string road = source_folder() + "/scenarios/motorway-ambulance/motorway.xodr < ";
  const auto second_line = [](const std::string& table) {
    const auto begin = table.find('\n') + 1;
    return table.substr(begin, table.find('\n', begin) - begin);
  };
  write_text(folder / "place", "1,-3,100,0\n");
  const std::string sampled = second_line(output_of("septet road sample " + road + (folder / "place").string()));
  REQUIRE(sampled.starts_with("1,-3,100,0,"));
  write_text(folder / "point", sampled.substr(std::size("1,-3,100,0,") - 1) + "\n");
  CHECK(has(output_of("septet road locate " + road + (folder / "point").string()), ",1,-3,100.00000,"));
}

TEST_CASE("septet list names what there is with a description each") {
  const std::string scenarios = output_of("septet list scenarios");
  CHECK(has(scenarios, "motorway-ambulance  A game: follow the ambulance"));
  CHECK(has(scenarios, "winter-lorry        Behind a lorry with ice on its roof: Ice slides"));
  const std::string rigs = output_of("septet list rigs");
  CHECK(has(rigs, "desktop         One window on a desktop"));
  CHECK(has(rigs, "seven-screens   Seven projection screens"));
  CHECK(has(output_of("septet list vehicles"), "volvo-s80-manual"));
  CHECK(has(output_of("septet list drivers"), "tired        Corrects late"));
}

TEST_CASE("septet devices succeeds whatever is plugged in, and a question without its verb is refused") {
  CHECK_FALSE(output_of("septet devices").empty());
  const TemporaryFolder folder;
  for (const char* command : {"road", "rig", "session", "vehicle"}) {
    CAPTURE(command);
    CHECK(run("septet", {command}, folder / "err").code == 2);
  }
}

TEST_CASE("what cannot be written fails and what nobody reads on does not") {
  for (const char* command : {"septet list scenarios", "septet --help", "septet-car --version"}) {
    CAPTURE(command);
    const std::string said = output_of(fmt::format("{} 2>&1 >/dev/full; test $? = 1 && echo status 1", command));
    CHECK(has(said, "No space left on device"));
    CHECK(has(said, "status 1"));
  }
  CHECK(output_of("septet list scenarios | true").empty());
}

TEST_CASE("vehicle, parameters and participant of a drive are in its log, its summary and its report") {
  const TemporaryFolder folder;
  const fs::path session = folder / "out" / "session.sqlite";
  const Ended driven = run("septet",
                           {"drive", "--no-screens", "--seconds", "0.5", "--rig", "seven-screens", "--vehicle",
                            "volvo-s80-manual", "--parameter", "ego_speed=20", "--parameter", "vehicles=40",
                            "--participant=-P07", "--out", (folder / "out").string()},
                           folder / "err");
  INFO(driven.error);
  REQUIRE(driven.code == 0);
  const auto log = logging::SessionReader::open(session);
  REQUIRE(log.has_value());
  CHECK(log->info().participant == "-P07");
  CHECK(log->info().parameters == std::map<std::string, std::string>{{"ego_speed", "20"}, {"vehicles", "40"}});
  const auto vehicle = std::ranges::find(log->info().files, "vehicle", &logging::SourceFile::role);
  REQUIRE(vehicle != log->info().files.end());
  CHECK(has(vehicle->name, "volvo-s80-manual"));
  auto snapshots = log->snapshots().value();
  const auto first = snapshots.next().value();
  REQUIRE(first.has_value());
  CHECK(first->driver_car.speed_mps == relative(20.0, 0.01));
  const std::string summary = text_of(folder / "out" / "summary.json"),
                    report = text_of(folder / "out" / "report.html");
  for (const char* words :
       {"\"participant\": \"-P07\"", "\"vehicle\": \"volvo-s80-manual\"", "\"ego_speed\": \"20\""}) {
    CAPTURE(words);
    CHECK(has(summary, words));
  }
  CHECK(has(report, "driver -P07"));
  CHECK(has(report, "ego_speed = 20"));
  const Ended verified = run("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  INFO(verified.error);
  CHECK(verified.code == 0);
}

TEST_CASE("a vehicle or a parameter that is not there is refused before anything is driven") {
  const TemporaryFolder folder;
  const auto refuse = [&](std::vector<std::string> options, const std::vector<std::string>& words) {
    options.insert(options.begin(), {"drive", "--no-screens", "--seconds", "1", "--out", (folder / "out").string()});
    check_refused(run("septet", options, folder / (words.front() + ".err")), words, folder / "out");
  };
  refuse({"--vehicle", "zeppelin"}, {"zeppelin", "volvo-s80"});
  refuse({"--parameter", "ego_speed"}, {"NAME=VALUE"});
  refuse({"--parameter", "warp=9"}, {"warp", "ego_speed"});
  refuse({"--parameter", "ego_speed=fast"}, {"fast", "ego_speed"});
  refuse({"--parameter", "ego_speed=-5"}, {"\"-5\" given to ego_speed", "greaterOrEqual 0"});
  refuse({"--parameter", "ego_speed=20", "--parameter", "ego_speed=30"}, {"twice", "ego_speed"});
}

}  // namespace septet::pipeline
