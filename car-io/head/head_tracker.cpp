#include "car-io/head/head_tracker.hpp"

#include <utility>

namespace septet::car_io {
namespace {

/// More than any tracker sends in a tick; the rest waits, or is dropped by the system.
constexpr int most_datagrams_a_tick = 128;
constexpr std::size_t waiting_bytes = 64 << 10;

}  // namespace

HeadTracker::HeadTracker(rig::HeadTracking tracking, net::UdpSocket socket)
    : tracking_(std::move(tracking)), socket_(std::move(socket)) {}

Expected<HeadTracker> HeadTracker::open(const rig::HeadTracking& tracking) {
  const auto ip = net::parse_ip(tracking.listen, "the rig's head.listen");
  if (!ip) return tl::unexpected(ip.error());
  auto socket = net::UdpSocket::open({.bind = {*ip, tracking.port}, .buffer_bytes = waiting_bytes});
  if (!socket) return tl::unexpected(socket.error());
  return HeadTracker(tracking, std::move(*socket));
}

void HeadTracker::move(DriverInput& input, double dt_s) {
  std::optional<HeadPlace> heard;
  for (int i = 0; i < most_datagrams_a_tick; ++i) {
    const auto datagram = socket_.receive();
    if (!datagram) break;
    if (const auto pose = read_tracked_pose(datagram->bytes)) heard = place_of(*pose, tracking_);
  }
  advance(motion_, heard, dt_s);
  input.head.from_rest_m = motion_.place.from_rest_m;
  if (motion_.share > 0.0) input.gaze_heading_rad = motion_.place.heading_rad;
  if (std::exchange(was_tracked_, is_tracked(motion_)) != was_tracked_)
    message_ =
        is_tracked(motion_) ? "the head tracker is heard" : "the head tracker is silent: the eyes go back to rest";
}

std::optional<std::string> HeadTracker::take_message() { return std::exchange(message_, std::nullopt); }

}  // namespace septet::car_io
