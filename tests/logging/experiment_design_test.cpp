#include "logging/study/experiment/design.hpp"

#include <map>
#include <set>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "engine/core/regular_file.hpp"
#include "tests/checkout.hpp"

namespace septet::logging {
namespace {

const std::string least =
    "[[group]]\nname = \"g\"\nsubjects = 3\n[[part]]\nname = \"p\"\nscenario = \"s\"\nseconds = 10\n";

}  // namespace

TEST_CASE("each condition comes as often in each place and of an even number as often after each other one") {
  for (std::size_t count = 1; count <= 7; ++count) {
    const auto orders = balanced_orders(count);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places, pairs;
    for (const auto& order : orders) {
      CHECK(std::set(order.begin(), order.end()).size() == count);
      for (std::size_t i = 0; i < count; ++i) ++places[{i, order[i]}];
      for (std::size_t i = 1; i < count; ++i) ++pairs[{order[i - 1], order[i]}];
    }
    for (const auto& entry : places) CHECK(entry.second == orders.size() / count);
    CHECK(pairs.size() == count * (count - 1));
    for (const auto& entry : pairs) CHECK(entry.second == orders.size() / count);
  }
}

TEST_CASE("the shipped experiment is the paper's design") {
  const std::string file = source_folder() + "/scenarios/experiments/ambulance-24.toml";
  const auto experiment = read_experiment(read_regular_file(file).value(), file);
  REQUIRE_MESSAGE(experiment.has_value(), experiment.error().what);
  const auto plan = plan_of(*experiment);
  REQUIRE(plan.size() == 24);
  CHECK(plan.front().participant == "P01");
  CHECK(plan.back().participant == "P24");
  double planned_s = 0.0;
  for (const auto& subject : plan) {
    REQUIRE(subject.drives.size() == 2);
    CHECK(subject.drives[0].seconds <= 30.0 * 60.0);
    CHECK(subject.drives[0].stops == (subject.drives[0].seconds < 30.0 * 60.0));
    for (const auto& drive : subject.drives) planned_s += drive.seconds;
  }
  CHECK(planned_s > 9.0 * 3600.0);
  CHECK(planned_s < 12.0 * 3600.0);
}

TEST_CASE("the same experiment gives the same plan and every drive a seed of its own") {
  auto experiment = read_experiment(least +
                                        "[[part]]\nname = \"free\"\nscenario = \"s\"\nup_to_min = "
                                        "5\n[[condition]]\nname = \"a\"\n[[condition]]\nname = \"b\"\n",
                                    "e");
  REQUIRE(experiment.has_value());
  const auto plan = plan_of(*experiment), again = plan_of(*experiment);
  std::set<std::uint64_t> seeds;
  std::set<std::string> names;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    REQUIRE(plan[i].drives.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(plan[i].drives[k].seconds == again[i].drives[k].seconds);
      for (std::size_t lap = 0; lap < 3; ++lap) {
        seeds.insert(drive_seed(*experiment, plan[i].number, plan[i].drives[k], lap));
        names.insert(drive_name(*experiment, plan[i].drives[k], lap));
      }
    }
  }
  CHECK(seeds.size() == 3 * 4 * 3);
  CHECK(names.size() == 4 * 3);
  CHECK(names.contains("free-b-02"));
  // The second subject begins with the other condition.
  CHECK(plan[0].drives[0].condition != plan[1].drives[0].condition);
  experiment->seed = 2;
  CHECK(drive_seed(*experiment, 1, plan[0].drives[0], 0) != *seeds.begin());
}

TEST_CASE("whoever has not had enough when the offered time is over has not stopped of his own will") {
  const auto plan_with = [](const std::string& mean_min) {
    return plan_of(*read_experiment("[[group]]\nname = \"g\"\nsubjects = 2\nstops_mean_min = " + mean_min +
                                        "\n[[part]]\nname = \"p\"\nscenario = \"s\"\nup_to_min = 2\n",
                                    "e"));
  };
  for (const auto& [mean_min, seconds, stops] :
       {std::tuple{"0.5", 60.0, true}, {"1.5", 90.0, true}, {"2.0", 120.0, false}, {"9.0", 120.0, false}})
    for (const auto& subject : plan_with(mean_min)) {
      CHECK(subject.drives[0].seconds == doctest::Approx(seconds));
      CHECK(subject.drives[0].stops == stops);
    }
  // The offered time is shorter than the minute that all try it for.
  const auto plan = plan_of(*read_experiment(
      "[[group]]\nname = \"g\"\nsubjects = 1\nstops_mean_min = 0.2\n[[part]]\nname = \"p\"\nscenario = "
      "\"s\"\nup_to_min = 1\n",
      "e"));
  CHECK(plan[0].drives[0].seconds == doctest::Approx(60.0));
  CHECK_FALSE(plan[0].drives[0].stops);
}

TEST_CASE("an experiment that makes no sense is refused") {
  CHECK(read_experiment(least, "e").has_value());
  for (const std::string& wrong :
       {std::string(""), std::string("[[group]]\nname = \"g\"\nsubjects = 3\n"),
        least + "[[group]]\nname = \"g\"\nsubjects = 1\n", least + "[[group]]\nname = \"../h\"\nsubjects = 1\n",
        least + "[[group]]\nname = \"h\"\nsubjects = 0\n", least + "[[group]]\nname = \"h\"\nsubjects = 100000000000\n",
        least + "[[part]]\nname = \"q\"\nscenario = \"s\"\n",
        least + "[[part]]\nname = \"q\"\nscenario = \"s\"\nseconds = 1\nup_to_min = 1\n",
        least + "[[part]]\nname = \"q\"\nscenario = \"s\"\nseconds = nan\n",
        least + "[[part]]\nname = \"q\"\nscenario = \"s\"\nseconds = 1\nparameters = { a = [1] }\n",
        least + "[[condition]]\nname = \"\"\n", "seed = -1\n" + least, "order = \"random\"\n" + least,
        "x = 1\n" + least})
    CHECK_FALSE_MESSAGE(read_experiment(wrong, "e").has_value(), wrong);
}

}  // namespace septet::logging
