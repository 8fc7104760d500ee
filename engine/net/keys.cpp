#include "engine/net/keys.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "engine/net/crypto.hpp"

namespace septet::net {
namespace {

constexpr std::string_view file_title = "septet identity 1";

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::optional<std::array<std::uint8_t, 32>> parse_hexadecimal(std::string_view text) {
  if (text.size() != 64) return std::nullopt;
  std::array<std::uint8_t, 32> bytes{};
  for (std::size_t i = 0; i < 64; ++i) {
    const char digit = text[i];
    int value;
    if (digit >= '0' && digit <= '9')
      value = digit - '0';
    else if (digit >= 'a' && digit <= 'f')
      value = digit - 'a' + 10;
    else if (digit >= 'A' && digit <= 'F')
      value = digit - 'A' + 10;
    else
      return std::nullopt;
    bytes[i / 2] = static_cast<std::uint8_t>(bytes[i / 2] << 4 | value);
  }
  return bytes;
}

/// Written beside the target and linked into place, so that a file is whole or absent, and two programs that start at
/// once agree.
Expected<void> create_identity(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  const Identity identity = Identity::generate();
  const std::string text = fmt::format("{}\npublic {}\nsecret {}\n", file_title, to_text(identity.public_key()),
                                       hexadecimal(std::span(identity.secret_key()).first(32)));
  const std::string draft = fmt::format("{}.{}", file.string(), ::getpid());
  const int descriptor = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  bool written = descriptor >= 0;
  if (written) {
    written = ::fchmod(descriptor, 0600) == 0 &&
              ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
              ::fsync(descriptor) == 0;
    ::close(descriptor);
    written = written && (::link(draft.c_str(), file.c_str()) == 0 || errno == EEXIST);
  }
  const int reason = errno;
  ::unlink(draft.c_str());
  if (!written)
    return failure(fmt::format("the key file cannot be written: {}", std::strerror(reason)), file.string(),
                   "free space, or name a folder that this user may write");
  return {};
}

}  // namespace

std::string to_text(const PublicKey& key) { return hexadecimal(key); }

Expected<PublicKey> parse_public_key(std::string_view text, std::string_view where) {
  const auto bytes = parse_hexadecimal(text);
  if (!bytes)
    return failure(fmt::format("\"{}\" is not a public key", text.substr(0, 80)), std::string(where),
                   "copy the 64 hexadecimal digits after `public` in the key file");
  return *bytes;
}

Expected<Identity> load_identity(const std::filesystem::path& file) {
  struct stat status {};
  std::ifstream in(file);
  if (!in || ::stat(file.c_str(), &status) != 0)
    return failure("the key file cannot be read", file.string(),
                   "check its path and owner; `septet rig keys` makes the keys of a rig's machines");
  if ((status.st_mode & 077) != 0)
    return failure("others may read the secret key", file.string(),
                   fmt::format("run `chmod 600 {}`; if it was not you who opened it, delete it and make "
                               "another one with `septet rig keys`",
                               file.string()));
  std::string title, public_word, public_text, secret_word, secret_text;
  std::getline(in, title);
  in >> public_word >> public_text >> secret_word >> secret_text;
  const auto seed = parse_hexadecimal(secret_text);
  if (title == file_title && public_word == "public" && secret_word == "secret" && seed) {
    Identity identity = Identity::from_seed(*seed);
    if (to_text(identity.public_key()) == public_text) return identity;
  }
  return failure("this is not a whole key file", file.string(),
                 "restore it from a copy, or delete it and make another one with `septet rig keys`");
}

Expected<Identity> load_or_create_identity(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    if (auto created = create_identity(file); !created) return tl::unexpected(created.error());
  return load_identity(file);
}

Expected<PublicKey> load_public_key(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text;
  if (!(stream >> text))
    return failure("the server's public key cannot be read", file.string(),
                   "copy server.public from the folder that `septet rig keys` made");
  return parse_public_key(text, file.string());
}

Expected<std::vector<AllowedClient>> load_allowed_clients(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    return failure("the list of allowed clients cannot be read", file.string(),
                   "`septet rig keys` makes it: one line `KEY NAME` per client");
  std::vector<AllowedClient> clients;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string key, name;
    if (!(words >> key) || key.starts_with('#')) continue;
    words >> name;
    const std::vector<std::string> right_words{std::istream_iterator<std::string>(words), {}};
    const std::string where = fmt::format("{}:{}", file.string(), number);
    auto parsed = parse_public_key(key, where);
    if (!parsed) return tl::unexpected(parsed.error());
    if (name.empty()) return failure("a key without a name", where, "write `KEY NAME`");
    for (const AllowedClient& other : clients) {
      if (other.key == *parsed)
        return failure(fmt::format("the key of {} stands here again", other.name), where,
                       "remove one of the two lines");
      if (other.name == name)
        return failure(fmt::format("a second key for {}", name), where,
                       "remove the line of the key that no longer counts");
    }
    RightsWords read = read_rights(right_words);
    if (read.bad)
      return failure(
          fmt::format("\"{}\" is no right", *read.bad), where,
          "write `KEY NAME` for a screen, `KEY NAME look` for a reader, `KEY NAME edit [PREFIX/…] [hide] [move] "
          "[paint] [create]` for an editor, and `operate` for who may command the drive");
    clients.push_back({*parsed, name, std::move(read.rights)});
  }
  return clients;
}

}  // namespace septet::net
