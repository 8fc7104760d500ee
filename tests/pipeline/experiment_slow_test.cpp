// An experiment as its user runs it: once, again, killed, without space.

#include <sys/mount.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

const std::string small_experiment =
    "seed = 5\n[[group]]\nname = \"a\"\nsubjects = 2\ndriver = \"plain\"\nstops_mean_min = 1.1\n"
    "[[group]]\nname = \"b\"\nsubjects = 2\ndriver = \"novice\"\n"
    "[[part]]\nname = \"game\"\nscenario = \"motorway-ambulance\"\nup_to_min = 1.2\nparameters = { vehicles = 40 }\n";

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("an experiment run twice has identical numbers and one that was killed goes on to the same") {
  const TemporaryFolder folder;
  write_text(folder / "e.toml", small_experiment);
  const std::string file = (folder / "e.toml").string();
  const auto whole = run("septet", {"experiment", file, "--out", (folder / "whole").string()}, folder / "1.log");
  REQUIRE_MESSAGE(whole.code == 0, whole.error);
  const std::string table = content_of(folder / "whole/subjects.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 5);

  // Killed once something is finished, without a word to its children.
  auto process =
      start("septet", {"experiment", file, "--jobs", "1", "--out", (folder / "killed").string()}, folder / "2.log");
  CHECK(becomes_true([&] { return fs::exists(folder / "killed/subjects/P03/game-01/summary.json"); }));
  process.send_signal(SIGKILL);
  CHECK(becomes_true([&] { return process.poll().has_value(); }));
  CHECK_FALSE(fs::exists(folder / "killed/subjects.csv"));
  const auto goes_on = [&] {
    return run("septet", {"experiment", file, "--out", (folder / "killed").string()}, folder / "3.log");
  };
  auto resumed = goes_on();
  // The child of the killed one may hold its folder for a moment.
  becomes_true([&] { return resumed.code == 0 || (resumed = goes_on()).code == 0; });
  REQUIRE_MESSAGE(resumed.code == 0, resumed.error);
  for (const char* name : {"subjects.csv", "subjects.json", "experiment.json"}) {
    const bool is_same = content_of(folder / "killed" / name) == content_of(folder / "whole" / name);
    CHECK_MESSAGE(is_same, name);
  }

  // A forgotten subject is not driven again, and is in no figure.
  const auto forgotten = run("septet", {"session", "forget", "P02", (folder / "whole").string()}, folder / "f.log");
  REQUIRE_MESSAGE(forgotten.code == 0, forgotten.error);
  const auto without = run("septet", {"experiment", file, "--out", (folder / "whole").string()}, folder / "w.log");
  CHECK_MESSAGE(without.code == 0, without.error);
  CHECK_FALSE(fs::exists(folder / "whole/subjects/P02"));
  CHECK(fs::exists(folder / "whole/subjects/forgotten-1/game-01/session.sqlite"));
  const std::string rest = content_of(folder / "whole/subjects.csv");
  CHECK(std::count(rest.begin(), rest.end(), '\n') == 4);
  CHECK(rest.find("P02") == std::string::npos);
  CHECK(content_of(folder / "whole/report.html").find("1 of 4 subjects was forgotten") != std::string::npos);
  auto next = start("septet", {"experiment", "next", file, "--out", (folder / "whole").string()}, folder / "n.log");
  CHECK(next.read_line(patience).value_or("") == "4 of 4 subjects are finished, 1 of them forgotten");

  // Another file in the same folder is another experiment if it changes finished drives, or forgotten subjects…
  const auto changed = [&](const std::string& text) {
    write_text(folder / "e.toml", text);
    return run("septet", {"experiment", file, "--out", (folder / "whole").string()}, folder / "4.log");
  };
  const auto with = [&](const std::string& was, const std::string& is) {
    std::string text = small_experiment;
    return text.replace(text.find(was), was.size(), is);
  };
  for (const std::string& text : {with("seed = 5", "seed = 6"), with("= 40", "= 41"), with("1.2", "1.3"),
                                  with("subjects = 2", "subjects = 1"), with("plain", "novice")}) {
    const auto other = changed(text);
    INFO(text);
    CHECK(other.code == 1);
    CHECK_MESSAGE(other.error.find("another experiment") != std::string::npos, other.error);
    CHECK(content_of(folder / "whole/subjects.csv") == rest);
  }
  // … and else the same, mended: it goes on where it was.
  const auto mended = changed("title = \"Mended\"\nquestionnaires = [\"ssq\"]\n" + small_experiment);
  CHECK_MESSAGE(mended.code == 0, mended.error);
  CHECK(content_of(folder / "whole/subjects.csv") == rest);
  CHECK(content_of(folder / "whole/experiment.1.toml") == small_experiment);
  CHECK(content_of(folder / "whole/report.html").find("Mended") != std::string::npos);
}

TEST_CASE("an experiment that meets a full disk says so once and goes on to the same numbers when there is room") {
  const TemporaryFolder folder;
  const fs::path disk = folder / "disk";
  fs::create_directories(disk);
  write_text(folder / "e.toml",
             "seed = 5\nlog = \"samples\"\n[[group]]\nname = \"a\"\nsubjects = 6\ndriver = \"plain\"\n"
             "[[part]]\nname = \"task\"\nscenario = \"rescue-lane\"\nseconds = 20.0\nparameters = { vehicles = 20 }\n");
  const auto experiment = [&](const fs::path& out, const char* log) {
    return run("septet", {"experiment", (folder / "e.toml").string(), "--jobs", "1", "--out", out.string()},
               folder / log);
  };
  REQUIRE(experiment(folder / "ample", "ample.log").code == 0);
  // Room for the first of six subjects; a log takes more while it is written, and the more the slower the machine is.
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "ample" / "subjects" / "P01"))
    if (entry.is_regular_file()) bytes += entry.file_size();
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, fmt::format("size={}", bytes * 11 / 2).c_str()) != 0) {
    MESSAGE("no permission to mount a small disk: skipped");
    return;
  }
  const Ended full = experiment(disk / "out", "full.log");
  CHECK(full.code == 1);
  CHECK_MESSAGE(full.error.find("is full; free some space") != std::string::npos, full.error);
  CHECK(fs::exists(disk / "out/subjects/P01/task-01/summary.json"));
  CHECK_FALSE(fs::exists(disk / "out/subjects.csv"));
  REQUIRE(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=64m") == 0);
  const Ended resumed = experiment(disk / "out", "resumed.log");
  CHECK_MESSAGE(resumed.code == 0, resumed.error);
  for (const char* name : {"subjects.csv", "experiment.json"})
    CHECK_MESSAGE(content_of(disk / "out" / name) == content_of(folder / "ample" / name), name);
  CHECK(::umount2(disk.c_str(), MNT_DETACH) == 0);
}

