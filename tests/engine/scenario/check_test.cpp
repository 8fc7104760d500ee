/// Findings of `septet check` on scenarios, catalogs and distributions.

#include <string>

#include <doctest/doctest.h>

#include "tests/engine/scenario/scenario_text.hpp"

namespace septet::scenario {
namespace {

const std::string header =
    R"(<FileHeader revMajor="1" revMinor="1" date="2026-01-01T00:00:00" description="" author=""/>)";

/// Files by name, instead of a folder.
ScenarioFiles files_of(std::vector<std::pair<std::string, std::string>> texts) {
  ScenarioFiles files;
  files.read = [texts](const std::string& path) -> Expected<std::string> {
    for (const auto& [name, text] : texts)
      if (name == path) return text;
    return failure("No such file or directory", path, "check its name and rights");
  };
  files.list = [](const std::string& path) -> Expected<std::vector<std::string>> {
    return failure("No such file or directory", path, "check the folder's name and rights");
  };
  return files;
}

std::string findings_text(const std::string& text,
                          const ScenarioFiles& files = files_of({{"test.xodr", road_text()}})) {
  std::string all;
  for (const Finding& finding : check_scenario(text, "test.xosc", files))
    all += (finding.severity == Severity::error ? "error " : "warning ") + describe(finding.error) + "\n";
  return all;
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  REQUIRE(text.find(old) != text.npos);
  return text.replace(text.find(old), old.size(), replacement);
}

const std::string one_car = private_text("A", place_text(-1, 10)) + private_text("B", place_text(-2, 10));

}  // namespace

TEST_CASE("a catalog is checked as a catalog") {
  const std::string vehicle = vehicle_text("x");
  const auto from = vehicle.find("<Vehicle"), to = vehicle.find("</ScenarioObject>");
  const std::string good = "<OpenSCENARIO>" + header + "<Catalog name=\"cars\">" + vehicle.substr(from, to - from) +
                           R"(<Controller name="driver"><Properties/></Controller></Catalog></OpenSCENARIO>)";
  CHECK(findings_text(good) == "");
  CHECK(findings_text(with(good, "width=\"1.8\"", "width=\"wide\"")).find("wide") != std::string::npos);
  CHECK(findings_text(with(with(good, "<Controller ", "<Contraption "), "</Controller>", "</Contraption>"))
            .find("Contraption") != std::string::npos);
  const auto driven = read_scenario(good, "cars.xosc", files_of({}));
  REQUIRE_FALSE(driven.has_value());
  CHECK(describe(driven.error()).find("this is a catalog, not a scenario") != std::string::npos);
}

TEST_CASE("a maneuver in a catalog may name whoever refers to it") {
  const std::string text =
      "<OpenSCENARIO>" + header +
      R"(<Catalog name="m"><Maneuver name="closer"><ParameterDeclarations><ParameterDeclaration name="who" parameterType="string" value=""/></ParameterDeclarations>)" +
      event_text("e", speed_text(10), trigger_text(of_entity_text("$who", R"(<StandStillCondition duration="1"/>)"))) +
      "</Maneuver></Catalog></OpenSCENARIO>";
  CHECK(findings_text(with(text, "value=\"\"/", "value=\"Ego\"/")) == "");
  CHECK(findings_text(with(text, "duration=\"1\"", "")).find("duration") != std::string::npos);
}

TEST_CASE("a distribution is checked against the scenario that it varies") {
  const std::string text =
      "<OpenSCENARIO>" + header +
      R"(<ParameterValueDistribution><ScenarioFile filepath="test.xosc"/><Deterministic>)"
      R"(<DeterministicSingleParameterDistribution parameterName="speed"><DistributionRange stepWidth="5"><Range lowerLimit="5" upperLimit="60"/></DistributionRange></DeterministicSingleParameterDistribution>)"
      R"(</Deterministic></ParameterValueDistribution></OpenSCENARIO>)";
  const auto declaring = [](const std::string& name) {
    return files_of(
        {{"test.xosc", scenario_text("", "",
                                     "<ParameterDeclarations><ParameterDeclaration name=\"" + name +
                                         "\" parameterType=\"double\" value=\"1\"/></ParameterDeclarations>")}});
  };
  CHECK(findings_text(text, declaring("speed")) == "");
  CHECK(findings_text(text, declaring("sped")).find("no parameter named \"speed\"") != std::string::npos);
  CHECK(findings_text(with(text, "stepWidth=\"5\"", "stepWidth=\"0\""), declaring("speed")).find("error") == 0);
  const auto driven = read_scenario(text, "test.xosc", declaring("speed"));
  REQUIRE_FALSE(driven.has_value());
  CHECK(describe(driven.error()).find("varies the parameters of a scenario") != std::string::npos);
}

TEST_CASE("a scenario without a road can be checked and says why it cannot be driven") {
  const std::string text =
      with(scenario_text("", ""), R"(<RoadNetwork><LogicFile filepath="test.xodr"/></RoadNetwork>)", "<RoadNetwork/>");
  CHECK(findings_text(text).find("warning") == 0);
  CHECK(findings_text(text).find("error") == std::string::npos);
  const auto driven = read_scenario(text, "test.xosc", files_of({}));
  REQUIRE_FALSE(driven.has_value());
  CHECK(describe(driven.error()).find("names no road, so that the scenario cannot be driven") != std::string::npos);
}

TEST_CASE("an attribute that the standard demands is missed with the value that is taken") {
  const std::string full = scenario_text(
      one_car + private_text("A", speed_text(10)),
      story_text(event_text(
          "e", speed_text(1),
          trigger_text(of_entity_text(
              "A",
              R"(<DistanceCondition freespace="true" rule="lessThan" value="1"><Position><LanePosition roadId="R" laneId="-1" s="9"/></Position></DistanceCondition>)")))));
  CHECK(findings_text(full) == "");
  const std::pair<std::string, std::string> demanded[] = {{" priority=\"parallel\"", "overwrite"},
                                                          {" triggeringEntitiesRule=\"any\"", "any"},
                                                          {" conditionEdge=\"none\"", "none"},
                                                          {" freespace=\"true\"", "false"},
                                                          {" rule=\"lessThan\"", "greaterThan"},
                                                          {" dynamicsShape=\"step\"", "step"},
                                                          {" dynamicsDimension=\"time\"", "time"},
                                                          {" selectTriggeringEntities=\"false\"", "false"},
                                                          {"name=\"group\" maximumExecutionCount=\"1\"", "1"}};
  for (const auto& row : demanded) {
    const std::string attribute = row.first, taken = row.second;
    CAPTURE(attribute);
    const bool named = attribute.starts_with("name");
    const std::string found = findings_text(with(full, attribute, named ? "name=\"group\"" : ""));
    CHECK(found.find("warning test.xosc:1, <") == 0);
    CHECK(found.find(named ? "1 is taken" : "\"" + taken + "\" is taken") != std::string::npos);
  }
}

TEST_CASE("check opens the road and names who cannot use it") {
  const std::string text = scenario_text(one_car, "");
  CHECK(findings_text(text) == "");
  CHECK(findings_text(text, files_of({})).find("error test.xosc:1, <LogicFile>: the road test.xodr: No such file") ==
        0);
  CHECK(findings_text(text, files_of({{"test.xodr", "no road"}}))
            .find("error test.xosc:1, <LogicFile>: the road cannot be used") == 0);
}

TEST_CASE("check finds positions that the road does not have") {
  const auto placed = [](const std::string& position) {
    return findings_text(
        with(scenario_text(one_car, ""), R"(<LanePosition roadId="R" laneId="-1" s="10.000000"/>)", position));
  };
  CHECK(placed(R"(<LanePosition roadId="R" laneId="-3" s="2000"/>)") == "");
  CHECK(placed(R"(<LanePosition roadId="Q" laneId="-1" s="10"/>)").find("no road has the id \"Q\"") !=
        std::string::npos);
  CHECK(placed(R"(<LanePosition roadId="R" laneId="-4" s="10"/>)").find("road R has no lane -4 at s = 10 m") !=
        std::string::npos);
  CHECK(placed(R"(<LanePosition roadId="R" laneId="0" s="10"/>)").find("road R has no lane 0") != std::string::npos);
  CHECK(placed(R"(<LanePosition roadId="R" laneId="-1" s="2001"/>)")
            .find("lies beyond road R, which is 2000.000 m long") != std::string::npos);
  CHECK(placed(R"(<RelativeLanePosition entityRef="B" dLane="-9" ds="5"/>)").find("so far from B there is no lane") !=
        std::string::npos);
  CHECK(placed(R"(<WorldPosition x="10" y="500"/>)")
            .find("warning test.xosc:1, <PrivateAction>: A begins beside every lane") == 0);
  // In a condition as well.
  const std::string reached =
      R"(<ReachPositionCondition tolerance="1"><Position><LanePosition roadId="R" laneId="-5" s="9"/></Position></ReachPositionCondition>)";
  CHECK(findings_text(scenario_text(one_car, story_text(event_text("e", speed_text(1),
                                                                   trigger_text(of_entity_text("A", reached))))))
            .find("road R has no lane -5") != std::string::npos);
}

TEST_CASE("positions may hang on each other in any order but not in a ring") {
  const std::string relative =
      R"(<PrivateAction><TeleportAction><Position><RelativeLanePosition entityRef="B" dLane="0" ds="5"/></Position></TeleportAction></PrivateAction>)";
  CHECK(findings_text(scenario_text(private_text("A", relative) + private_text("B", place_text(-1, 20)), "")) == "");
  const std::string ring = findings_text(
      scenario_text(private_text("A", relative) + private_text("B", with(relative, "\"B\"", "\"A\"")), ""));
  CHECK(ring.find("A cannot be put on the road: it is relative to B, which has no place itself") != std::string::npos);
}

TEST_CASE("what is taken in another way than it is written is named") {
  const std::string plain = scenario_text(one_car + private_text("A", speed_text(10)), "");
  CHECK(findings_text(with(plain, "value=\"0.000000\"/>", "value=\"0.000000\" followingMode=\"follow\"/>"))
            .find("warning") == 0);
  CHECK(findings_text(with(plain, "value=\"0.000000\"/>", "value=\"0.000000\" followingMode=\"position\"/>")) == "");
  CHECK(findings_text(with(plain, "value=\"0.000000\"/>", "value=\"1e-6\"/>")) == "");
  CHECK(findings_text(with(plain, "value=\"0.000000\"/>", "value=\"9e-7\"/>")).find("is as good as 0") !=
        std::string::npos);
  const auto weather = [&](const std::string& time, const std::string& sun) {
    return findings_text(scenario_text("<GlobalAction><EnvironmentAction><Environment name=\"e\">" + time +
                                           "<Weather>" + sun +
                                           "</Weather></Environment></EnvironmentAction></GlobalAction>" + one_car,
                                       ""));
  };
  const std::string still = R"(<TimeOfDay animation="false" dateTime="2026-01-01T12:00:00"/>)";
  const std::string sun = R"(<Sun azimuth="1" elevation="0.5" illuminance="10000"/>)";
  CHECK(weather(still, sun) == "");
  CHECK(weather(still, "").find("warning test.xosc:1, <TimeOfDay>") == 0);
  CHECK(weather(with(still, "false", "true"), sun).find("warning test.xosc:1, <TimeOfDay>") == 0);
  const auto measured = [&](const std::string& system) {
    return findings_text(scenario_text(
        one_car,
        story_text(event_text(
            "e", speed_text(1),
            trigger_text(of_entity_text(
                "A",
                "<RelativeDistanceCondition entityRef=\"B\" relativeDistanceType=\"longitudinal\" coordinateSystem=\"" +
                    system + "\" freespace=\"true\" rule=\"lessThan\" value=\"5\"/>"))))));
  };
  CHECK(measured("world") == "");
  CHECK(measured("trajectory").find("warning test.xosc:1, <RelativeDistanceCondition>: coordinateSystem") == 0);
}

TEST_CASE("numbers that nothing in the world has are errors") {
  const std::string whole = scenario_text(
      R"(<GlobalAction><EnvironmentAction><Environment name="e"><Weather temperature="290"><Sun azimuth="1" elevation="0.5" illuminance="10000"/>)"
      R"(<Precipitation precipitationIntensity="2" precipitationType="rain"/></Weather><RoadCondition frictionScaleFactor="1"/></Environment></EnvironmentAction></GlobalAction>)" +
          one_car + private_text("A", speed_text(10)),
      "");
  CHECK(findings_text(whole) == "");
  for (const auto& row :
       std::vector<std::pair<std::string, std::string>>{{"temperature=\"290\"", "temperature=\"-5\""},
                                                        {"illuminance=\"10000\"", "illuminance=\"-1e11\""},
                                                        {"Intensity=\"2\"", "Intensity=\"1e11\""},
                                                        {"ScaleFactor=\"1\"", "ScaleFactor=\"1e9\""},
                                                        {"Speed value=\"10.000000\"", "Speed value=\"1e12\""},
                                                        {"length=\"4.6\"", "length=\"1e11\""}}) {
    const auto& good = row.first;
    const auto& bad = row.second;
    CAPTURE(bad);
    const std::string found = findings_text(with(whole, good, bad));
    CHECK(found.find("error test.xosc:1") == 0);
    CHECK(found.find("out of its range") != std::string::npos);
  }
  CHECK(findings_text(with(whole, "length=\"4.6\"", "length=\"0\"")).find("the box holds nothing") !=
        std::string::npos);
}

TEST_CASE("what is no clean XML is named") {
  const std::string text = scenario_text(one_car, "");
  CHECK(findings_text(text + "\n<OpenSCENARIO/>").find("error test.xosc:2: this stands beside the root element") == 0);
  CHECK(findings_text(text + "\nrubbish").find("this stands beside the root element") != std::string::npos);
  CHECK(findings_text(text + "\n<!-- a comment -->\n") == "");
  CHECK(findings_text(with(text, "author=\"\"", "author=\"M\xFCller\""))
            .find("warning test.xosc:1: these bytes are not UTF-8") == 0);
  CHECK(findings_text(with(text, "author=\"\"", "author=\"Müller\"")) == "");
}

}  // namespace septet::scenario
