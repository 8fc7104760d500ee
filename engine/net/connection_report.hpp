#pragma once
/// What a client's operator is told of its connection: when it stands, when it is lost, and what keeps it from the server, once and every
/// half minute while it does.

#include <optional>
#include <string>

#include "engine/net/secure_client.hpp"

namespace septet::net {

class ConnectionReport {
 public:
  /// `who` as the server's list calls it: "ahead-2", "car".
  ConnectionReport(Address server, PublicKey own_key, std::string who);

  /// What is new, after each pump of the client. `welcome`: the server has taken it for what it says to be.
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
