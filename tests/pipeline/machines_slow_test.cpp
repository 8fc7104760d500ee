#include <csignal>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

/// The programs of a rig of several machines, each started by itself with the keys of its own folder.
struct Machines {
  const TemporaryFolder folder;
  fs::path keys = folder / "keys", rig = folder / "small.toml";
  std::string port = std::to_string(free_port());

  Machines() {
    // Three "machines" on the loopback network, which the server listens on alone.
    std::string text = small_rig(2, "scene_port = " + port + "\ntick_port = " + std::to_string(free_port()) +
                                        "\ninterface_address = \"127.0.0.1\"\ntransport = \"unicast\"");
    for (const std::string name : {"a", "b"}) {
      const std::string line = "name = \"" + name + "\"\n";
      text.replace(text.find(line), line.size(), line + "machine = \"pc-" + name + "\"\n");
    }
    write_text(rig, text);
    REQUIRE(run("septet", {"rig", "keys", rig.string(), "--out", keys.string()}, folder / "keys.err").code == 0);
  }
  fs::path log(const std::string& name) const { return folder / (name + ".err"); }
  /// The first that does not come ends the test: each further one would be waited for as long.
  void says(const std::string& name, const std::string& words) const {
    const bool said = becomes_true([&] { return text_of(log(name)).find(words) != std::string::npos; });
    INFO(name << " says:\n" << text_of(log(name)));
    REQUIRE_MESSAGE(said, words);
  }
  /// A screen that was sent away. One that no processor was given to may be dropped as silent, and comes back: that
  /// says nothing.
  bool sent_away(const std::string& server, const std::string& screen) const {
    const std::string text = text_of(log(server)), words = "screen " + screen + " left: ";
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
      if (!text.substr(at + words.size()).starts_with("not heard for")) return true;
    return false;
  }
  program::ChildProcess start_server(const std::string& name, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{
        "--rig", rig.string(), "--keys", (keys / "server").string(), "--out", (folder / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start("septet-server", arguments, log(name));
  }
  program::ChildProcess start_screen(const std::string& screen, const fs::path& its_keys,
                                     const std::string& log_name) const {
    return start("septet-screen",
                 {"--name", screen, "--server", "127.0.0.1:" + port, "--keys", its_keys.string(), "--virtual"},
                 log(log_name));
  }
};

}  // namespace

TEST_CASE("a rig of several machines is started in any order and each part says what it waits for") {
  const Machines rig;
  auto a = rig.start_screen("a", rig.keys / "pc-a", "a");
  rig.says("a", "no answer from 127.0.0.1:" + rig.port);
  auto server = rig.start_server("first");
  rig.says("a", "connected to the server");
  rig.says("first", "waiting for b (Enter: drive without)");
  CHECK(text_of(rig.log("first")).find("shows tick") == std::string::npos);

  // Another key than the list's, another server's key, another screen's key: each gets a message, and goes on trying.
  fs::create_directories(rig.folder / "stranger");
  REQUIRE(net::load_or_create_identity(rig.folder / "stranger" / "b.key").has_value());
  fs::copy_file(rig.keys / "pc-b" / "server.public", rig.folder / "stranger" / "server.public");
  auto stranger = rig.start_screen("b", rig.folder / "stranger", "stranger");
  rig.says("stranger", "this key is not on its list");
  rig.says("first", "which is not on the list of allowed clients");
  stranger.stop();
  fs::create_directories(rig.folder / "astray");
  fs::copy_file(rig.keys / "pc-b" / "b.key", rig.folder / "astray" / "b.key");
  const auto other = net::load_or_create_identity(rig.folder / "other.key");
  write_text(rig.folder / "astray" / "server.public", net::to_text(other->public_key()) + '\n');
  auto astray = rig.start_screen("b", rig.folder / "astray", "astray");
  rig.says("astray", "another one than server.public says");
  astray.stop();
  fs::copy_file(rig.keys / "pc-b" / "b.key", rig.folder / "astray" / "a.key");
  fs::copy_file(rig.keys / "pc-b" / "server.public", rig.folder / "astray" / "server.public",
                fs::copy_options::overwrite_existing);
  auto impostor = rig.start_screen("a", rig.folder / "astray", "impostor");
  rig.says("impostor", "its key is called \"b\" in allowed-clients, so it cannot be screen \"a\"");
  CHECK_FALSE(impostor.poll().has_value());
  impostor.stop();
  CHECK_FALSE(rig.sent_away("first", "a"));

  auto b = rig.start_screen("b", rig.keys / "pc-b", "b");
  rig.says("first", "screen a shows tick");
  rig.says("first", "screen b shows tick");

  // A key that leaves the list is out at once, and back when it returns.
  const fs::path list = rig.keys / "server" / "allowed-clients";
  const std::string whole = text_of(list);
  std::string without = whole;
  const auto end = without.find(" a\n") + 3, begin = without.rfind('\n', end - 4) + 1;
  without.erase(begin, end - begin);
  write_text(list, without);
  rig.says("first", "screen a left: it is no longer allowed");
  rig.says("a", "the server said goodbye: it is no longer allowed");
  rig.says("a", "this key is not on its list");
  CHECK_FALSE(rig.sent_away("first", "b"));
  write_text(list, whole);
  const auto said_since_it_left = [&](const std::string& words) {
    const std::string text = text_of(rig.log("first"));
    return text.find(words, text.find("screen a left: it is no longer allowed")) != std::string::npos;
  };
  CHECK(becomes_true([&] { return said_since_it_left("screen a shows tick"); }));

  // A server that is started again finds its screens.
  server.send_signal(SIGKILL);
  CHECK(exit_code(server) == -1);
  auto next = rig.start_server("second");
  rig.says("second", "screen a shows tick");
  rig.says("second", "screen b shows tick");

  // A second holder of a key is refused while the first one is alive, and takes its place once that one has gone
  // silently.
  auto twin = rig.start_screen("a", rig.keys / "pc-a", "twin");
  rig.says("twin", "another client with this key is connected");
  rig.says("second", "a second client with the key of a");
  CHECK_FALSE(rig.sent_away("second", "a"));
  a.send_signal(SIGKILL);
  rig.says("twin", "connected to the server");
  next.send_signal(SIGTERM);
  CHECK(exit_code(next) == 3);  // Stopped by a person.
  CHECK(exit_code(twin) == 0);
  CHECK(exit_code(b) == 0);
}

TEST_CASE("the server drives without missing screens after the time that it was given") {
  const Machines rig;
  auto server = rig.start_server("alone", {"--wait-for-screens", "0.5", "--seconds", "0.5"});
  rig.says("alone", "the drive begins without a, b");
  CHECK(exit_code(server) == 0);
}

TEST_CASE("the keys of a rig are made once and anew only for a name that was taken off the list") {
  const Machines rig;
  const std::string key = text_of(rig.keys / "pc-a" / "a.key"), list = text_of(rig.keys / "server" / "allowed-clients");
  for (const fs::path& file :
       {rig.keys / "server" / "server.key", rig.keys / "pc-a" / "a.key", rig.keys / "pc-b" / "b.key"}) {
    CAPTURE(file.string());
    CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  }
  CHECK_FALSE(fs::exists(rig.keys / "pc-a" / "b.key"));
  CHECK_FALSE(fs::exists(rig.keys / "pc-a" / "server.key"));
  CHECK(text_of(rig.keys / "pc-a" / "server.public") == text_of(rig.keys / "server" / "server.public"));
  CHECK(net::load_allowed_clients(rig.keys / "server" / "allowed-clients")->size() == 2);

  const std::vector<std::string> again{"rig", "keys", rig.rig.string(), "--out", rig.keys.string()};
  // It was carried to its machine.
  fs::remove(rig.keys / "pc-b" / "b.key");
  CHECK(run("septet", again, rig.folder / "again.err").code == 0);
  CHECK(text_of(rig.keys / "server" / "allowed-clients") == list);
  CHECK_FALSE(fs::exists(rig.keys / "pc-b" / "b.key"));
  // It was lost there.
  write_text(rig.keys / "server" / "allowed-clients", list.substr(0, list.rfind('\n', list.size() - 2) + 1));
  CHECK(run("septet", again, rig.folder / "again.err").code == 0);
  CHECK(text_of(rig.keys / "pc-a" / "a.key") == key);
  const auto renewed = net::load_allowed_clients(rig.keys / "server" / "allowed-clients");
  REQUIRE(renewed.has_value());
  CHECK(renewed->size() == 2);
  CHECK(text_of(rig.keys / "server" / "allowed-clients") != list);

  // Another server's key is not written over.
  write_text(rig.keys / "pc-a" / "server.public", std::string(64, '7') + '\n');
  const Ended refused = run("septet", again, rig.folder / "refused.err");
  CHECK(refused.code == 1);
  CHECK(refused.error.find("another server's public key is there") != std::string::npos);
  CHECK(text_of(rig.keys / "pc-a" / "server.public") == std::string(64, '7') + '\n');
}

}  // namespace septet::pipeline
