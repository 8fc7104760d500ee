#pragma once
/// Updates of the list of allowed clients during a drive: a client whose key is removed from the file is disconnected
/// at once.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/net/allowed_clients_watch.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class AllowedList final : public Attendant {
 public:
  /// `host` outlives it.
  AllowedList(std::filesystem::path file, ScreenHost& host) : watch_(std::move(file)), host_(host) {}

  void before_tick(const Moment& moment) override;
  std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }

 private:
  net::AllowedClientsWatch watch_;
  ScreenHost& host_;
  std::vector<std::string> messages_;
};

}  // namespace septet::server
