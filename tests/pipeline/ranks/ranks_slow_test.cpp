#include <sys/mount.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/checkout.hpp"
#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++number;
  return number;
}

/// Of a film's standard error, besides that the test's session has no scene.
std::size_t messages_in(const std::string& error) {
  return count(error, "septet: ") - count(error, "it keeps no scene, so the pictures show");
}

/// Ends one of the film's programs once tiles have come: mpirun, or the program of a number. False: it had ended before, as
/// it may on a busy machine.
bool kill_amid(program::ChildProcess& launcher, const fs::path& out, std::optional<int> rank) {
  REQUIRE(becomes_true([&] { return has_tiles(out) || launcher.poll(); }));
  const auto mpirun = mpirun_of(launcher.process_id());
  const auto victim = mpirun && rank ? rank_of(*mpirun, *rank) : mpirun;
  return victim && ::kill(*victim, SIGKILL) == 0;
}

}  // namespace

TEST_CASE("a film is the same bytes by one program and by two and a worker or the master or mpirun may be killed") {
  const SmallFilm film;
  const fs::path alone = film.folder / "alone";
  REQUIRE(film.make(alone).code == 0);
  const auto pictures = pictures_in(alone);
  CHECK(pictures.size() == 2);
  const Ended together = film.make(film.folder / "together", {"--ranks", "2"});
  INFO(together.error);
  CHECK(together.code == 0);
  CHECK(pictures_in(film.folder / "together") == pictures);

  struct Victim {
    const char* name;
    std::optional<int> rank;
    const char* said;
  };
  int killed = 0;
  for (const Victim& victim : {Victim{"worker", 1, "program 1 of mpirun is gone"}, Victim{"master", 0, "was lost"},
                               Victim{"mpirun", std::nullopt, "was lost"}}) {
    CAPTURE(victim.name);
    const fs::path out = film.folder / victim.name;
    auto launcher = film.begin(out, {"--ranks", "2"});
    killed += kill_amid(launcher, out, victim.rank);
    std::size_t whole = 0;  // On a busy machine the kill may come late.
    for (const fs::directory_entry& entry : fs::directory_iterator(out)) whole += entry.path().extension() == ".png";
    CHECK(exit_code(launcher) == 0);
    const std::string said = text_of(film.log(out));
    INFO(said);
    CHECK(messages_in(said) <= 1);
    // A worker's end is noticed each second; the film may be whole before.
    if (victim.rank != 1 && whole < pictures.size()) CHECK(said.find(victim.said) != std::string::npos);
    CHECK(pictures_in(out) == pictures);
  }
  CHECK(killed > 0);
}

TEST_CASE("how tiles are dealt changes no picture and every tile counts once") {
  const SmallFilm film;
  REQUIRE(film.make(film.folder / "alone").code == 0);
  const auto pictures = pictures_in(film.folder / "alone");
  for (const char* schedule : {"paper", "round-robin"}) {
    CAPTURE(schedule);
    const fs::path out = film.folder / schedule, statistics = film.folder / "statistics.json";
    auto launcher =
        film.begin(out, {"--ranks", "3", "--schedule", schedule, "--buckets", "9", "--statistics", statistics});
    // Late tiles are not taken over there: the loss must be noticed.
    kill_amid(launcher, out, 2);
    CHECK(exit_code(launcher) == 0);
    INFO(text_of(film.log(out)));
    CHECK(pictures_in(out) == pictures);
    const auto json = nlohmann::json::parse(text_of(statistics), nullptr, false);
    REQUIRE(json.is_object());
    std::map<std::vector<int>, int> counted;
    for (const auto& tile : json.at("tiles")) {
      CHECK(tile.at(6).get<double>() > 0.0);
      if (tile.at(8).get<bool>()) ++counted[{tile.at(0).get<int>(), tile.at(1).get<int>(), tile.at(2).get<int>()}];
    }
    CHECK(counted.size() == 2 * 10 * 7);
    CHECK(std::ranges::all_of(counted, [](const auto& tile) { return tile.second == 1; }));
  }
}

TEST_CASE("programs shoot the photons of one picture together and it is the same bytes as by one") {
  SmallFilm film(true);
  film.size = "96x64";
  write_text(film.folder / "shots.toml", "[[shot]]\nfrom_s = 0\nto_s = 0.04\ndistance_m = 6\npitch_deg = -20\n");
  const std::vector<std::string> photons{"--caustic-photons", "60000"};
  REQUIRE(film.make(film.folder / "alone", photons).code == 0);
  REQUIRE(film.make(film.folder / "without", {"--caustic-photons", "0"}).code == 0);
  const auto pictures = pictures_in(film.folder / "alone");
  CHECK(pictures.size() == 1);
  CHECK(pictures != pictures_in(film.folder / "without"));
  const fs::path statistics = film.folder / "statistics.json";
  std::vector<std::string> together{"--ranks", "3", "--statistics", statistics};
  together.insert(together.end(), photons.begin(), photons.end());
  const Ended ended = film.make(film.folder / "together", together);
  INFO(ended.error);
  CHECK(ended.code == 0);
  CHECK(pictures_in(film.folder / "together") == pictures);
  const auto json = nlohmann::json::parse(text_of(statistics), nullptr, false);
  REQUIRE(json.is_object());
  CHECK(json.at("photon_buckets").get<int>() == 15);  // Of 4096 photons, each gathered once.
}

