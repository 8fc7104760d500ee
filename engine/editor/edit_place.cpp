#include "engine/editor/edit_place.hpp"

#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/regular_file.hpp"

namespace septet::editor {
namespace {

namespace fs = std::filesystem;

Expected<std::string> only_key(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".key" && entry->path().stem() != "server")
      names.push_back(entry->path().stem().string());
  if (names.size() == 1) return names.front();
  return failure(names.empty() ? "there is no key" : "there are several keys", folder.string(),
                 names.empty() ? "give the folder that `septet drive --editors` or `septet rig keys --editor` wrote"
                               : "choose one with --key NAME");
}

Expected<std::string> address_in(const fs::path& folder) {
  const auto text = read_regular_file(folder / address_file);
  if (!text)
    return failure("the server's address is not known", (folder / address_file).string(), "give --server ADDRESS:PORT");
  std::istringstream words(*text);
  std::string address;
  words >> address;
  return address;
}

}  // namespace

Expected<EditPlace> find_edit_place(const fs::path& folder, const std::string& key, const std::string& server) {
  const auto name = key.empty() ? only_key(folder) : Expected<std::string>(key);
  if (!name) return tl::unexpected(name.error());
  auto identity = net::load_identity(folder / (*name + ".key"));
  if (!identity) return tl::unexpected(identity.error());
  const auto server_key = net::load_public_key(folder / "server.public");
  if (!server_key) return tl::unexpected(server_key.error());
  const auto text = server.empty() ? address_in(folder) : Expected<std::string>(server);
  if (!text) return tl::unexpected(text.error());
  const auto address = net::parse_address(*text, server.empty() ? (folder / address_file).string() : "--server");
  if (!address) return tl::unexpected(address.error());
  return EditPlace{*address, *server_key, std::move(*identity), *name};
}

}  // namespace septet::editor
