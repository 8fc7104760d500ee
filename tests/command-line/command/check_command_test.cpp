#include "command-line/command/check_command.hpp"
#include "tests/checkout.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace septet::server {
namespace {
namespace fs = std::filesystem;

const fs::path tree = source_folder();

struct Answer {
  int status;
  std::string text;
};
Answer check(std::vector<std::string> files, bool json = false, bool strict = false) {
  std::ostringstream out;
  const int status = run_check({std::move(files), json, strict}, out);
  return {status, out.str()};
}

/// A file that is gone again after the test.
struct Written {
  fs::path path;
  Written(const std::string& name, const std::string& text)
      : path(fs::temp_directory_path() / (std::to_string(getpid()) + "-" + name)) {
    std::ofstream(path) << text;
  }
  ~Written() { fs::remove(path); }
};

}  // namespace

TEST_CASE("every shipped file that check knows passes it as what it is") {
  const std::pair<const char*, const char*> shipped[] = {
      {"vehicles/volvo-s80.toml", "vehicle"},
      {"rigs/desktop.toml", "rig"},
      {"rigs/three-monitors.toml", "rig"},
      {"rigs/seven-screens.toml", "rig"},
      {"scenarios/first-lesson/first-lesson.lesson.toml", "lesson"},
      {"scenarios/questionnaires/ssq.toml", "questionnaire"},
      {"scenarios/experiments/ambulance-24.toml", "experiment"},
      {"scenarios/motorway-ambulance/motorway-ambulance.xosc", "scenario"},
      {"scenarios/motorway-ambulance/motorway.xodr", "road"}};
  for (const auto& row : shipped) {
    const char* const file = row.first;
    const char* const kind = row.second;
    CAPTURE(file);
    const Answer answer = check({(tree / file).string()}, true);
    CHECK(answer.status == 0);
    const auto json = nlohmann::json::parse(answer.text);
    CHECK(json["files"][0]["kind"] == kind);
    CHECK(json["files"][0]["findings"].empty());
  }
}

TEST_CASE("a rig is checked with the files that it names and for screens that nobody means") {
  const auto folder = fs::temp_directory_path() / ("check-rig-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto rig_with = [&](const std::string& car, const std::string& rest, const std::string& corners) {
    std::ofstream(folder / "rig.toml") << "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[car]\n" + car +
                                              "\n[[screen]]\nname = \"a\"\nwidth_px = 640\nheight_px = 320\n" +
                                              corners + rest;
    return check({(folder / "rig.toml").string()});
  };
  const std::string upright = "lower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 1]\n";
  const auto says = [](const Answer& answer, int status, const char* what) {
    CAPTURE(answer.text);
    CHECK(answer.status == status);
    CHECK(answer.text.find(what) != std::string::npos);
  };
  says(rig_with("", "", upright), 0, "1 files, 0 errors, 0 warnings");
  says(rig_with("vehicle = \"volvo-s81\"", "", upright), 1, "rig.toml, [car] vehicle: volvo-s81");
  says(rig_with("vehicle = \"\"", "", upright), 1, "rig.toml, [car] vehicle: there is no such");
  says(rig_with("driver = \"nobody\"", "", upright), 1, "nobody");
  says(rig_with("layout = \"no-such\"", "", upright), 1, "rig.toml, [car] layout: there is no report layout 'no-such'");
  const std::string can = "[can]\ninterface = \"can0\"\ndbc = \"own.dbc\"\n[can.signals]\n\"";
  says(rig_with("", can + "A.s\" = \"speed_kmh\"\n", upright), 1, "rig.toml, [can]: ");
  const std::string good = "BS_:\nBU_: X\nBO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n";
  std::ofstream(folder / "own.dbc") << good;
  says(rig_with("", can + "A.s\" = \"speed_kmh\"\n", upright), 0, "0 errors, 0 warnings");
  says(rig_with("", can + "A.t\" = \"speed_kmh\"\n", upright), 1, "A.t");
  says(rig_with("source = \"can\"", can + "A.s\" = \"speed_kmh\"\n", upright), 1, "is a control of the car");
  std::ofstream(folder / "own.dbc") << good + "BO_ 8 B: 1 X\n SG_ s : 4|8@1+ (1,0) [0|0] \"\" X\n";
  says(rig_with("", can + "A.s\" = \"speed_kmh\"\n", upright), 0, "a message is not read: s reaches beyond");
  says(rig_with("", can + "B.s\" = \"speed_kmh\"\n", upright), 1, "s reaches beyond the 1 bytes of B");
  says(rig_with("", "", "lower_left_m = [2, 1, 1]\nlower_right_m = [2, -1, 1]\nupper_left_m = [2, 1, 0]\n"), 0,
       "shows its back");
  says(rig_with("", "", "lower_left_m = [2, -1, 1]\nlower_right_m = [2, 1, 1]\nupper_left_m = [2, -1, 0]\n"), 0,
       "lies below its lower edge");
  says(rig_with("", "", "lower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 2]\n"), 0,
       "the pixels of the screen a are 0.50 times as wide as high");
  for (const char* address : {"10.7.0.300", "10.7.0", "10.7.0.3.1", "10..0.3", "1000"})
    says(rig_with("", std::string("[network]\nserver_address = \"") + address + "\"\n", upright), 1, address);
  says(rig_with("", "[network]\nserver_address = \"lab-server\"\n", upright), 0, "0 errors");
  fs::remove_all(folder);
}

