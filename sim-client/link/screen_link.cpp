#include "sim-client/link/screen_link.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::screen {

using namespace control;

ScreenLink::ScreenLink(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, OpenGroup open_group,
                       ScreenLinkOptions options)
    : options_(std::move(options)),
      tick_socket_(tick_socket),
      open_group_(std::move(open_group)),
      lane_(lane_socket, options_.lane),
      ticks_(options_.lane.server_key),
      connection_(options_.lane.server, options_.lane.identity.public_key(), options_.screen) {}

void ScreenLink::pump(double now_s) {
  for (net::ClientEvent& event : lane_.pump(now_s)) {
    switch (event.kind) {
      case net::ClientEvent::Kind::connected:
        on_connected();
        break;
      case net::ClientEvent::Kind::lost:
        scene_.disconnected();
        scene_arrived_ = is_welcome_ = false;
        events_.lose();
        break;
      case net::ClientEvent::Kind::message:
        switch (lane_of(event.bytes).value_or(LaneMessage::control)) {
          case LaneMessage::scene:
            if (auto received = scene_.receive(std::span(event.bytes).subspan(1)); !received)
              refusal_ = received.error();
            break;
          case LaneMessage::control:
            on_control(event.bytes, now_s);
            break;
        }
    }
  }
  if (auto text = connection_.look(lane_, is_welcome_, now_s)) messages_.push_back(std::move(*text));
  const double listened_s = pumped_s_ ? std::min(now_s - *pumped_s_, longest_step_s) : 0.0;
  pumped_s_ = now_s;
  const bool heard = state() == net::ClientState::connected && lane_.silence_s() <= 0.0;
  unheard_s_ = heard ? 0.0 : unheard_s_ + listened_s;
  pump_scene();
  receive_ticks(now_s);
  tell_of_forgeries(now_s);
}

/// Reports forged packets: a sender on the network imitates the server, or floods the tick lane.
void ScreenLink::tell_of_forgeries(double now_s) {
  constexpr double every_s = 10.0;
  if (now_s - told_s_ < every_s) return;
  told_s_ = now_s;
  const auto& counters = ticks_.counters();
  const std::uint64_t forged = counters.forged + counters.malformed;
  if (const std::uint64_t fresh = forged - std::exchange(told_forged_, forged); fresh > 0)
    messages_.push_back(
        fmt::format("datagrams on the tick lane that are not the server's: {} in {:.0f} s", fresh, every_s));
}

void ScreenLink::on_connected() {
  // After reconnecting to the same server its ticks still hold, and a tick repeated while the world waits is not new.
  if (ticks_.follow(lane_.session())) history_.clear();
  scene_.connected();
  scene_arrived_ = false;
  send(Hello{options_.screen, options_.tick_port}, net::Reliability::reliable);
}

void ScreenLink::on_control(std::span<const std::byte> bytes, double now_s) {
  auto message = decode_control(bytes);
  if (!message) return;  // Authenticated, so another version: the server's refusal says so.
  if (auto* welcome = std::get_if<Welcome>(&*message)) {
    group_socket_.reset();
    if (welcome->group_ip != 0) {
      auto socket = open_group_({welcome->group_ip, welcome->group_port}, welcome->interface_ip);
      if (socket)
        group_socket_ = std::move(*socket);
      else
        refusal_ = socket.error();
    }
    refused_.clear();
    is_welcome_ = true;
    welcome_ = std::move(*welcome);
    ++welcomes_;
    if (hears_events_) send(HearEvents{}, net::Reliability::reliable);
  } else if (auto* refusal = std::get_if<Refusal>(&*message)) {
    // The server may be started again with another rig or list: the request is repeated, though not all the time.
    if (std::exchange(refused_, refusal->reason) != refusal->reason)
      messages_.push_back(
          fmt::format("refused by the server: {}; it is asked again by itself", printable(refusal->reason)));
    lane_.leave_for(refused_for_s);
    scene_.disconnected();
    scene_arrived_ = is_welcome_ = false;
  } else if (auto* notice = std::get_if<Notice>(&*message)) {
    notice_ = std::move(*notice);
  } else if (const auto* look = std::get_if<Look>(&*message)) {
    looked_at_until_s_ = look->closely ? now_s + looked_at_for_s : -1e9;
  } else if (auto* answer = std::get_if<OperatorAnswer>(&*message)) {
    operator_answers_.push_back(std::move(*answer));
  } else if (const auto* from = std::get_if<EventsFrom>(&*message)) {
    events_.begin(from->count);
  } else if (auto* event = std::get_if<DriveEvent>(&*message)) {
    events_.take(std::move(*event));
  } else if (std::holds_alternative<Finish>(*message)) {
    finished_ = true;
  }
}

void ScreenLink::hear_events() {
  if (std::exchange(hears_events_, true) || !is_welcome_) return;
  send(HearEvents{}, net::Reliability::reliable);
}

void ScreenLink::show_scene(Tick tick) {
  if (auto shown = scene_.show(tick); !shown) refusal_ = shown.error();
}

void ScreenLink::pump_scene() {
  if (lane_.state() != net::ClientState::connected) return;
  scene_.pump([&](std::span<const std::byte> message) {
    return lane_.send(control::scene_message(message), net::Reliability::reliable) == net::SendResult::queued;
  });
  if (scene_.complete() && !scene_arrived_) {
    scene_arrived_ = true;
    send(SceneArrived{scene_.complete_revision()}, net::Reliability::reliable);
  }
}

void ScreenLink::receive_ticks(double now_s) {
  ticks_.receive_from(tick_socket_);
  if (group_socket_) ticks_.receive_from(*group_socket_);
  while (auto tick = ticks_.next()) {
    TickArrived answer{tick->tick, 0.0f, false};
    switch (history_.add(tick->payload)) {
      case frame::TickHistory::Outcome::stored:
        if (const auto* held = history_.find(tick->tick))
          if (const auto server_s = server_time_s(now_s))
            answer.lateness_s = static_cast<float>(*server_s - held->header.published_s);
        break;
      case frame::TickHistory::Outcome::lost_baseline:
        answer.lost_baseline = true;
        [[fallthrough]];
      case frame::TickHistory::Outcome::refused:
        ++refused_ticks_;
        break;
    }
    if (answer.lost_baseline || history_.find(tick->tick)) send(answer, net::Reliability::unreliable);
  }
}

std::optional<double> ScreenLink::server_time_s(double now_s) const {
  if (!lane_.clock().valid()) return std::nullopt;
  return lane_.clock().server_time_s(now_s);
}

void ScreenLink::send(const ControlMessage& message, net::Reliability reliability) {
  lane_.send(net::share(encode_control(message)), reliability);
}

void ScreenLink::report(ScreenReport report) {
  const auto& counters = ticks_.counters();
  // In lockstep, where a tick is repeated until it has come, a gap is what was not sent to this end.
  report.datagrams_lost = welcome_ && welcome_->lockstep ? 0 : counters.lost;
  report.datagrams_repaired = counters.repaired;
  report.refused_ticks = refused_ticks_;
  send(report, net::Reliability::reliable);
}

}  // namespace septet::screen