TEST_CASE("a participant who is forgotten is in no file of the drives any more and a report pools the rest") {
  const TemporaryFolder folder;
  const auto drive = [&](const std::string& code, const std::string& group) {
    const auto driven =
        run("septet",
            {"drive", "--no-screens", "--seconds", "2", "--log", "samples", "--participant", code, "--group", group,
             "--note", "told in confidence", "--out", (folder / "data" / code).string()},
            folder / "drive.log");
    REQUIRE_MESSAGE(driven.code == 0, driven.error);
  };
  drive("Q77", "x");
  drive("Q78", "y");
  // Such a session can be measured, and a replay gives the reason of its refusal.
  const std::string session = (folder / "data/Q77/session.sqlite").string();
  for (const char* command : {"replay", "film", "sound"}) {
    const auto shown = run("septet", {command, session, "--out", (folder / "shown").string()}, folder / "s.log");
    CHECK(shown.code == 1);
    CHECK_MESSAGE(shown.error.find("without snapshots") != std::string::npos, command, shown.error);
  }
  CHECK_FALSE(fs::exists(folder / "shown"));
  // Files beside a session hold answers given after it, and no longer the forgotten data.
  const auto told = [&](const std::string& words) {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "data"))
      if (entry.path().filename() == "report.html" || entry.path().filename() == "summary.json")
        files += content_of(entry.path()).find(words) != std::string::npos;
    return files;
  };
  const auto stopped = run("septet", {"session", "stop", session, "--reason", "felt so sick"}, folder / "t.log");
  CHECK_MESSAGE(stopped.code == 0, stopped.error);
  CHECK(told("felt so sick") == 2);
  const auto forgotten = run("septet", {"session", "forget", "Q77", (folder / "data").string()}, folder / "f.log");
  CHECK_MESSAGE(forgotten.code == 0, forgotten.error);
  CHECK(told("felt so sick") == 0);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "data")) {
    CHECK(entry.path().string().find("Q77") == std::string::npos);
    if (!entry.is_regular_file()) continue;
    ++files;
    CHECK_MESSAGE(content_of(entry.path()).find("Q77") == std::string::npos, entry.path().string());
  }
  CHECK(files >= 6);
  const auto report =
      run("septet", {"report", (folder / "data").string(), "--out", (folder / "pooled").string()}, folder / "r.log");
  CHECK_MESSAGE(report.code == 0, report.error);
  const std::string table = content_of(folder / "pooled/subjects.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 3);
  CHECK(table.find("Q78,y,") != std::string::npos);
  CHECK(run("septet", {"session", "forget", "Q77", (folder / "data").string()}, folder / "f.log").code == 1);
  const auto deleted =
      run("septet", {"session", "forget", "Q78", (folder / "data").string(), "--delete"}, folder / "f.log");
  CHECK(deleted.code == 0);
  CHECK_FALSE(fs::exists(folder / "data/Q78"));
}