TEST_CASE("a film whose starter is killed ends with its programs and goes on") {
  const SmallFilm film;
  const fs::path out = film.folder / "film";
  int mpirun = 0;
  {
    auto launcher = film.begin(out, {"--ranks", "3"});
    REQUIRE(becomes_true([&] { return has_tiles(out); }));
    mpirun = mpirun_of(launcher.process_id()).value_or(0);
    launcher.send_signal(SIGKILL);
    CHECK(exit_code(launcher) == -1);
  }
  REQUIRE(mpirun > 0);
  CHECK(becomes_true([&] { return ::kill(mpirun, 0) != 0; }));
  CHECK(film.make(out).error.find("add --resume") != std::string::npos);
  // Its programs see that mpirun is gone and leave the folder.
  CHECK(becomes_true([&] { return film.make(out, {"--resume"}).code == 0; }));
  REQUIRE(film.make(film.folder / "alone").code == 0);
  CHECK(pictures_in(out) == pictures_in(film.folder / "alone"));
}

TEST_CASE("a full disk ends a film with one message and it goes on where there is room") {
  SmallFilm film;
  film.samples = "2";
  REQUIRE(film.make(film.folder / "alone").code == 0);
  const fs::path disk = film.folder / "disk", out = film.folder / "out";
  fs::create_directories(disk);
  const bool is_mounted = ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=300k") == 0;
  if (!is_mounted) MESSAGE("no permission to mount a small disk: by one program, with a limit of a file's size");
  const Ended ended = is_mounted ? film.make(disk / "out", {"--ranks", "2"}) : [&] {
    std::string command = "ulimit -f 300; exec " + build_folder() + "/septet-film";
    for (const std::string& argument : film.arguments(disk / "out", {})) command += " '" + argument + "'";
    return run("/bin/sh", {"-c", command}, film.log(out));
  }();
  INFO(ended.error);
  CHECK(ended.code == 1);
  CHECK(messages_in(ended.error) == 1);
  CHECK(ended.error.find("--resume") != std::string::npos);
  REQUIRE(has_tiles(disk / "out"));
  fs::copy(disk / "out", out, fs::copy_options::recursive);
  const Ended resumed = film.make(out, {"--resume"});
  INFO(resumed.error);
  CHECK(resumed.code == 0);
  CHECK(pictures_in(out) == pictures_in(film.folder / "alone"));
  if (is_mounted) CHECK(::umount2(disk.c_str(), MNT_DETACH) == 0);
}

/// Environment whose mpirun counts its starts in a file; the first of them crash before any result.
std::map<std::string, std::string> mpirun_that_crashes(const fs::path& folder, int times) {
  fs::create_directories(folder);
  const fs::path mpirun = folder / "mpirun";
  const char* path = std::getenv("PATH");
  REQUIRE(path != nullptr);
  write_text(mpirun, fmt::format("#!/bin/sh\n"
                                 "echo . >> '{}/starts'\n"
                                 "if [ $(wc -l < '{}/starts') -gt {} ]; then PATH='{}' exec mpirun \"$@\"; fi\n"
                                 "printf -- '---\\r\\n*** Process received signal ***\\r\\nSignal: 11\\n' >&2\n"
                                 "exit 139\n",
                                 folder.string(), folder.string(), times, path));
  fs::permissions(mpirun, fs::perms::owner_all);
  auto environment = for_mpirun;
  environment["PATH"] = folder.string() + ':' + path;
  return environment;
}

TEST_CASE("a start of mpirun that crashes before a tile has come is tried again twice and no more") {
  SmallFilm film;
  film.samples = "2";
  REQUIRE(film.make(film.folder / "alone").code == 0);
  const fs::path out = film.folder / "film", err = film.folder / "err";
  const Ended made =
      run("septet-film", film.arguments(out, {"--ranks", "2"}), err, mpirun_that_crashes(film.folder / "twice", 2));
  INFO(made.error);
  CHECK(made.code == 0);
  CHECK(count(made.error, "was lost") == 2);
  CHECK(pictures_in(out) == pictures_in(film.folder / "alone"));

  fs::remove(err);
  const Ended lost = run("septet-film", film.arguments(film.folder / "never", {"--ranks", "2"}), err,
                         mpirun_that_crashes(film.folder / "thrice", 3));
  INFO(lost.error);
  CHECK(lost.code == 1);
  CHECK(count(text_of(film.folder / "thrice/starts"), ".") == 3);
  CHECK(lost.error.find("mpirun has ended with status 139: *** Process received signal *** Signal: 11;") !=
        std::string::npos);
}

TEST_CASE("what mpirun cannot do is said in one line") {
  const SmallFilm film;
  const fs::path out = film.folder / "film", err = film.folder / "err";
  const auto refused = [&](const std::vector<std::string>& more, std::map<std::string, std::string> environment,
                           const std::vector<std::string>& words) {
    fs::remove(err);
    check_refused(run("septet-film", film.arguments(out, more), err, std::move(environment)), words, out);
  };
  refused({"--ranks", "2"}, {{"PATH", (film.folder / "none").string()}}, {"mpirun", "openmpi-bin"});
  refused({"--hosts", (film.folder / "none").string()}, for_mpirun, {"none", "No such file or directory"});
  refused({"--ranks", "0"}, for_mpirun, {"--ranks", "0"});
  std::vector<std::string> raster = film.arguments(out, {"--ranks", "2"});
  std::ranges::replace(raster, "traced", "raster");
  fs::remove(err);
  check_refused(run("septet-film", raster, err, for_mpirun), {"--ranks", "--renderer traced"}, out);
}

}  // namespace septet::pipeline
