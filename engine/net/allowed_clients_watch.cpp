#include "engine/net/allowed_clients_watch.hpp"

#include <sys/stat.h>

namespace septet::net {
namespace {

constexpr double look_every_s = 0.25;

}  // namespace

AllowedClientsWatch::AllowedClientsWatch(std::filesystem::path file)
    : file_(std::move(file)), known_(look()), seen_(known_) {}

AllowedClientsWatch::Stamp AllowedClientsWatch::look() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return {};
  return {true, status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::optional<Expected<std::vector<AllowedClient>>> AllowedClientsWatch::changed(double now_s) {
  if (now_s < next_look_s_) return std::nullopt;
  next_look_s_ = now_s + look_every_s;
  const Stamp before = std::exchange(seen_, look());
  if (seen_ == known_ || seen_ != before) return std::nullopt;
  known_ = seen_;
  return load_allowed_clients(file_);
}

}  // namespace septet::net