TEST_CASE("an experiment whose second part cannot be driven drives nobody and next does not send anybody") {
  const TemporaryFolder folder;
  const fs::path file = folder / "e.toml";
  write_text(
      file, small_experiment +
                "[[part]]\nname = \"task\"\nscenario = \"rescue-lane\"\nseconds = 6.0\nparameters = { no_such = 1 }\n");
  for (const bool next : {false, true}) {
    std::vector<std::string> words{"experiment"};
    if (next) words.emplace_back("next");
    words.insert(words.end(), {file.string(), "--out", (folder / "out").string()});
    check_refused(run("septet", words, folder / (next ? "next.log" : "log")),
                  {"part task", "no_such", "rescue-lane.xosc"}, folder / "out");
  }
}

TEST_CASE("what is due after each condition is asked after each and answered is answered whatever the file is called") {
  const TemporaryFolder folder;
  write_text(
      folder / "quest.toml",
      "id = \"workload\"\ntitle = \"W\"\n[[item]]\nid = \"mental\"\ntext = \"How hard?\"\nleast = 0\nmost = 20\n");
  write_text(folder / "answer.toml", "mental = 2\n");
  const std::string quest = (folder / "quest.toml").string();
  write_text(
      folder / "e.toml",
      "seed = 5\norder = \"as-listed\"\nquestionnaires = [\"paper\"]\nquestionnaires_after_each_condition = [\"" +
          quest +
          "\"]\n[[group]]\nname = \"a\"\nsubjects = 1\ndriver = \"plain\"\n"
          "[[condition]]\nname = \"few\"\nparameters = { vehicles = 4 }\n"
          "[[condition]]\nname = \"many\"\nparameters = { vehicles = 20 }\n"
          "[[part]]\nname = \"task\"\nscenario = \"rescue-lane\"\nseconds = 2.0\n");
  const std::vector<std::string> words{(folder / "e.toml").string(), "--out", (folder / "out").string()};
  std::vector<std::string> whole{"experiment"};
  whole.insert(whole.end(), words.begin(), words.end());
  const auto driven = run("septet", whole, folder / "1.log");
  REQUIRE_MESSAGE(driven.code == 0, driven.error);
  const auto said_next = [&] {
    std::vector<std::string> next{"experiment", "next"};
    next.insert(next.end(), words.begin(), words.end());
    auto process = start("septet", next, folder / "n.log");
    std::string text;
    while (const auto line = process.read_line(patience)) text += *line + '\n';
    return text;
  };
  const auto answer = [&](const char* drive, const std::string& questionnaire) {
    std::vector<std::string> arguments{
        "session", "answer", (folder / "out/subjects/P01" / drive / "session.sqlite").string(), questionnaire};
    arguments.insert(arguments.end(), {"--answers", (folder / "answer.toml").string()});
    return run("septet", arguments, folder / "a.log").code;
  };
  std::string said = said_next();
  CHECK(said.find("P01 has not answered " + quest + " after few") != std::string::npos);
  CHECK(said.find("P01 has not answered " + quest + " after many") != std::string::npos);
  CHECK(said.find("P01 has not answered paper:") != std::string::npos);
  CHECK(answer("task-few-01", quest) == 0);
  said = said_next();
  CHECK(said.find("after few") == std::string::npos);
  CHECK(said.find("after many") != std::string::npos);
  CHECK(answer("task-many-01", quest) == 0);
  write_text(folder / "answer.toml", "fun = 4\n");
  CHECK(answer("task-few-01", "paper") == 0);  // Of one that is due once, any drive's will do.
  CHECK(said_next() == "1 of 1 subjects are finished\n");
}

}  // namespace septet::pipeline
