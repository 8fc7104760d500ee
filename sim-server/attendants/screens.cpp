#include "sim-server/attendants/screens.hpp"

#include <cstdint>
#include <utility>

#include <fmt/core.h>

#include "car-io/driving_keys.hpp"
#include "engine/rig/rig.hpp"
#include "logging/session/participants.hpp"
#include "program/clock.hpp"

namespace septet::server {
namespace {

/// Interval of the kept pictures: one second; in a shorter drive, the last tick that lockstep draws.
std::uint32_t picture_every(const ServeOptions& serving, double tick_rate_hz) {
  const auto second = static_cast<std::uint64_t>(tick_rate_hz);
  const std::uint64_t ticks = serving.ticks;
  return static_cast<std::uint32_t>(ticks == 0 || ticks >= second ? second : ticks - ticks % serving.draw_every_ticks);
}

ScreenHostOptions host_options(const ServerOptions& options, const ServeOptions& serving, const OpenedDrive& drive,
                               const LaneEndpoint& endpoint) {
  const rig::Rig& rig = drive.loaded.rig;
  const double tick_rate_hz = drive.source->tick_rate_hz();
  ScreenHostOptions host{
      .identity = endpoint.identity, .session = net::random_session_id(), .allowed = endpoint.allowed};
  host.welcome = {.rig = drive.loaded.source("rig"),
                  .lockstep = serving.lockstep,
                  .tick_rate_hz = tick_rate_hz,
                  .picture_every_ticks = picture_every(serving, tick_rate_hz),
                  .thumbnails = options.page_port.has_value()};
  if (drive.eyes) {
    host.welcome.eyes = drive.eyes->number;
    host.welcome.eyes_name = logging::called(*drive.eyes);
  }
  host.max_datagram_bytes = rig.network.max_payload_bytes;
  host.limits.max_datagram_bytes = rig.network.max_payload_bytes;
  // Compiling shaders keeps a screen silent for a while, at no cost: in real time ticks do not wait for it, and
  // lockstep waits for it anyway.
  host.limits.timeout_s = serving.lockstep ? 60.0 : 5.0;
  host.least_playout_delay_s = rig.network.playout_delay_ticks / tick_rate_hz;
  for (const auto& screen : rig.screens) host.screens.push_back(screen.name);
  host.drivers = rig::driving_screens(rig);
  host.car = drive.remote_car;
  return host;
}

}  // namespace

Screens::Screens(LaneEndpoint endpoint, bool by_keyboard, program::ProgressLine& line)
    : endpoint_(std::move(endpoint)), by_keyboard_(by_keyboard), line_(line) {}

Expected<std::unique_ptr<Screens>> Screens::open(const ServerOptions& options, const ServeOptions& serving,
                                                 const OpenedDrive& drive, program::ProgressLine& line) {
  const rig::Rig& rig = drive.loaded.rig;
  auto endpoint = open_lane_endpoint(options.keys, rig, options.any_port);
  if (!endpoint) return tl::unexpected(endpoint.error());
  const bool by_keyboard = drive.by_person && rig.car.source == rig::CarSource::keyboard;
  std::unique_ptr<Screens> screens(new Screens(std::move(*endpoint), by_keyboard, line));
  LaneEndpoint& lanes = screens->endpoint_;
  ScreenHostOptions host = host_options(options, serving, drive, lanes);
  if (auto chosen = choose_transport(rig.network, lanes, options.any_port, host.welcome, line); !chosen)
    return tl::unexpected(chosen.error());
  screens->host_ = std::make_unique<ScreenHost>(lanes.scene, lanes.tick, drive.store, std::move(host));
  return screens;
}

Expected<void> Screens::begin() {
  program::announce(fmt::format("ready {}", endpoint_.scene.local_address().port));
  host_->give_notice({"", by_keyboard_});
  if (by_keyboard_) line_.message(car_io::driving_keys_text());
  return {};
}

double Screens::now_s() const { return program::monotonic_s(); }

void Screens::wait(double seconds) {
  const net::UdpSocket* waiting[] = {&endpoint_.scene};
  net::wait_readable(waiting, seconds);
}

}  // namespace septet::server
