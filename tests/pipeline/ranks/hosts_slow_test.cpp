/// A film on several machines. They are played on this one: each name of the file of hosts gets a daemon of Open MPI of
/// its own, which a script starts in place of ssh, with a folder of its own for what it notes, and what they say goes
/// over TCP.

#include <map>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {
namespace {

/// Saved atomically, as by an editor.
void write_hosts(const fs::path& file, const std::string& names) {
  const fs::path fresh = file.string() + ".new";
  write_text(fresh, names);
  fs::rename(fresh, file);
}

/// The environment in which mpirun finds any machine here.
std::map<std::string, std::string> machines_played_here(const fs::path& agent) {
  // Daemons of one machine would trip over each other as they make and clear away the same folder.
  write_text(agent, "#!/bin/sh\nexport TMPDIR=\"$0-$1\"\nmkdir -p \"$TMPDIR\"\nshift\nexec /bin/sh -c \"$*\"\n");
  fs::permissions(agent, fs::perms::owner_all);
  auto environment = for_mpirun;
  environment["OMPI_MCA_plm_rsh_agent"] = agent.string();
  environment["OMPI_MCA_btl_tcp_if_include"] = "lo";
  // Slow enough to be met amid the film; and no tile is dealt before all can trace, so that each gets some.
  environment["SEPTET_FILM_PACES"] = "0.25,0.25,0.25";
  return environment;
}

}  // namespace

TEST_CASE("a machine that is added to the file of hosts joins a film that is being made and it is the same bytes") {
  SmallFilm film(true);
  film.samples = "400";
  REQUIRE(film.make(film.folder / "alone").code == 0);
  const fs::path out = film.folder / "film", hosts = film.folder / "hosts", statistics = film.folder / "statistics";
  write_hosts(hosts, "localhost\npc-2\n");
  auto launcher = start("septet-film", film.arguments(out, {"--hosts", hosts, "--statistics", statistics}),
                        film.log(out), machines_played_here(film.folder / "agent"));
  REQUIRE(becomes_true([&] { return has_tiles(out) || launcher.poll(); }));
  REQUIRE(!launcher.poll());
  write_hosts(hosts, "localhost\npc-2\npc-3\n");
  CHECK(exit_code(launcher) == 0);
  const std::string said = text_of(film.log(out));
  INFO(said);
  CHECK(said.find("has changed; the film goes on with it") != std::string::npos);
  CHECK(pictures_in(out) == pictures_in(film.folder / "alone"));
  const auto json = nlohmann::json::parse(text_of(statistics), nullptr, false);  // Of the programs since then.
  REQUIRE(json.is_object());
  std::set<int> programs;
  std::size_t counted = 0;
  for (const auto& tile : json.at("tiles"))
    if (tile.at(8).get<bool>()) programs.insert(tile.at(5).get<int>()), ++counted;
  CHECK(programs == std::set{0, 1, 2});
  CHECK(counted < 2 * 10 * 7);  // Earlier finished tiles are kept.
}

}  // namespace septet::pipeline
