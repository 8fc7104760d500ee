#include "sim-server/host/rig_keys.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "engine/document/text_file.hpp"
#include "engine/editor/edit_place.hpp"
#include "engine/net/keys.hpp"
#include "sim-server/host/remote_car.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr const char* server_machine = "server";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Puts the key under this name into the list; comments and other lines stay. Returns true if it replaced another key.
bool put_client(std::string& list, const std::string& key, const std::string& name) {
  std::istringstream lines(list);
  std::string line, result;
  bool there = false, replaced = false;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    const bool is_its = !first.starts_with('#') && second == name;
    if (is_its && first != key) replaced = true;
    if (is_its && (first != key || there)) continue;
    there = there || is_its;
    result += line + '\n';
  }
  if (!there) result += key + ' ' + name + '\n';
  list = result;
  return replaced;
}

/// Gives the name's line these rights.
void put_rights(std::string& list, const std::string& name, const std::string& rights) {
  std::istringstream lines(list);
  std::string line, result;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    result +=
        !first.starts_with('#') && second == name ? fmt::format("{} {} {}\n", first, second, rights) : line + '\n';
  }
  list = result;
}

bool is_listed(const std::string& list, const std::string& name) {
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (!first.starts_with('#') && second == name) return true;
  }
  return false;
}

Expected<void> put_server_key(const fs::path& file, const std::string& key) {
  std::error_code error;
  if (!fs::exists(file, error)) return document::write_text_file(file, key + '\n');
  const auto there = net::load_public_key(file);
  if (!there) return tl::unexpected(there.error());
  if (net::to_text(*there) != key)
    return failure("another server's public key is there", file.string(),
                   "delete it if its server is no longer used, or choose another folder with --out");
  return {};
}

}  // namespace

std::vector<MachineKeys> machines_of(const rig::Rig& rig) {
  std::vector<MachineKeys> machines{{server_machine, {}}};
  const auto add = [&](const std::string& machine, const std::string& client) {
    const std::string name = machine.empty() ? server_machine : machine;
    auto found = std::ranges::find(machines, name, &MachineKeys::machine);
    if (found == machines.end()) found = machines.insert(machines.end(), {name, {}});
    found->clients.push_back(client);
  };
  for (const auto& screen : rig.screens) add(screen.machine, screen.name);
  if ((rig.car.source == rig::CarSource::hid || rig.car.source == rig::CarSource::automatic) &&
      !rig.car.machine.empty())
    add(rig.car.machine, car_client_name);
  return machines;
}

Expected<EditorKey> parse_editor_key(std::string_view text) {
  const std::size_t equals = text.find('=');
  EditorKey key{.name = std::string(text.substr(0, equals))};
  if (equals != std::string_view::npos) key.words = text.substr(equals + 1);
  constexpr std::string_view known = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  if (key.name.empty() || key.name.find_first_not_of(known) != std::string::npos || key.name == server_machine ||
      key.name == car_client_name)
    return failure(fmt::format("\"{}\" cannot be an editor's name", key.name), "--editor",
                   "use letters, digits, - and _, and neither server nor car");
  std::istringstream stream(key.words);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  const net::RightsWords read = net::read_rights(words);
  if (read.bad || !read.rights.may_look)
    return failure(fmt::format("\"{}\" are no rights", key.words), "--editor",
                   "write look, or edit and what may be edited: NAME=\"edit tree/ hide move\"");
  key.words = fmt::format("{}", fmt::join(words, " "));
  return key;
}

Expected<std::vector<std::string>> write_rig_keys(const rig::Rig& rig, const fs::path& out,
                                                  const std::vector<EditorKey>& editors) {
  std::error_code error;
  std::vector<std::string> said;
  const fs::path server = out / server_machine, list_file = server / "allowed-clients";
  const bool is_new_server = !fs::exists(server / "server.key", error);
  const auto server_identity = net::load_or_create_identity(server / "server.key");
  if (!server_identity) return tl::unexpected(server_identity.error());
  const std::string server_key = net::to_text(server_identity->public_key());
  std::string list = text_of(list_file);
  if (list.empty())
    list =
        "# Who may connect: a public key and the name that it stands for, one a line. The server follows changes at "
        "once.\n";
  std::vector<MachineKeys> machines = machines_of(rig);
  for (const EditorKey& editor : editors) {
    const bool is_taken = std::ranges::any_of(machines, [&](const MachineKeys& other) {
      return other.machine == editor.name || std::ranges::find(other.clients, editor.name) != other.clients.end();
    });
    if (is_taken)
      return failure(fmt::format("{} is the name of a machine, a screen or another editor", editor.name), "--editor",
                     "choose another name");
    machines.push_back({editor.name, {editor.name}});
  }
  for (const MachineKeys& machine : machines) {
    const fs::path folder = out / machine.machine;
    std::string fresh = machine.machine == server_machine && is_new_server ? "server" : "", kept;
    for (const auto& client : machine.clients) {
      const fs::path file = folder / (client + ".key");
      const bool existed = fs::exists(file, error);
      const bool is_carried = !existed && is_listed(list, client);
      std::string& names = existed || is_carried ? kept : fresh;
      names += (names.empty() ? "" : ", ") + client;
      if (is_carried) continue;
      const auto identity = net::load_or_create_identity(file);
      if (!identity) return tl::unexpected(identity.error());
      if (put_client(list, net::to_text(identity->public_key()), client))
        said.push_back(fmt::format("{}: another key stood for {}; it is no longer let in", list_file.string(), client));
    }
    fs::create_directories(folder, error);
    fs::permissions(folder, fs::perms::owner_all, error);
    if (auto put = put_server_key(folder / "server.public", server_key); !put) return tl::unexpected(put.error());
    said.push_back(fmt::format("{}: {}{}{}", folder.string(), fresh.empty() ? "nothing new" : "new keys of " + fresh,
                               kept.empty() ? "" : "; kept those of ", kept));
  }
  for (const EditorKey& editor : editors) {
    put_rights(list, editor.name, editor.words);
    const std::string address = fmt::format("{}:{}\n", rig.network.server_address, rig.network.scene_port);
    if (auto put = document::write_text_file(out / editor.name / editor::address_file, address); !put)
      return tl::unexpected(put.error());
  }
  // Names in the list that are no longer in the rig stay: removing a key is the operator's decision.
  if (list != text_of(list_file))
    if (auto put = document::write_text_file(list_file, list); !put) return tl::unexpected(put.error());
  return said;
}

}  // namespace septet::server
