// An experiment whose drives are shared out to programs that mpirun starts.
#include <signal.h>

#include <csignal>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {
namespace {

const std::string six_subjects =
    "seed = 5\n[[group]]\nname = \"a\"\nsubjects = 3\ndriver = \"plain\"\n"
    "[[group]]\nname = \"b\"\nsubjects = 3\ndriver = \"novice\"\n"
    "[[part]]\nname = \"game\"\nscenario = \"motorway-ambulance\"\nseconds = 8.0\nparameters = { vehicles = 40 }\n";

struct SmallExperiment {
  const TemporaryFolder folder;
  SmallExperiment() { write_text(folder / "e.toml", six_subjects); }

  std::vector<std::string> arguments(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"experiment", (folder / "e.toml").string(), "--out", (folder / out).string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  fs::path log(const std::string& out) const { return folder / (out + ".log"); }
  Ended make(const std::string& out, const std::vector<std::string>& more = {}) const {
    fs::remove(log(out));
    return run("septet", arguments(out, more), log(out), for_mpirun);
  }
  program::ChildProcess begin(const std::string& out, const std::vector<std::string>& more) const {
    return start("septet", arguments(out, more), log(out), for_mpirun);
  }
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> texts;
    for (const char* name : {"subjects.csv", "subjects.json", "experiment.json"}) {
      texts[name] = text_of(folder / out / name);
      CHECK_FALSE(texts[name].empty());
    }
    return texts;
  }
  std::size_t finished(const std::string& out) const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder / out, error))
      count += entry.path().filename() == "summary.json";
    return count;
  }
  fs::path a_drive(const std::string& out) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder / out))
      if (entry.path().filename() == "summary.json") return entry.path().parent_path();
    return {};
  }
  /// A drive from another machine is whole, or absent.
  bool has_half_drives(const std::string& out) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder / out))
      if (entry.path().extension() == ".coming") return true;
    return false;
  }
};

}  // namespace

TEST_CASE("an experiment has the same results by one program and by three of mpirun") {
  const SmallExperiment experiment;
  const Ended alone = experiment.make("alone");
  REQUIRE_MESSAGE(alone.code == 0, alone.error);
  const Ended together = experiment.make("together", {"--ranks", "3", "--jobs", "1"});
  REQUIRE_MESSAGE(together.code == 0, together.error);
  CHECK(experiment.results("together") == experiment.results("alone"));
  CHECK_FALSE(experiment.has_half_drives("together"));
}

TEST_CASE("a program of mpirun that is killed costs what it was driving and the first of them only another start") {
  const SmallExperiment experiment;
  REQUIRE(experiment.make("alone").code == 0);
  const auto expected = experiment.results("alone");
  for (const int victim : {1, 0}) {
    const std::string out = "killed-" + std::to_string(victim);
    CAPTURE(out);
    auto launcher = experiment.begin(out, {"--ranks", "3", "--jobs", "1"});
    REQUIRE(becomes_true([&] { return experiment.finished(out) > 0 || launcher.poll(); }));
    const auto mpirun = mpirun_of(launcher.process_id());
    REQUIRE(mpirun.has_value());
    const auto process = rank_of(*mpirun, victim);
    REQUIRE(process.has_value());
    REQUIRE(::kill(*process, SIGKILL) == 0);
    const int code = exit_code(launcher);
    if (victim == 0) CHECK(code != 0);
    if (code != 0) {
      // The children of the killed one may hold its folder for a moment.
      Ended resumed{1, {}};
      becomes_true([&] { return (resumed = experiment.make(out, {"--ranks", "2", "--jobs", "1"})).code == 0; });
      CHECK_MESSAGE(resumed.code == 0, resumed.error);
    }
    CHECK(experiment.results(out) == expected);
    CHECK_FALSE(experiment.has_half_drives(out));
  }
}

TEST_CASE(
    "of a drive that was coming from another program when all was killed nothing is left, wherever it is driven next") {
  const SmallExperiment experiment;
  REQUIRE(experiment.make("killed").code == 0);
  const auto expected = experiment.results("killed");
  const fs::path whole = experiment.a_drive("killed");
  fs::rename(whole, whole.string() + ".coming");
  REQUIRE(experiment.make("killed").code == 0);
  CHECK(experiment.results("killed") == expected);
  CHECK_FALSE(experiment.has_half_drives("killed"));
}

TEST_CASE("without mpirun an experiment for several programs says what is missing") {
  const SmallExperiment experiment;
  auto environment = for_mpirun;
  environment["PATH"] = experiment.folder.path().string();
  const Ended ended =
      run("septet", experiment.arguments("none", {"--ranks", "2"}), experiment.log("none"), environment);
  CHECK(ended.code == 1);
  CHECK_MESSAGE(ended.error.find("openmpi-bin") != std::string::npos, ended.error);
  const Ended no_hosts = experiment.make("none", {"--hosts", (experiment.folder / "nowhere").string()});
  CHECK(no_hosts.code == 1);
  CHECK_MESSAGE(no_hosts.error.find("No such file or directory") != std::string::npos, no_hosts.error);
}

}  // namespace septet::pipeline
