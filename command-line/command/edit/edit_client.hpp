#pragma once
/// A client of a running drive that edits: its connection, its mirror of the scene, and the ticks. One thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/editor/edit_place.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/scene/command.hpp"
#include "sim-client/link/screen_link.hpp"

namespace septet::server {

/// What became of a batch.
struct EditAnswer {
  std::uint64_t batch = 0;
  std::uint64_t tick = 0;  ///< The first that shows it, where it was done.
  std::optional<replication::Refused> refused{};
};

class EditClient {
 public:
  static Expected<std::unique_ptr<EditClient>> open(const editor::EditPlace& place);

  /// Receives and sends.
  void pump();
  /// Waits until something has come, or so long.
  void wait(double seconds) const;
  void close() { link_.close(); }

  /// True once the whole scene is here and the server has welcomed it.
  bool is_ready() const { return link_.welcome() && link_.scene_arrived() && own_ids() != 0; }
  /// True if the mirror holds all that was announced.
  bool is_complete() const { return link_.replication().complete(); }
  const screen::ScreenLink& link() const { return link_; }
  const scene::Store& store() const { return link_.scene(); }
  scene::NodeId own_ids() const { return link_.replication().own_ids(); }

  Expected<std::uint64_t> request(std::span<const scene::Command> batch, std::uint64_t tick) {
    return link_.replication().request_batch(batch, tick);
  }
  /// A line of an operator's; its answer has the number.
  void operate(std::uint32_t number, const std::string& line) {
    link_.send(control::OperatorLine{number, line}, net::Reliability::reliable);
  }
  std::vector<control::OperatorAnswer> take_operator_answers() { return link_.take_operator_answers(); }
  void hear_events() { link_.hear_events(); }
  screen::HeardEvents& events() { return link_.events(); }
  std::vector<EditAnswer> take_answers();
  std::vector<std::string> take_messages() { return link_.take_messages(); }

 private:
  EditClient(const editor::EditPlace& place, net::UdpSocket lane, net::UdpSocket tick);

  net::UdpSocket lane_, tick_;
  screen::ScreenLink link_;
};

}  // namespace septet::server
