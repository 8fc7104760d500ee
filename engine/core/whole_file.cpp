#include "engine/core/whole_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fmt/core.h>

namespace septet {
namespace fs = std::filesystem;
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Writes to `place`; a failure names `path`.
Expected<void> write_bytes(const fs::path& place, const fs::path& path, std::string_view what,
                           std::span<const std::byte> bytes) {
  const auto failed = [&](const char* doing) {
    const int reason = errno;
    return failure(
        fmt::format("cannot {} the {}: {}", doing, what, std::strerror(reason)), path.string(),
        reason == ENOSPC ? "free some space on the disk" : "check that the folder exists and can be written");
  };
  std::unique_ptr<std::FILE, FileCloser> file(std::fopen(place.c_str(), "wb"));
  if (!file) return failed("create");
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
  if (!written) return failed("write");
  // A full disk or a network file system may report its last error only here.
  if (std::fclose(file.release()) != 0) return failed("write");
  return {};
}

}  // namespace

Expected<void> write_whole_file(const fs::path& path, const std::function<Expected<void>(const fs::path& part)>& fill) {
  fs::path part = path;
  part += ".part";
  std::error_code error, ignored;
  auto written = fill(part);
  if (written) {
    fs::rename(part, path, error);
    if (!error) return {};
    written = failure(error.message(), path.string(), "check the folder and its permissions");
  }
  fs::remove(part, ignored);
  return written;
}

Expected<void> write_whole_file(const fs::path& path, std::string_view what, std::span<const std::byte> bytes) {
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) return write_bytes(path, path, what, bytes);
  return write_whole_file(path, [&](const fs::path& part) { return write_bytes(part, path, what, bytes); });
}

}  // namespace septet
