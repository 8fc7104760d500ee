#include "engine/core/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace septet {
namespace {

constexpr std::size_t chunk_bytes = 1u << 16;

struct OpenFile {
  int descriptor = -1;
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

std::string_view kind_of(::mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string size_text(std::size_t bytes) {
  return bytes < (1u << 20) ? fmt::format("{} KiB", bytes >> 10) : fmt::format("{} MiB", bytes >> 20);
}

tl::unexpected<Error> unreadable(const std::filesystem::path& file, int error) {
  return failure(std::generic_category().message(error), file.string(), "check that the file exists and can be read");
}

}  // namespace

Expected<std::string> read_regular_file(const std::filesystem::path& file, std::size_t largest_bytes) {
  // O_NONBLOCK: opening a pipe without a writer would block for ever.
  const OpenFile opened{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  // A socket cannot be opened at all.
  if (opened.descriptor < 0 && errno != ENXIO) return unreadable(file, errno);
  struct stat status {};
  if ((opened.descriptor < 0 ? ::stat(file.c_str(), &status) : ::fstat(opened.descriptor, &status)) != 0)
    return unreadable(file, errno);
  if (!S_ISREG(status.st_mode))
    return failure(fmt::format("it is {}, not a file", kind_of(status.st_mode)), file.string(), "give a file");
  const auto too_long = [&] {
    return failure(fmt::format("the file is longer than {}", size_text(largest_bytes)), file.string(),
                   "give a shorter file");
  };
  if (static_cast<std::size_t>(status.st_size) > largest_bytes) return too_long();
  // A file may grow while it is read, and those below /proc report length 0: the bytes read decide.
  std::string text(std::max(static_cast<std::size_t>(status.st_size) + 1, chunk_bytes), '\0');
  std::size_t length = 0;
  for (;;) {
    if (length == text.size()) text.resize(2 * length);
    const auto count = ::read(opened.descriptor, text.data() + length, text.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unreadable(file, errno);
    if (count == 0) break;
    length += static_cast<std::size_t>(count);
    if (length > largest_bytes) return too_long();
  }
  text.resize(length);
  return text;
}

}  // namespace septet