TEST_CASE("a film script is checked as one") {
  const Written good("good.toml", "[[shot]]\nfrom_s = 1\nto_s = 5\n"),
      bad("bad.toml", "[[shot]]\nfrom_s = 1\nto_s = 1\n");
  CHECK(check({good.path.string()}).text == "1 files, 0 errors, 0 warnings\n");
  const Answer answer = check({bad.path.string()}, true);
  CHECK(answer.status == 1);
  const auto json = nlohmann::json::parse(answer.text);
  CHECK(json["files"][0]["kind"] == "film script");
  CHECK(json["files"][0]["findings"][0]["line"] == 3);
}

TEST_CASE("lessons, questionnaires and experiments are judged as what they are, with the line of what is wrong") {
  const std::string task = "title = \"T\"\naim = \"A\"\n[[task]]\nid = \"a\"\nsays = \"Do it\"\n";
  const Written lesson("l.lesson.toml", task + "measure = \"spede\"\nbound = 1\ntolerance = 1\n"),
      empty("e.lesson.toml", ""), question("q.toml", "id = \"q\"\ntitle = \"Q\"\n[[item]]\nid = \"a\"\nleast = 5\n");
  for (const auto& [file, kind] : {std::pair(&lesson, "lesson"), {&empty, "lesson"}, {&question, "questionnaire"}}) {
    const Answer answer = check({file->path.string()}, true);
    CHECK(answer.status == 1);
    const auto json = nlohmann::json::parse(answer.text);
    CHECK(json["files"][0]["kind"] == kind);
    CHECK(json["files"][0]["errors"] == 1);
  }
}

TEST_CASE("an experiment is read with every part's scenario under every condition and what they name") {
  const std::string group = "rig = \"desktop\"\n[[group]]\nname = \"g\"\nsubjects = 1\ndriver = \"novice\"\n",
                    game = "[[part]]\nname = \"game\"\nscenario = \"winter-lorry\"\nup_to_min = 0.2\n",
                    task = "[[part]]\nname = \"task\"\nscenario = \"rescue-lane\"\nseconds = 6.0\n";
  const Written good("good-e.toml", group + game + task + "parameters = { vehicles = 40 }\n");
  CHECK(check({good.path.string()}).text == "1 files, 0 errors, 0 warnings\n");
  const Written no_xml("no.xosc", "Dear reader");
  struct Wrong {
    std::string text, says;
  };
  const Wrong all[] = {
      {group + game + task + "parameters = { no_such = 40 }\n", "part task: the scenario has no parameter named"},
      {group + game + task + "parameters = { vehicles = inf }\n", "part task: \"inf\""},
      {group + game + task + "parameters = { vehicles = 1e9 }\n", "rescue-lane.xosc:"},
      {group + game + task + "parameters = { vehicles = -1 }\n", "part task: \"-1\""},
      {group + task +
           "[[condition]]\nname = \"few\"\nparameters = { vehicles = 4 }\n[[condition]]\nname = \"odd\"\n"
           "parameters = { vehicles = \"many\" }\n",
       "part task under condition odd: \"many\""},
      {group + game + "[[part]]\nname = \"x\"\nscenario = \"" + no_xml.path.string() + "\"\nseconds = 1\n", "no.xosc"},
      {group + "[[part]]\nname = \"x\"\nscenario = \"no-such-scenario\"\nseconds = 1\n", "no-such-scenario"},
      {"questionnaires_after_each_condition = [\"no-such-questionnaire\"]\n" + group + game, "no-such-questionnaire"},
      {"[[group]]\nname = \"g\"\nsubjects = 1\ndriver = \"nobody\"\n" + game, "nobody"}};
  for (const Wrong& wrong : all) {
    const Written file("wrong-e.toml", wrong.text);
    const Answer answer = check({file.path.string()});
    INFO(answer.text);
    CHECK(answer.status == 1);
    CHECK(answer.text.find(wrong.says) != std::string::npos);
    CHECK(answer.text.find("1 files, 1 errors, 0 warnings") != std::string::npos);
  }
}

