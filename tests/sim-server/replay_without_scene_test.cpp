// Whoever replays a session that keeps no scene is told why the screens are empty.

#include "sim-server/drive/opened_drive.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"
#include "engine/scene/command_codec.hpp"
#include "tests/checkout.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

/// What is said when a replay of these edits is opened.
std::string said_of_replay(const std::vector<scene::Command>& scene) {
  const TemporaryFolder folder;
  const auto session = folder / "drive.sqlite";
  auto writer = logging::SessionWriter::create(session, logging::example_info());
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (const scene::Command& command : scene) {
    Bytes bytes;
    scene::encode(command, bytes);
    writer->record(logging::SceneEdit{0, std::move(bytes)});
  }
  for (Tick tick = 0; tick <= 120; ++tick) writer->record(logging::taken(logging::drive_snapshot(tick)));
  REQUIRE(writer->finish().has_value());
  const auto told = folder / "told";
  std::FILE* const file = std::fopen(told.c_str(), "w+");
  REQUIRE(file != nullptr);
  program::ProgressLine line(file, false);
  const auto opened = open_drive({.rig = std::string(source_folder()) + "/rigs/desktop.toml", .replay = session}, line);
  std::string text(4096, '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  REQUIRE_MESSAGE(opened.has_value(), why_not(opened));
  return text;
}

}  // namespace

TEST_CASE("a replay says in one sentence that its session keeps no scene, what is shown, and what to replay instead") {
  const std::string said = said_of_replay({});
  CHECK(said.find("drive.sqlite: it keeps no scene") != std::string::npos);
  CHECK(said.find("no road and nobody") != std::string::npos);
  CHECK(said.find("replay a session that septet drive recorded") != std::string::npos);
  scene::Store store;
  scene::SceneBuilder(store).add_prototype("anything");
  std::vector<scene::Command> commands;
  scene::describe_store(store, [&](const scene::Command& command) { commands.push_back(command); });
  REQUIRE_FALSE(commands.empty());
  CHECK(said_of_replay(commands).empty());
}

}  // namespace septet::server
