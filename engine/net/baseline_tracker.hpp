#pragma once
/// Chooses the baseline of the next snapshot's difference: the newest tick that every live client has acknowledged.
///
/// A client is live while datagrams of it arrive. A silent one no longer holds the baseline back; one that joins or
/// returns has acknowledged nothing, so there is no baseline (a keyframe is sent) until it has. A live client that
/// acknowledges nothing for `patience_s` is left out for `penalty_s`, so that it cannot make every tick a keyframe for
/// the others.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace septet::net {

struct BaselineOptions {
  double silence_s = 0.5;
  double patience_s = 0.5;
  double penalty_s = 2.0;
  /// Ticks remembered per client; also the number that the server and the clients must keep.
  std::size_t history = 64;
};

class BaselineTracker {
 public:
  using Client = std::uint32_t;

  explicit BaselineTracker(const BaselineOptions& options = {}) : options_(options) {}

  /// Registers a new client, or a known one that has lost its baselines and asks for a keyframe.
  void join(Client client, double now_s);
  void leave(Client client);
  /// Counts any datagram of the client as a sign of life.
  void heard(Client client, double now_s);
  /// Records that the client holds this tick, decoded; the caller has checked that it was published.
  void acknowledge(Client client, std::uint64_t tick, double now_s);

  /// Call once per tick before asking `baseline`.
  void advance_to(double now_s);
  /// The newest tick that all live clients have acknowledged; empty without one, or without a live client.
  std::optional<std::uint64_t> baseline() const;
  bool is_live(Client client) const;

 private:
  struct State {
    double heard_s = 0.0;
    double waiting_since_s = 0.0;  ///< Start of the wait for the first acknowledgement.
    double barred_until_s = 0.0;
    bool live = false;
    std::vector<std::uint64_t> acknowledged;  ///< Ascending, at most `history`.
  };
  BaselineOptions options_;
  std::map<Client, State> clients_;
};

}  // namespace septet::net
