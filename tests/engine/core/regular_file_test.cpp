#include "engine/core/regular_file.hpp"

#include <fstream>

#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/temporary_folder.hpp"

namespace septet {
namespace {

std::string refusal(const std::filesystem::path& file, std::size_t largest_bytes = largest_text_bytes) {
  const auto text = read_regular_file(file, largest_bytes);
  REQUIRE(!text);
  CHECK(text.error().where == file.string());
  CHECK(!text.error().remedy.empty());
  return text.error().what;
}

TEST_CASE("a file is read whole, byte for byte, however long") {
  const TemporaryFolder folder;
  for (const std::size_t length : {0u, 1u, 65535u, 65536u, 65537u, 300000u}) {
    std::string bytes(length, '\0');
    for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<char>(i * 31);
    std::ofstream(folder / "file", std::ios::binary) << bytes;
    const auto text = read_regular_file(folder / "file");
    REQUIRE(text);
    CHECK(*text == bytes);
  }
  std::filesystem::create_symlink(folder / "file", folder / "link");
  CHECK(read_regular_file(folder / "link")->size() == 300000);
  CHECK(!read_regular_file("/proc/self/status")->empty());
}

TEST_CASE("a file that is too long is refused with the limit") {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << std::string(2048, 'a');
  CHECK(read_regular_file(folder / "file", 2048)->size() == 2048);
  CHECK(refusal(folder / "file", 2047) == "the file is longer than 1 KiB");
  std::filesystem::resize_file(folder / "file", std::uintmax_t{1} << 40);
  CHECK(refusal(folder / "file") == "the file is longer than 512 MiB");
  // It calls itself empty and is not.
  CHECK(refusal("/proc/self/status", 10) == "the file is longer than 0 KiB");
}

TEST_CASE("what is no file is refused by what it is, without waiting for it") {
  const TemporaryFolder folder;
  CHECK(refusal(folder.path()) == "it is a folder, not a file");
  CHECK(refusal("/dev/zero") == "it is a device, not a file");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(refusal(folder / "pipe") == "it is a pipe, not a file");
  const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ::sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder / "socket").string();
  REQUIRE(name.size() < sizeof address.sun_path);
  name.copy(address.sun_path, name.size());
  REQUIRE(::bind(listener, reinterpret_cast<const ::sockaddr*>(&address), sizeof address) == 0);
  CHECK(refusal(folder / "socket") == "it is a socket, not a file");
  ::close(listener);
  CHECK(refusal(folder / "nothing") == "No such file or directory");
}

}  // namespace
}  // namespace septet
