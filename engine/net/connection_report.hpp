#pragma once
/// Messages for a client's operator about its connection: when it is established, when it is lost, and the obstacle,
/// once and then every half minute while it lasts.

#include <optional>
#include <string>

#include "engine/net/secure_client.hpp"

namespace septet::net {

class ConnectionReport {
 public:
  /// `who` is the client's name in the server's list: "ahead-2", "car".
  ConnectionReport(Address server, PublicKey own_key, std::string who);

  /// New message after a pump of the client, if any. `welcome`: the server has accepted the client's role.
  std::optional<std::string> look(const SecureClient& client, bool welcome, double now_s);

 private:
  std::string text_of(Obstacle obstacle) const;

  Address server_;
  PublicKey own_key_;
  std::string who_;
  bool connected_ = false;
  Obstacle said_ = Obstacle::none;
  double said_s_ = 0.0;
};

}  // namespace septet::net
