#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/chosen_command.hpp"
#include "sim-server/drive/driver_rating.hpp"

namespace septet::server {

TEST_CASE("a drive that is chosen on the page is the command that a person types") {
  const page::DriveChoice choice{.scenario = "motorway-ambulance",
                                 .rig = "desktop",
                                 .driver = "plain",
                                 .participant = "-P07",
                                 .group = "a",
                                 .note = "it's late; $HOME",
                                 .seed = "7",
                                 .parameters = {{"density", "20"}},
                                 .start_now = true};
  OperateOptions options{.port = 8080};
  options.models = "my models";
  CHECK(typed(command_of(choice, options, "/d/one")) ==
        "septet drive --scenario=motorway-ambulance --rig=desktop --driver=plain '--models=my models' "
        "--participant=-P07 --group=a "
        R"('--note=it'\''s late; $HOME' --seed=7 --parameter=density=20 --start-now --out=/d/one --page=8080)");
  options.keys = "keys/server";
  options.models.clear();
  CHECK(typed(command_of({.scenario = "s", .group = "a"}, options, "/d/two")) ==
        "septet-server --keys=keys/server --scenario=s --about=group=a --out=/d/two --page=8080");
}

TEST_CASE("each minute has one answer of how the driver feels, and minutes without one are kept as such") {
  const auto questionnaire = logging::read_questionnaire(
      "id = \"misc\"\ntitle = \"T\"\nsource = \"s\"\n[[item]]\nid = \"r\"\ntext = \"How?\"\nleast = 0\nmost = "
      "2\nlabels = "
      "[\"well\", \"so so\", \"ill\"]\n",
      "test");
  REQUIRE(questionnaire.has_value());
  auto rating = DriverRating::of(*questionnaire).value();
  CHECK(rating.unanswered(0.0, 500.0).empty());
  CHECK_FALSE(rating.answer(61.0, 3).has_value());
  CHECK_FALSE(rating.answer(61.0, -1).has_value());
  const auto first = rating.answer(61.0, 2);
  REQUIRE(first.has_value());
  CHECK(first->item == "misc.01");
  CHECK(first->answer == "ill");
  CHECK(first->value == 2.0);
  CHECK_FALSE(rating.answer(119.9, 1).has_value());
  CHECK(rating.answer(180.0, 0)->item == "misc.03");
  const auto missing = rating.unanswered(0.0, 299.0);
  REQUIRE(missing.size() == 2);
  CHECK(missing[0].item == "misc.02");
  CHECK(missing[1].item == "misc.04");
  CHECK_FALSE(missing[1].value.has_value());
  // Of a drive that began later, the minutes since then.
  const auto later = rating.unanswered(130.0, 299.0);
  REQUIRE(later.size() == 1);
  CHECK(later[0].item == "misc.04");
}

}  // namespace septet::server
