#include "car-io/car_connection.hpp"

#include <utility>

namespace septet::car_io {

CarConnection::CarConnection(OpenHidDevice open, const CarConnectionOptions& options)
    : open_(std::move(open)), options_(options) {}

CarReading CarConnection::poll(double now_s) {
  if (!device_ && (!next_try_s_ || now_s >= *next_try_s_)) {
    next_try_s_ = now_s + options_.retry_s;
    if (auto device = open_())
      device_ = std::move(*device);
    else
      report_error(std::move(device.error()));
  }
  CarReading reading;
  if (device_) read(now_s, reading);
  reading.is_connected = device_ != nullptr;
  const bool beats = options_.layout->sequence_byte.has_value() || options_.repeats;
  reading.is_stale = !reading.is_connected || !fresh_at_s_ || (beats && now_s - *fresh_at_s_ > options_.stale_after_s);
  reading.input = reading.is_stale || switches_.emergency_stop ? released(input_) : input_;
  reading.switches = {switches_.emergency_stop, switches_.rearm && !reading.is_stale};
  return reading;
}

void CarConnection::read(double now_s, CarReading& reading) {
  auto newest = device_->read_newest();
  if (!newest) {
    report_error(std::move(newest.error()));
    device_.reset();
    fresh_at_s_.reset();
    next_try_s_ = now_s + options_.retry_s;
    return;
  }
  if (!*newest) return;
  const auto input = decode_report(*options_.layout, options_.calibration, **newest);
  if (input) switches_ = read_switches(*options_.layout, **newest);
  reading.report = std::move(**newest);
  if (!input) {
    ++refused_reports_;
    report_error(input.error());
    return;
  }
  if (!fresh_at_s_ || !options_.layout->sequence_byte || input->sequence != input_.sequence) fresh_at_s_ = now_s;
  input_ = *input;
  last_reason_.clear();
}

void CarConnection::report_error(Error error) {
  if (error.what == last_reason_) return;
  last_reason_ = error.what;
  error_ = std::move(error);
}

std::optional<Error> CarConnection::take_error() { return std::exchange(error_, std::nullopt); }

}  // namespace septet::car_io
