// Variants of a drive that are shared out to programs that mpirun starts.

#include <string>
#include <vector>

#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {

TEST_CASE("variants of a drive are the same by one program and by three of mpirun") {
  const TemporaryFolder folder;
  const fs::path drive = folder / "drive", session = drive / "session.sqlite";
  const Ended driven =
      run("septet",
          {"drive", "--scenario", "walker-behind-van", "--driver", "plain", "--no-screens", "--out", drive.string()},
          folder / "drive.log");
  REQUIRE_MESSAGE(driven.code == 0, driven.error);
  const auto arguments = [&](const std::string& out) {
    return std::vector<std::string>{"what-if", session.string(),       "--change", "brake:-1s..0s/12", "--seconds", "4",
                                    "--out",   (folder / out).string()};
  };
  const Ended alone = run("septet", arguments("alone"), folder / "alone.log");
  REQUIRE_MESSAGE(alone.code == 0, alone.error);
  const auto mpirun = program::find_program("mpirun");
  REQUIRE(mpirun.has_value());
  std::vector<std::string> three{"--oversubscribe", "-n", "3", (fs::path(build_folder()) / "septet").string()};
  for (std::string& word : arguments("together")) three.push_back(std::move(word));
  const Ended together = run(mpirun->string(), three, folder / "together.log", for_mpirun);
  REQUIRE_MESSAGE(together.code == 0, together.error);
  for (const char* name : {"what-if.csv", "what-if.svg"}) {
    CAPTURE(name);
    const std::string text = text_of(folder / "alone" / name);
    CHECK(text.size() > 500);
    CHECK(text_of(folder / "together" / name) == text);
  }
}

}  // namespace septet::pipeline
