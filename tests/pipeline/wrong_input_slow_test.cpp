#include <sys/mount.h>

#include "tests/checkout.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

TEST_CASE("wrong input ends with one message that says what and where and what to do and leaves nothing behind") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out", rig = folder / "small.toml", scenarios = folder / "scenario";
  write_text(rig, small_rig(2));
  const auto drive = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"drive", "--virtual", "--seconds", "1", "--out", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    fs::remove(folder / "err");
    return run("septet", arguments, folder / "err");
  };
  const auto with_rig = [&](const std::string& text, const std::string& name) {
    write_text(folder / name, text);
    return drive({"--rig", (folder / name).string()});
  };
  const auto with_scenario = [&](const std::string& scenario, const std::string& road) {
    fs::create_directories(scenarios);
    write_text(scenarios / "s.xosc", scenario);
    if (!road.empty()) write_text(scenarios / "wrong.xodr", road);
    return drive({"--rig", rig.string(), "--scenario", scenarios.string()});
  };
  check_refused(drive({"--rig", "no-such-rig"}), {"no-such-rig", "seven-screens"}, out);
  check_refused(with_rig("name = 3\n", "wrong.toml"), {"wrong.toml:1", "rig.name"}, out);
  check_refused(drive({"--rig", rig.string(), "--scenario", "no-such-scenario"}),
                {"no-such-scenario", "motorway-ambulance"}, out);
  check_refused(with_scenario("<OpenSCENARIO>", ""), {"s.xosc:1"}, out);
  std::string scenario = text_of(fs::path(source_folder()) / "scenarios/motorway-ambulance/motorway-ambulance.xosc");
  const auto road = scenario.find("motorway.xodr");
  REQUIRE(road != std::string::npos);
  scenario.replace(road, std::string("motorway.xodr").size(), "wrong.xodr");
  check_refused(with_scenario(scenario, ""), {"wrong.xodr", "check that the file exists"}, out);
  check_refused(with_scenario(scenario, "<OpenDRIVE><road/></OpenDRIVE>"), {"wrong.xodr:1", "<road>"}, out);
  check_refused(drive({"--bogus"}), {"--bogus", "--help"}, out);
  check_refused(drive({"--seconds", "soon"}), {"--seconds", "soon"}, out);
  check_refused(with_rig(small_rig(2, "", "vehicle = \"trabant\""), "vehicle.toml"), {"trabant", "volvo-s80"}, out);
  check_refused(drive({"--rig", rig.string(), "--driver", "nobody"}), {"nobody", "plain"}, out);
  check_refused(with_rig(small_rig(2, "", "source = \"hid\"\nvendor_id = 0x1209\nproduct_id = 0xfffe"), "hid.toml"),
                {"1209:fffe", "not plugged in", "check the cable"}, out);
  check_refused(run("septet", {"fly"}, folder / "fly.err"), {"\"fly\"", "drive"}, out);
  check_refused(run("septet", {"replay", "--verify", rig.string()}, folder / "verify.err"),
                {"small.toml", "not an SQLite file"}, out);
}

TEST_CASE("a folder that holds no earlier drive is left as it is") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(2));
  fs::create_directories(folder / "letters");
  write_text(folder / "letters" / "letter.txt", "Dear reader");
  write_text(folder / "file", "text");
  for (const char* name : {"letters", "file"}) {
    const Ended ended = run("septet",
                            {"drive", "--virtual", "--seconds", "1", "--rig", (folder / "small.toml").string(), "--out",
                             (folder / name).string()},
                            folder / (std::string(name) + ".err"));
    check_refused(ended, {name, "--out"}, folder / (std::string(name) + ".1"));
  }
  CHECK(text_of(folder / "letters" / "letter.txt") == "Dear reader");
  CHECK(text_of(folder / "file") == "text");
}

TEST_CASE("an earlier drive comes back where the next one cannot begin") {
  const TemporaryFolder folder;
  write_text(folder / "hid.toml", small_rig(2, "", "source = \"hid\"\nproduct_id = 0xfffe"));
  fs::create_directories(folder / "out");
  write_text(folder / "out" / "session.sqlite", "an earlier drive");
  const Ended ended =
      run("septet", {"drive", "--virtual", "--rig", (folder / "hid.toml").string(), "--out", (folder / "out").string()},
          folder / "err");
  check_refused(ended, {"not plugged in"}, folder / "out.1");
  CHECK(text_of(folder / "out" / "session.sqlite") == "an earlier drive");
}

TEST_CASE("a busy port is named and leaves no session file") {
  const TemporaryFolder folder;
  const auto busy = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
  REQUIRE(busy.has_value());
  const std::string port = std::to_string(busy->local_address().port);
  write_text(folder / "small.toml", small_rig(2, "scene_port = " + port));
  const Ended ended = run("septet-server",
                          {"--rig", (folder / "small.toml").string(), "--keys",
                           make_keys(folder / "keys", "ab").string(), "--out", (folder / "out").string()},
                          folder / "err");
  check_refused(ended, {port}, folder / "out");
}

TEST_CASE("a full disk ends the drive with one message and what was logged before opens") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(1));
  fs::create_directories(folder / "disk");
  if (::mount("tmpfs", (folder / "disk").c_str(), "tmpfs", 0, "size=600k") != 0) {
    MESSAGE("no permission to mount a small disk: skipped");
    return;
  }
  const Ended ended = run("septet",
                          {"drive", "--virtual", "--seconds", "3", "--rig", (folder / "small.toml").string(), "--out",
                           (folder / "disk" / "out").string()},
                          folder / "err");
  INFO(ended.error);
  CHECK(ended.code == 1);
  const auto message = ended.error.find("session.sqlite");
  REQUIRE(message != std::string::npos);
  CHECK(ended.error.find("full", message) != std::string::npos);
  CHECK(ended.error.find('\n', message) == ended.error.size() - 1);
  CHECK(fs::exists(folder / "disk" / "out" / "session.sqlite"));
  CHECK(::umount2((folder / "disk").c_str(), MNT_DETACH) == 0);
}

TEST_CASE("a folder that cannot be written is named") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(1));
  const Ended ended =
      run("septet", {"drive", "--virtual", "--rig", (folder / "small.toml").string(), "--out", "/proc/septet/out"},
          folder / "err");
  check_refused(ended, {"/proc/septet/out", "--out"}, "/proc/septet");
}

}  // namespace septet::pipeline
