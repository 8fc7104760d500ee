#pragma once
/// Which tick may the next snapshot be a difference to? The newest one that every live client has
/// acknowledged.
///
/// A client is live while it is heard. One that falls silent no longer holds the baseline back; one
/// that joins or returns has acknowledged nothing, so the answer is "none" (a keyframe) until it
/// has. One that is heard but acknowledges nothing for `patience_s` is left out for `penalty_s`, so
/// that it cannot make every tick a keyframe for the others.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace septet::net {

struct BaselineOptions {
  double silence_s = 0.5;
  double patience_s = 0.5;
  double penalty_s = 2.0;
  std::size_t history = 64;  ///< Ticks remembered per client; also how many the server and the clients must keep.
};

class BaselineTracker {
 public:
  using Client = std::uint32_t;

  explicit BaselineTracker(const BaselineOptions& options = {}) : options_(options) {}

  /// A new client, or a known one that has lost its baselines and asks for a keyframe.
  void join(Client client, double now_s);
  void leave(Client client);
  /// Any sign of life.
  void heard(Client client, double now_s);
  /// The client says that it holds this tick, decoded; the caller has checked that it was
  /// published.
  void acknowledge(Client client, std::uint64_t tick, double now_s);

  /// Call once per tick before asking `baseline`.
  void advance_to(double now_s);
  /// The newest tick that all live clients acknowledged; none without one, or without a live
  /// client.
  std::optional<std::uint64_t> baseline() const;
  bool is_live(Client client) const;
  std::size_t live_count() const;

 private:
  struct State {
    double heard_s = 0.0;
    double waiting_since_s = 0.0;  ///< For the first acknowledgement.
    double barred_until_s = 0.0;
    bool live = false;
    std::vector<std::uint64_t> acknowledged;  ///< Ascending, at most `history`.
  };
  BaselineOptions options_;
  std::map<Client, State> clients_;
};

}  // namespace septet::net
