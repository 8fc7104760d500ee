#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/scenario/model/expression.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {
namespace {

std::string value_of(const std::string& text, const Parameters& parameters = {}) {
  const auto value = substitute(text, parameters);
  return value ? *value : "error: " + value.error().what;
}

bool has_finding(const std::vector<Finding>& findings, Severity severity, const std::string& part) {
  for (const Finding& finding : findings) {
    if (finding.severity == severity && describe(finding.error).find(part) != std::string::npos) return true;
  }
  return false;
}

std::string motorway_folder() { return source_folder() + "/scenarios/behind-ambulance"; }
std::string motorway_text() {
  std::ifstream in(motorway_folder() + "/behind-ambulance.xosc");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("expressions follow the standard's operators functions and precedence") {
  const Parameters parameters{{"speed", "90"}, {"fast", "true"}, {"name", "Ego"}};
  CHECK(value_of("$name", parameters) == "Ego");
  CHECK(value_of("plain text") == "plain text");
  CHECK(value_of("${$speed / 3.6}", parameters) == "25");
  CHECK(std::stod(value_of("${-pi / 2}")) == doctest::Approx(-1.5707963));
  CHECK(value_of("${2 + 3 * -4}") == "-10");
  CHECK(value_of("${(2 + 3) * 4 % 7}") == "6");
  CHECK(value_of("${max(1, pow(2, 3)) - sqrt(16)}") == "4");
  CHECK(value_of("${round(2.5) + floor(2.9) + ceil(2.1) + abs(-1) + sign(-7)}") == "8");
  CHECK(value_of("${$fast and not false}", parameters) == "true");
  CHECK(value_of("${true and false or false}") == "false");
}

TEST_CASE("a wrong expression says what is wrong") {
  CHECK(value_of("$missing") == "error: no parameter is named \"missing\"");
  CHECK(value_of("${1 +}").starts_with("error:"));
  CHECK(value_of("${1 / 0}") == "error: the value is not finite");
  CHECK(value_of("${nothing(1)}").starts_with("error:"));
  CHECK(value_of("${" + std::string(100000, '(') + "}").starts_with("error:"));
  CHECK(value_of("${" + std::string(100000, '-') + "1}").starts_with("error:"));
}

TEST_CASE("what is not supported is named with its line") {
  const std::string text = scenario_text(
      private_text("A", place_text(-1, 10)) + private_text("B", place_text(-2, 10)),
      "\n\n" + story_text(event_text("e",
                                     "<PrivateAction><ControllerAction><AssignControllerAction/></"
                                     "ControllerAction></PrivateAction>",
                                     trigger_text(of_entity_text("A", "<OffroadCondition duration=\"1\"/>")))));
  std::vector<Finding> warnings;
  const auto scenario = read_scenario(text, "test.xosc", files_in("."), &warnings);
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  CHECK(warnings.size() == 2);
  CHECK(has_finding(warnings, Severity::warning, "test.xosc:3, <AssignControllerAction>"));
  CHECK(has_finding(warnings, Severity::warning, "test.xosc:3, <OffroadCondition>"));
}

TEST_CASE("an object that nobody will see is named with its line, and one that stands or breaks is not") {
  const auto warnings_of = [](const std::string& name, const std::string& category) {
    std::string text = scenario_text("", "");
    text.insert(
        text.find("</Entities>"),
        "\n<ScenarioObject name=\"thing\"><MiscObject name=\"" + name + "\" miscObjectCategory=\"" + category +
            "\" mass=\"5\"><BoundingBox><Center x=\"0\" y=\"0\" z=\"0.4\"/>"
            "<Dimensions width=\"0.8\" length=\"0.8\" height=\"0.8\"/></BoundingBox></MiscObject></ScenarioObject>");
    std::vector<Finding> warnings;
    const auto scenario = read_scenario(text, "test.xosc", files_in("."), &warnings);
    REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
    return warnings;
  };
  const auto paint = warnings_of("arrow", "roadMark");
  REQUIRE(paint.size() == 1);
  CHECK(describe(paint[0].error).find("<MiscObject>: what lies flat on the road (\"roadMark\")") != std::string::npos);
  CHECK(warnings_of("carton", "obstacle").empty());
  CHECK(warnings_of("traffic-cone", "obstacle").empty());
}

TEST_CASE("a wrong file names line element and remedy") {
  const auto error_of = [](const std::string& text) {
    const auto scenario = read_scenario(text, "test.xosc", files_in("."));
    return why_not(scenario);
  };
  CHECK(error_of("<OpenSCENARIO").find("not XML") != std::string::npos);
  CHECK(error_of("<OpenDRIVE/>").find("not an OpenSCENARIO file") != std::string::npos);
  CHECK(error_of(scenario_text(private_text("nobody", ""), "")).find("no entity is named \"nobody\"") !=
        std::string::npos);
  CHECK(error_of(scenario_text(private_text("A", speed_text(10, "wobbly")), "")).find("wobbly") != std::string::npos);
  const std::string reference =
      R"(<ByValueCondition><StoryboardElementStateCondition storyboardElementType="event" storyboardElementRef="x" state="completeState"/></ByValueCondition>)";
  CHECK(error_of(scenario_text("", story_text(event_text("e", speed_text(1), trigger_text(reference)))))
            .find("no event is named \"x\"") != std::string::npos);
  const std::string no_dynamics =
      "<PrivateAction><LongitudinalAction><SpeedAction/></LongitudinalAction></PrivateAction>";
  CHECK(error_of(scenario_text(private_text("A", no_dynamics), "")).find("<SpeedActionDynamics> is missing") !=
        std::string::npos);
}

TEST_CASE("more entities than a tick can hold are refused at the first that is too many") {
  const auto with = [](std::size_t count) {
    std::string text = scenario_text("", "");
    std::string more;
    for (std::size_t i = 2; i < count; ++i) more += "\n" + vehicle_text("N" + std::to_string(i));
    return text.insert(text.find("</Entities>"), more);
  };
  CHECK(read_scenario(with(most_entities), "test.xosc", files_in(".")).has_value());
  const std::string many = with(20'000);
  const auto refused = read_scenario(many, "test.xosc", files_in("."));
  REQUIRE_FALSE(refused.has_value());
  CHECK(describe(refused.error()).find("test.xosc:990, <ScenarioObject>: there are more than 990 entities") == 0);
  // The others are not said to have no effect one by one.
  const auto findings = check_scenario(many, "test.xosc", files_in("."));
  CHECK(std::ranges::none_of(findings, [](const Finding& finding) {
    return describe(finding.error).find("<ScenarioObject>: attribute") != std::string::npos;
  }));
}

TEST_CASE("parameters given from outside win over those of the file") {
  const std::string declared =
      R"(<ParameterDeclarations><ParameterDeclaration name="s" parameterType="double" value="100"/></ParameterDeclarations>)";
  std::string text = scenario_text(private_text("A", place_text(-1, 10)), "", declared);
  text.replace(text.find("10.000000"), 9, "${$s * 2}");
  const auto plain = read_scenario(text, "test.xosc", files_in("."));
  const auto given = read_scenario(text, "test.xosc", files_in("."), nullptr, {{"s", "7"}});
  REQUIRE(plain);
  REQUIRE(given);
  const auto s_of = [](const Scenario& scenario) {
    return std::get<LaneCoordinates>(std::get<TeleportAction>(scenario.init.at(0).what).position).s_m;
  };
  CHECK(s_of(*plain) == doctest::Approx(200.0));
  CHECK(s_of(*given) == doctest::Approx(14.0));
}

TEST_CASE("a parameter's later value sees what was given from outside to an earlier one") {
  const std::string declared =
      R"(<ParameterDeclarations><ParameterDeclaration name="s" parameterType="double" value="100"/>)"
      R"(<ParameterDeclaration name="t" parameterType="double" value="${$s * 2}"/></ParameterDeclarations>)";
  std::string text = scenario_text(private_text("A", place_text(-1, 10)), "", declared);
  text.replace(text.find("10.000000"), 9, "$t");
  const auto given = read_scenario(text, "test.xosc", files_in("."), nullptr, {{"s", "7"}});
  REQUIRE_MESSAGE(given.has_value(), why_not(given));
  CHECK(std::get<LaneCoordinates>(std::get<TeleportAction>(given->init.at(0).what).position).s_m == 14.0);
}

TEST_CASE("two hundred thousand parameters that hang on one another are read in time that grows with their number") {
  std::string declared = R"(<ParameterDeclarations><ParameterDeclaration name="p0" parameterType="double" value="1"/>)";
  for (int i = 1; i < 200'000; ++i)
    declared += "<ParameterDeclaration name=\"p" + std::to_string(i) + "\" parameterType=\"double\" value=\"${$p" +
                std::to_string(i - 1) + " + 1}\"/>";
  const auto scenario =
      read_scenario(scenario_text("", "", declared + "</ParameterDeclarations>"), "test.xosc", files_in("."));
  REQUIRE(scenario);
  CHECK(std::ranges::count(scenario->values, "200000") == 1);
}

TEST_CASE("a parameter from outside that is not declared not of its type or not allowed is refused") {
  const std::string text = scenario_text(
      "", "",
      R"(<ParameterDeclarations><ParameterDeclaration name="speed" parameterType="double" value="4">)"
      R"(<ConstraintGroup><ValueConstraint rule="lessThan" value="5"/><ValueConstraint rule="greaterThan" value="0"/></ConstraintGroup>)"
      R"(<ConstraintGroup><ValueConstraint rule="equalTo" value="9"/></ConstraintGroup></ParameterDeclaration>)"
      R"(<ParameterDeclaration name="count" parameterType="unsignedShort" value="3"/>)"
      R"(<ParameterDeclaration name="at" parameterType="dateTime" value="2026-01-31T12:00:00"/>)"
      R"(<ParameterDeclaration name="on" parameterType="boolean" value="true"/></ParameterDeclarations>)");
  const auto error_of = [&](const std::string& given) {
    const auto parameter = parse_parameter(given);
    REQUIRE_MESSAGE(parameter.has_value(), why_not(parameter));
    const auto scenario = read_scenario(text, "test.xosc", files_in("."), nullptr, {*parameter});
    return why_not(scenario);
  };
  for (const char* good : {"speed=1", "speed=9", "count=65535", "at=2026-01-31T12:00:00.5+01:00", "on=false"})
    CHECK(error_of(good) == "");
  CHECK(error_of("sped=1").find("no parameter named \"sped\"") != std::string::npos);
  CHECK(error_of("sped=1").find("speed, count, at, on") != std::string::npos);
  CHECK(error_of("speed=fast").find("\"fast\" given to speed is no value of type double") != std::string::npos);
  CHECK(error_of("speed=5").find("constraints; give a value that is lessThan 5 and greaterThan 0, or equalTo 9") !=
        std::string::npos);
  CHECK(error_of("count=-1").find("unsignedShort") != std::string::npos);
  CHECK(error_of("count=1.5").find("unsignedShort") != std::string::npos);
  CHECK(error_of("at=noon").find("dateTime") != std::string::npos);
  CHECK(error_of("on=maybe").find("boolean") != std::string::npos);
  CHECK_FALSE(parse_parameter("speed").has_value());
  CHECK_FALSE(parse_parameter("=5").has_value());
}

TEST_CASE("a parameter that breaks its own constraints is an error with its line") {
  const std::string text = scenario_text(
      "", "",
      R"(<ParameterDeclarations><ParameterDeclaration name="v" parameterType="double" value="10"><ConstraintGroup>)"
      R"(<ValueConstraint rule="lessThan" value="5"/></ConstraintGroup></ParameterDeclaration></ParameterDeclarations>)");
  const auto scenario = read_scenario(text, "test.xosc", files_in("."));
  REQUIRE_FALSE(scenario.has_value());
  CHECK(describe(scenario.error()).find("test.xosc:1, <ParameterDeclaration>: \"10\" of v breaks") !=
        std::string::npos);
}

TEST_CASE("an orientation without a type is relative from 1.3 on and absolute before") {
  const auto heading_in = [](const std::string& revision) {
    std::string text = scenario_text(private_text("A", place_text(1, 100)), "");
    text.replace(text.find("revMinor=\"3\""), 12, "revMinor=\"" + revision + "\"");
    const auto end = text.find("/></Position>");
    text.replace(end, 2, "><Orientation h=\"0.1\"/></LanePosition>");
    return heading_rad(Drive(text).a().world_from_entity.orientation);
  };
  // Lane 1 runs against x.
  CHECK(std::cos(heading_in("3") - 0.1 - std::numbers::pi) == doctest::Approx(1.0));
  CHECK(std::cos(heading_in("2") - 0.1) == doctest::Approx(1.0));
  CHECK(std::cos(heading_in("0") - 0.1) == doctest::Approx(1.0));
}

TEST_CASE("a catalog is read once and its entry takes its parameters from each reference") {
  int times_read = 0;
  ScenarioFiles files;
  files.list = [](const std::string&) -> Expected<std::vector<std::string>> {
    return std::vector<std::string>{"cars.xosc"};
  };
  files.read = [&](const std::string&) -> Expected<std::string> {
    ++times_read;
    return std::string(
        R"(<OpenSCENARIO><Catalog name="cars"><Vehicle name="small" vehicleCategory="car"><ParameterDeclarations>)"
        R"(<ParameterDeclaration name="top" parameterType="double" value="40"/></ParameterDeclarations>)"
        R"(<BoundingBox><Center x="1.4" y="0" z="0.7"/><Dimensions width="1.7" length="4" height="1.4"/></BoundingBox>)"
        R"(<Performance maxSpeed="$top" maxAcceleration="3" maxDeceleration="9"/><Axles/></Vehicle></Catalog></OpenSCENARIO>)");
  };
  std::string text = scenario_text("", "");
  const auto reference = [](const std::string& name, const std::string& top) {
    return "<ScenarioObject name=\"" + name +
           R"("><CatalogReference catalogName="cars" entryName="small"><ParameterAssignments>)"
           R"(<ParameterAssignment parameterRef="$top" value=")" +
           top + R"("/></ParameterAssignments></CatalogReference></ScenarioObject>)";
  };
  text.insert(text.find("</Entities>"), reference("C", "55") + reference("D", "45"));
  text.replace(text.find("<CatalogLocations/>"), 19,
               R"(<CatalogLocations><VehicleCatalog><Directory path="catalogs"/></VehicleCatalog></CatalogLocations>)");
  const auto scenario = read_scenario(text, "test.xosc", files);
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  const Entity& car = scenario->entities.at(2);
  CHECK(car.performance.max_speed_mps == 55.0);
  CHECK(scenario->entities.at(3).performance.max_speed_mps == 45.0);
  CHECK(times_read == 1);
  CHECK(vehicle_models()[car.model].name == "hatchback");
}

TEST_CASE("an entity is drawn as the model of its name or the nearest of its kind") {
  Entity entity;
  entity.type_name = "volvo-s80";
  CHECK(vehicle_models()[match_vehicle_model(entity)].name == "volvo-s80");
  entity.type_name = "unknown";
  entity.category = "truck";
  CHECK(vehicle_models()[match_vehicle_model(entity)].name == "lorry");
  entity.category = "van";
  entity.role = "ambulance";
  CHECK(vehicle_models()[match_vehicle_model(entity)].name == "ambulance");
}

TEST_CASE("an entity that no name of ours fits is drawn as its role, its category and the words of its name tell") {
  struct Told {
    const char *type_name, *category, *role, *model;
    double length_m;
  };
  for (const Told& told :
       {Told{"car_police", "car", "none", "police-car", 4.9}, Told{"V70", "car", "police", "police-car", 4.7},
        Told{"London Taxi", "car", "none", "taxi", 4.6}, Told{"dump_truck", "truck", "none", "tipper", 9.0},
        Told{"semi_tractor", "truck", "none", "tractor-unit", 5.9},
        Told{"semi_trailer", "trailer", "none", "semitrailer", 13.0},
        Told{"car_trailer", "trailer", "none", "caravan", 4.0},
        Told{"anything", "semitrailer", "none", "semitrailer", 12.0}, Told{"E9", "truck", "fire", "fire-engine", 8.0},
        Told{"bus_blue", "bus", "none", "city-bus", 12.0}, Told{"bicycle", "bicycle", "none", "bicycle", 1.8}}) {
    CAPTURE(told.type_name);
    Entity entity;
    entity.type_name = told.type_name, entity.category = told.category, entity.role = told.role;
    entity.box.length_m = told.length_m, entity.box.width_m = 2.5, entity.box.height_m = 3.1;
    CHECK(vehicle_models()[match_vehicle_model(entity)].name == told.model);
  }
}

TEST_CASE("the motorway scenario loads without a warning") {
  std::vector<Finding> findings = check_scenario(motorway_text(), "behind-ambulance.xosc", files_in(motorway_folder()));
  for (const Finding& finding : findings) MESSAGE(describe(finding.error));
  CHECK(findings.empty());
}

TEST_CASE("no mutation of a scenario crashes the reader or the runtime") {
  const std::string original = motorway_text();
  REQUIRE_FALSE(original.empty());
  std::ifstream in(source_folder() + "/scenarios/motorway-ambulance/motorway.xodr");
  const auto network = road::read_opendrive(std::string{std::istreambuf_iterator<char>(in), {}}, "motorway.xodr");
  REQUIRE(network.has_value());
  Random random(7);
  int started = 0;
  const std::string pieces[] = {"-1", "0",         "1e12", "nan", "\"",           "<", ">", "$", "${",
                                "}",  "ambulance", "",     "/",   "999999999999", "-4"};
  for (int round = 0; round < 200; ++round) {
    std::string text = original;
    for (std::uint64_t change = 1 + random.below(2); change > 0; --change) {
      const std::size_t at = random.below(text.size());
      if (random.below(2) == 0) {
        // The value of an attribute.
        const std::size_t open = text.find('"', at), close = open == text.npos ? open : text.find('"', open + 1);
        if (close == text.npos) continue;
        text.replace(open + 1, close - open - 1, pieces[random.below(std::size(pieces))]);
      } else if (random.below(2) == 0) {
        text.replace(at, random.below(40), pieces[random.below(std::size(pieces))]);
      } else {
        text.resize(at + 1);
      }
    }
    const auto scenario = read_scenario(text, "mutated.xosc", files_in(motorway_folder()));
    if (!scenario) {
      CHECK_FALSE(scenario.error().where.empty());
      continue;
    }
    StepResult result;
    auto state = start_scenario(*scenario, *network, no_entity, result);
    if (!state) continue;
    ++started;
    for (int step = 0; step < 20; ++step) advance_scenario(*scenario, *network, 0.5, *state);
  }
  CHECK(started > 10);
}

}  // namespace septet::scenario
