#include "engine/net/keys.hpp"
#include "engine/net/allowed_clients_watch.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>

#include "tests/engine/net/net_fixtures.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::net {
namespace {

namespace fs = std::filesystem;

TEST_CASE("the first start makes a key file that only the owner can read and the second start reads it") {
  const TemporaryFolder folder;
  const fs::path file = folder / "keys" / "server.key";
  const auto made = load_or_create_identity(file);
  REQUIRE(made.has_value());
  struct stat status {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  const auto read = load_or_create_identity(file);
  REQUIRE(read.has_value());
  CHECK(read->public_key() == made->public_key());
  CHECK(read->secret_key() == made->secret_key());
  CHECK(std::distance(fs::directory_iterator(file.parent_path()), {}) == 1);
}

/// The kernel's flags of the memory around an address ("VmFlags"), empty if unavailable.
std::string memory_flags(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  bool is_there = false;
  for (std::string line; std::getline(maps, line);) {
    unsigned long from = 0, to = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &from, &to) == 2) is_there = from <= wanted && wanted < to;
    if (is_there && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

TEST_CASE("a secret key lies in memory that no core file takes, and so does each copy of it") {
  const Identity one = Identity::generate();
  Identity copy = one, assigned = Identity::generate();
  assigned = one;
  const Identity moved = std::move(copy);
  for (const Identity* identity : std::initializer_list<const Identity*>{&one, &assigned, &moved}) {
    CHECK(identity->secret_key() == one.secret_key());
    CHECK(memory_flags(identity->secret_key().data()).find(" dd ") != std::string::npos);
  }
  CHECK(memory_flags(&one).find(" dd ") == std::string::npos);  // Proves that the flag can be absent.
}

TEST_CASE("a key file that others can read or that is damaged is refused with a remedy") {
  const TemporaryFolder folder;
  const fs::path file = folder / "client.key";
  REQUIRE(load_or_create_identity(file).has_value());
  ::chmod(file.c_str(), 0644);
  const auto open_to_all = load_identity(file);
  REQUIRE_FALSE(open_to_all.has_value());
  CHECK(open_to_all.error().remedy.find("chmod 600") != std::string::npos);
  ::chmod(file.c_str(), 0600);
  fs::resize_file(file, 100);
  CHECK_FALSE(load_identity(file).has_value());
  CHECK_FALSE(load_identity(folder / "absent.key").has_value());
}

TEST_CASE("a folder that cannot be made gives one clear message") {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  const auto identity = load_or_create_identity(folder / "file" / "server.key");
  REQUIRE_FALSE(identity.has_value());
  CHECK(identity.error().where.find("server.key") != std::string::npos);
}

TEST_CASE("the list of allowed clients is read and its faults are named by line") {
  const TemporaryFolder folder;
  const fs::path file = folder / "clients.txt";
  const std::string key = to_text(identity_of(5).public_key());
  std::ofstream(file) << "# screens\n\n" << key << " screen/left-1\n";
  const auto clients = load_allowed_clients(file);
  REQUIRE(clients.has_value());
  REQUIRE(clients->size() == 1);
  CHECK(clients->front().key == identity_of(5).public_key());
  CHECK(clients->front().name == "screen/left-1");
  std::ofstream(file) << "\n" << key.substr(1) << " short\n";
  const auto bad = load_allowed_clients(file);
  REQUIRE_FALSE(bad.has_value());
  CHECK(bad.error().where == file.string() + ":2");
  const std::string other = to_text(identity_of(6).public_key());
  for (const std::string& again : {key + " b\n", other + " a\n"}) {
    std::ofstream(file) << key << " a\n" << again;
    const auto twice = load_allowed_clients(file);
    REQUIRE_FALSE(twice.has_value());
    CHECK(twice.error().where == file.string() + ":2");
  }
}

TEST_CASE("words behind a name are its rights and a word that is none is refused") {
  const TemporaryFolder folder;
  const fs::path file = folder / "allowed-clients";
  const std::string a = to_text(identity_of(5).public_key()), b = to_text(identity_of(6).public_key());
  const auto rights = [&](const std::string& words) {
    std::ofstream(file) << a << " left\n" << b << " lab " << words << '\n';
    auto clients = load_allowed_clients(file);
    REQUIRE(clients.has_value());
    CHECK_FALSE(clients->at(0).rights.may_look);
    return clients->at(1).rights;
  };
  CHECK_FALSE(rights("look").edit.has_value());
  CHECK(rights("look").may_look);
  CHECK_FALSE(rights("edit").may_operate);
  for (const char* words : {"operate", "look operate", "edit tree/ operate hide"}) {
    CHECK(rights(words).may_operate);
    CHECK(rights(words).may_look);
  }
  CHECK_FALSE(rights("operate").edit.has_value());
  CHECK_FALSE(rights("edit tree/ operate hide").edit->includes(EditKind::move));
  const auto all = rights("edit");
  REQUIRE(all.edit.has_value());
  CHECK(all.edit->kinds == all_edit_kinds);
  CHECK(describe(all) == "may hide, move, paint, create, solid");
  const auto some = rights("edit tree/ hide sign/a/ move");
  REQUIRE(some.edit.has_value());
  CHECK(some.edit->includes(EditKind::hide));
  CHECK_FALSE(some.edit->includes(EditKind::create));
  CHECK(some.edit->names("sign/a/1"));
  CHECK_FALSE(some.edit->names("sign/b"));
  CHECK(describe(some) == "may hide, move below tree/, sign/a/");
  for (const char* words : {"edits", "look hide", "operate hide", "operates", "edit hides", "hide"}) {
    std::ofstream(file) << a << " left\n" << b << " lab " << words << '\n';
    const auto refused = load_allowed_clients(file);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().where == file.string() + ":2");
    CHECK(refused.error().what.find("is no right") != std::string::npos);
  }
}

TEST_CASE("a list that changes is read anew when it is whole and the known one holds while it is bad") {
  const TemporaryFolder folder;
  const fs::path file = folder / "allowed-clients";
  const std::string a = to_text(identity_of(5).public_key()) + " a\n",
                    b = to_text(identity_of(6).public_key()) + " b\n";
  const auto replace = [&](const std::string& text) {
    std::ofstream(folder / "draft") << text;
    fs::rename(folder / "draft", file);
  };
  replace(a + b);
  AllowedClientsWatch watch(file);
  double now_s = 10.0;
  // Number of looks, and their result.
  const auto looks = [&](int count) {
    std::optional<Expected<std::vector<AllowedClient>>> result;
    for (int i = 0; i < count && !result; ++i) result = watch.changed(now_s += 0.25);
    return result;
  };
  CHECK_FALSE(looks(4));
  replace(a);
  CHECK_FALSE(looks(1));
  const auto shorter = looks(1);
  REQUIRE((shorter && *shorter));
  CHECK((*shorter)->size() == 1);
  CHECK_FALSE(looks(4));
  replace("what is this\n");
  const auto bad = looks(2);
  REQUIRE(bad);
  CHECK_FALSE(bad->has_value());
  CHECK_FALSE(looks(4));
  fs::remove(file);
  const auto gone = looks(2);
  REQUIRE(gone);
  CHECK_FALSE(gone->has_value());
  replace(a + b);
  const auto longer = looks(2);
  REQUIRE((longer && *longer));
  CHECK((*longer)->size() == 2);
}

}  // namespace
}  // namespace septet::net
