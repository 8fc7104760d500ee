#include "car-io/program/car_link.hpp"

#include <utility>

namespace septet::car_io {

using namespace control;

namespace {

constexpr double report_interval_s = 0.02;

std::string as_text(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

CarLink::CarLink(net::DatagramSocket& socket, const net::SecureClientOptions& lane, FindDevice find_device)
    : lane_(socket, lane),
      connection_report_(lane.server, lane.identity.public_key(), "car"),
      find_device_(std::move(find_device)) {}

void CarLink::pump(double now_s) {
  for (const net::ClientEvent& event : lane_.pump(now_s)) {
    switch (event.kind) {
      case net::ClientEvent::Kind::connected:
        feedback_tick_ = 0;
        lane_.send(net::share(encode_control(CarHello{})), net::Reliability::reliable);
        break;
      case net::ClientEvent::Kind::lost:
        is_welcome_ = false;
        break;
      case net::ClientEvent::Kind::message:
        on_control(event.bytes);
        break;
    }
  }
  if (auto text = connection_report_.look(lane_, is_welcome_, now_s)) messages_.push_back(std::move(*text));
  if (connection_) report(now_s);
}

void CarLink::on_control(std::span<const std::byte> bytes) {
  const auto message = decode_control(bytes);
  if (!message) return;  // Authenticated, so another version: it shows as a refusal.
  if (const auto* feedback = std::get_if<CarFeedback>(&*message)) {
    if (!writer_ || feedback->tick <= feedback_tick_) return;
    feedback_tick_ = feedback->tick;
    writer_->set({feedback->fan, feedback->vibration, feedback->vibration_hz, feedback->steering});
  } else if (const auto* welcome = std::get_if<CarWelcome>(&*message)) {
    is_welcome_ = true;
    take_rig(welcome->rig);
  } else if (const auto* refusal = std::get_if<Refusal>(&*message)) {
    refusal_ = Error{refusal->reason, "septet-car", "correct the server's rig or allowed-clients"};
  } else if (std::holds_alternative<Finish>(*message)) {
    finished_ = true;
  }
}

void CarLink::take_rig(const std::string& text) {
  const auto rig = rig::read_rig(text, "the server's rig");
  const auto layout = rig ? find_car_layout(rig->car.layout) : tl::unexpected(rig.error());
  if (!layout) {
    refusal_ = layout.error();
    return;
  }
  layout_ = *layout;
  const OpenHidDevice open = find_device_(rig->car);
  // A server that comes back finds the device as it is; at the start a missing one is an error.
  if (!connection_)
    if (const auto device = open(); !device) {
      refusal_ = device.error();
      return;
    }
  writer_.reset();
  connection_ = std::make_unique<CarConnection>(
      open, CarConnectionOptions{.layout = *layout, .calibration = rig->car.calibration});
  writer_ = std::make_unique<ActuatorWriter>(
      open, ActuatorWriterOptions{.layout = *layout,
                                  .has_steering_force = rig->car.actuators.steering_most > 0.0,
                                  .sticky = true,
                                  .rise_s = 1.0});
  was_connected_ = false;
  problem_.clear();
}

void CarLink::report(double now_s) {
  const CarReading reading = connection_->poll(now_s);
  // Immediate here; the server learns it from the report and keeps it so.
  if (reading.switches.emergency_stop) writer_->stop();
  if (const auto error = connection_->take_error()) {
    messages_.push_back(describe(*error));
    if (!reading.is_connected) problem_ = error->what;
  }
  if (const auto error = writer_->take_error()) messages_.push_back(describe(*error));
  if (reading.is_connected != std::exchange(was_connected_, reading.is_connected)) {
    reported_s_ = -1.0;  // Good news and bad news travel at once.
    newest_.clear();
    if (reading.is_connected) {
      problem_.clear();
      messages_.push_back("the device is there");
    }
  }
  if (reading.report) newest_ = *reading.report;
  if (!reading.report && now_s - reported_s_ < report_interval_s) return;
  if (lane_.state() != net::ClientState::connected) return;
  reported_s_ = now_s;
  Bytes told = newest_;
  if (now_s < rearm_until_s_) press(*layout_, CarButton::rearm, told);
  lane_.send(net::share(encode_control(CarReport{++number_, as_text(told), problem_})), net::Reliability::unreliable);
}

}  // namespace septet::car_io
