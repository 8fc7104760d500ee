#include "engine/net/connection_report.hpp"

#include <fmt/format.h>

namespace septet::net {
namespace {

constexpr double again_s = 30.0;

}  // namespace

ConnectionReport::ConnectionReport(Address server, PublicKey own_key, std::string who)
    : server_(server), own_key_(own_key), who_(std::move(who)) {}

std::optional<std::string> ConnectionReport::look(const SecureClient& client, bool welcome, double now_s) {
  const bool connected = welcome && client.state() == ClientState::connected;
  if (connected != connected_) {
    connected_ = connected;
    said_ = Obstacle::none;
    return connected
               ? fmt::format("connected to the server at {}", to_text(server_))
               : fmt::format("the connection to the server is lost ({}); it is tried again by itself", client.loss());
  }
  const Obstacle obstacle = client.obstacle();
  if (obstacle == Obstacle::none || (obstacle == said_ && now_s - said_s_ < again_s)) return std::nullopt;
  said_ = obstacle;
  said_s_ = now_s;
  return text_of(obstacle) + "; it is tried again by itself";
}

std::string ConnectionReport::text_of(Obstacle obstacle) const {
  const std::string server = to_text(server_);
  switch (obstacle) {
    case Obstacle::none:
      break;
    case Obstacle::no_answer:
      return fmt::format(
          "no answer from {}: is septet-server running there, and does its firewall let UDP port {} through?", server,
          server_.port);
    case Obstacle::other_server_key:
      return fmt::format(
          "the server at {} is another one than server.public says: copy that file from the server's keys", server);
    case Obstacle::other_version:
      return fmt::format("the program at {} speaks another version of Septet: run the same one on all machines",
                         server);
    case Obstacle::key_unknown:
      return fmt::format(
          "refused by the server at {}: this key is not on its list; allowed-clients there needs the line: {} {}",
          server, to_text(own_key_), who_);
    case Obstacle::key_in_use:
      return fmt::format(
          "refused by the server at {}: another client with this key is connected; stop it, or give each a key of its "
          "own",
          server);
  }
  return {};
}

}  // namespace septet::net