TEST_CASE("check answers in JSON what it says in lines") {
  const std::string scenario =
      "<OpenSCENARIO>\n<FileHeader revMajor='1' revMinor='1'/>\n<RoadNetwork>\n<LogicFile "
      "filepath='none\xFF.xodr'/></RoadNetwork>"
      "<Entities/><Storyboard><Init><Actions/></Init></Storyboard></OpenSCENARIO>";
  const Written file("s.xosc", scenario), odd("letter.txt", "Dear reader");
  const Answer answer = check({file.path.string(), odd.path.string()}, true);
  CHECK(answer.status == 1);
  const auto json = nlohmann::json::parse(answer.text);
  CHECK(json["format"] == "septet check");
  CHECK(json["version"] == 1);
  CHECK(json["errors"] == 2);
  CHECK(json["warnings"] == 1);
  CHECK(json["files"].size() == 2);
  const auto& first = json["files"][0];
  CHECK(first["kind"] == "scenario");
  CHECK(first["errors"] == 1);
  const auto& missing = first["findings"].back();
  CHECK(missing["severity"] == "error");
  CHECK(missing["line"] == 4);
  CHECK(missing["where"] == file.path.string() + ":4, <LogicFile>");
  CHECK(json["files"][1]["kind"] == "unknown");
  CHECK(json["files"][1]["findings"][0]["line"].is_null());
  const Answer lines = check({file.path.string(), odd.path.string()});
  CHECK(lines.text.find("2 files, 2 errors, 1 warnings") != std::string::npos);
}

TEST_CASE("warnings count in the exit status only where that is asked for") {
  const Written file("w.xosc",
                     "<OpenSCENARIO><FileHeader revMajor='1' revMinor='1'/><RoadNetwork/><Entities/>"
                     "<Storyboard><Init><Actions/></Init></Storyboard></OpenSCENARIO>");
  CHECK(check({file.path.string()}).status == 0);
  CHECK(check({file.path.string()}, false, true).status == 1);
}

TEST_CASE("what is no session is not taken for one") {
  const Written file("x.sqlite", "Dear reader");
  const Answer answer = check({file.path.string()});
  CHECK(answer.status == 1);
  CHECK(answer.text.find("not an SQLite file") != std::string::npos);
}

TEST_CASE("a model is checked as a drive reads it, and what was found in it is told") {
  // A triangle in buffer bytes 0, 0, 0, 4, 0, 0, 0, 0, 4 as 32-bit floats.
  const auto text = [](const char* node, const char* more) {
    return std::string(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"name":"lamp_brake.001","mesh":0},)") + node +
           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"name":"paint"}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],)" +
           more +
           R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAQAAAAAAAAAAAAAAAAAAAAAAAAIBA"}]})";
  };
  const auto has = [](const Answer& answer, const char* part) {
    CAPTURE(answer.text);
    CHECK(answer.text.find(part) != std::string::npos);
  };
  const Written good("own.gltf", text(R"({"name":"lamp_brake","mesh":0})", ""));
  const Answer answer = check({good.path.string()});
  CHECK(answer.status == 0);
  has(answer, "3 triangles; 4.00 m long (glTF's z, forward), 4.00 m wide (x, left), 0.00 m high (y, up)");
  has(answer, "own.gltf: parts that move or shine: 2 × lamp_brake\n");
  has(answer, "own.gltf: materials: \"paint\"; 0 pictures\n");
  has(answer, "1 files, 0 errors, 0 warnings");
  const Written large("large.gltf", text(R"({"mesh":0,"scale":[100,1,1]})", R"("animations":[{}],)"));
  const Answer warned = check({large.path.string()});
  CHECK(warned.status == 0);
  has(warned, "nothing moves by an animation");
  has(warned, "its longest side is 400 m, as if its lengths were no metres; scale it by 0.01");
  has(warned, "0 errors, 1 warnings");
  CHECK(check({large.path.string()}, false, true).status == 1);
  const Written bad("bad.glb", "glTF and nothing that belongs to it");
  const auto json = nlohmann::json::parse(check({bad.path.string(), good.path.string()}, true).text);
  CHECK(json["files"][0]["kind"] == "model");
  CHECK(json["files"][0]["errors"] == 1);
  CHECK(json["files"][0]["found"].empty());
  CHECK(json["files"][1]["found"].size() == 4);
}

TEST_CASE("a model with a vertex beyond any world is an error that names the file, the node and what to do") {
  // (0, 0, 0), (x, 0, 0), (0, 1, 0) as real32, x being 1e9, infinite and no number.
  const std::pair<const char*, const char*> vertices[] = {
      {"AAAAAAAAAAAAAAAAKGtuTgAAAAAAAAAAAAAAAAAAgD8AAAAA", "node 0: it lies further than 2000 m from the origin; give"},
      {"AAAAAAAAAAAAAAAAAACAfwAAAAAAAAAAAAAAAAAAgD8AAAAA", "accessor 0: number 0 of row 1 is not finite"},
      {"AAAAAAAAAAAAAAAAAADAfwAAAAAAAAAAAAAAAAAAgD8AAAAA", "accessor 0: number 0 of row 1 is not finite"}};
  for (const auto& row : vertices) {
    const std::string bytes = row.first, wanted = row.second;
    CAPTURE(wanted);
    const Written model("far.gltf",
                        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
                        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
                        R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
                        R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
                            bytes + "\"}]}");
    const Answer answer = check({model.path.string()});
    CHECK(answer.status == 1);
    CHECK_MESSAGE(answer.text.find(wanted) != std::string::npos, answer.text);
    CHECK(answer.text.find("far.gltf") != std::string::npos);
  }
}

}  // namespace septet::server
