#pragma once
/// A server whose list has editors beside its screens, and editors of the test's own.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/editor/editor_client.hpp"
#include "tests/pipeline/observer.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

/// Adds a key with the right to edit to the list; its folder, as `septet edit --keys` takes one, is KEYS-NAME.
inline fs::path add_editor(const fs::path& keys, const std::string& name) {
  const fs::path folder = keys.string() + "-" + name;
  fs::create_directories(folder);
  const auto identity = net::load_or_create_identity(folder / (name + ".key"));
  REQUIRE(identity.has_value());
  std::ofstream(keys / "allowed-clients", std::ios::app)
      << net::to_text(identity->public_key()) << ' ' << name << " edit\n";
  fs::copy_file(keys / "server.public", folder / "server.public");
  return folder;
}

/// Tells the editor's folder where its server is.
inline void tell_port(const fs::path& folder, const std::string& port) {
  write_text(folder / editor::address_file, "127.0.0.1:" + port + "\n");
}

inline std::unique_ptr<editor::EditorClient> connect_editor(const fs::path& folder) {
  auto connected = editor::EditorClient::connect(folder, Observer::now_s, 600.0);
  if (!connected) FAIL(describe(connected.error()));
  return std::move(*connected);
}

/// A drive with two editors in its list.
struct EditedDrive {
  const TemporaryFolder folder;
  fs::path keys = make_keys(folder / "keys", "a"), lab = add_editor(keys, "lab"), desk = add_editor(keys, "desk");
  std::optional<program::ChildProcess> server;
  std::string port;

  EditedDrive() {
    write_text(folder / "small.toml", small_rig(1, "transport = \"unicast\""));
    server.emplace(start("septet-server",
                         {"--rig", (folder / "small.toml").string(), "--keys", keys.string(), "--out",
                          (folder / "out").string(), "--wait-for-screens", "0", "--any-port"},
                         folder / "server.err"));
    port = ready_port(*server, folder / "server.err");
    tell_port(lab, port), tell_port(desk, port);
  }
};

}  // namespace septet::pipeline
