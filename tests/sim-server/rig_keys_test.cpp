#include "sim-server/host/rig_keys.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "engine/editor/edit_place.hpp"
#include "engine/net/keys.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace {
namespace fs = std::filesystem;

rig::Rig two_machines() {
  rig::Rig rig;
  rig.screens.resize(2);
  rig.screens[0].name = "left";
  rig.screens[0].machine = "pc-1";
  rig.screens[1].name = "right";
  rig.screens[1].machine = "pc-2";
  return rig;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a key that was carried away and deleted here keeps its place in the list and a screen more gets its own") {
  const septet::TemporaryFolder folder;
  const fs::path list = folder.path() / "server" / "allowed-clients";
  rig::Rig rig = two_machines();
  auto said = write_rig_keys(rig, folder.path());
  REQUIRE(said.has_value());
  CHECK(std::ranges::count_if(
            *said, [](const std::string& line) { return line.find("new keys of") != std::string::npos; }) == 3);
  const std::string before = text_of(list);
  fs::remove(folder.path() / "pc-1" / "left.key");

  rig.screens.resize(3);
  rig.screens[2].name = "rear";
  rig.screens[2].machine = "pc-2";
  said = write_rig_keys(rig, folder.path());
  REQUIRE(said.has_value());
  CHECK(text_of(list).starts_with(before));
  CHECK(net::load_allowed_clients(list)->size() == 3);
  CHECK_FALSE(fs::exists(folder.path() / "pc-1" / "left.key"));
  CHECK(fs::exists(folder.path() / "pc-2" / "rear.key"));
}

TEST_CASE("a name that was taken off the list gets a new key") {
  const septet::TemporaryFolder folder;
  const fs::path list = folder.path() / "server" / "allowed-clients";
  REQUIRE(write_rig_keys(two_machines(), folder.path()).has_value());
  const auto before = *net::load_allowed_clients(list);
  fs::remove(folder.path() / "pc-1" / "left.key");
  std::ofstream(list) << net::to_text(before[1].key) << " right\n";
  REQUIRE(write_rig_keys(two_machines(), folder.path()).has_value());
  const auto after = *net::load_allowed_clients(list);
  REQUIRE(after.size() == 2);
  CHECK(after[0].key == before[1].key);
  CHECK(after[1].name == "left");
  CHECK(after[1].key != before[0].key);
}

TEST_CASE("an editor's folder has all that it needs and its rights are those of the newest call") {
  const septet::TemporaryFolder folder;
  const fs::path list = folder.path() / "server" / "allowed-clients";
  rig::Rig rig = two_machines();
  rig.network.server_address = "10.7.0.1";
  const auto keys_with = [&](const char* editor) {
    const auto parsed = parse_editor_key(editor);
    REQUIRE(parsed.has_value());
    REQUIRE(write_rig_keys(rig, folder.path(), {*parsed}).has_value());
    return net::load_allowed_clients(list)->back();
  };
  const net::AllowedClient first = keys_with("lab=edit stimuli/ create move");
  CHECK(first.name == "lab");
  CHECK(net::describe(first.rights) == "may move, create below stimuli/");
  CHECK(fs::exists(folder.path() / "lab" / "server.public"));
  CHECK(net::load_identity(folder.path() / "lab" / "lab.key")->public_key() == first.key);
  CHECK(text_of(folder.path() / "lab" / editor::address_file) == "10.7.0.1:4750\n");
  const net::AllowedClient second = keys_with("lab=look");
  CHECK(second.key == first.key);
  CHECK(net::describe(second.rights) == "looks");
  CHECK(net::load_allowed_clients(list)->size() == 3);
}

TEST_CASE("a name or a right that cannot stand in the list is refused") {
  for (const char* bad : {"", "a b", "../x", "car", "server", "lab=", "lab=edits", "lab=look hide", "lab=edit\nKEY x"})
    CHECK_FALSE(parse_editor_key(bad).has_value());
  const septet::TemporaryFolder folder;
  CHECK_FALSE(write_rig_keys(two_machines(), folder.path(), {{"left"}}).has_value());
}

}  // namespace septet::server
