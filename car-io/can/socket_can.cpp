#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "car-io/can/can_bus.hpp"

namespace septet::car_io {
namespace {

class SocketCan final : public CanBus {
 public:
  SocketCan(int socket, std::string name) : socket_(socket), name_(std::move(name)) {}
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;
  ~SocketCan() override { close(socket_); }

  Expected<bool> send(const CanFrame& frame) override {
    canfd_frame raw{};
    raw.can_id = frame.id | (frame.is_extended ? CAN_EFF_FLAG : 0u);
    raw.len = frame.bytes;
    std::memcpy(raw.data, frame.data.data(), frame.bytes);
    // Both structures begin alike; the size tells them apart.
    const std::size_t size = frame.is_fd ? CANFD_MTU : CAN_MTU;
    if (::send(socket_, &raw, size, MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(size)) return true;
    if (errno == ENOBUFS || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return false;
    return lost("sending", errno);
  }

  Expected<std::optional<CanFrame>> receive() override {
    for (int i = 0; i < most_at_once; ++i) {
      canfd_frame raw{};
      const ssize_t size = recv(socket_, &raw, sizeof raw, MSG_DONTWAIT);
      if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) break;
      if (size < 0) return lost("reading", errno);
      const bool is_fd = size == static_cast<ssize_t>(CANFD_MTU);
      if (!is_fd && size != static_cast<ssize_t>(CAN_MTU)) continue;
      if ((raw.can_id & CAN_ERR_FLAG) != 0) {
        note(raw.can_id);
        continue;
      }
      if ((raw.can_id & CAN_RTR_FLAG) != 0 || raw.len > (is_fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) continue;
      CanFrame frame;
      frame.is_extended = (raw.can_id & CAN_EFF_FLAG) != 0;
      frame.id = raw.can_id & (frame.is_extended ? CAN_EFF_MASK : CAN_SFF_MASK);
      frame.is_fd = is_fd;
      frame.bytes = raw.len;
      std::memcpy(frame.data.data(), raw.data, raw.len);
      return frame;
    }
    return std::nullopt;
  }

  std::optional<CanNotice> take_notice() override { return std::exchange(notice_, std::nullopt); }

 private:
  static constexpr int most_at_once = 256;

  tl::unexpected<Error> lost(const char* doing, int reason) const {
    const bool is_down = reason == ENETDOWN;
    return failure(fmt::format("{} failed: {}", doing, std::strerror(reason)), "CAN interface " + name_,
                   is_down ? fmt::format("sudo ip link set {} up; it is opened again by itself", name_)
                           : "check the adapter; it is opened again by itself");
  }
  void note(std::uint32_t id) {
    if ((id & CAN_ERR_BUSOFF) != 0)
      notice_ = CanNotice{
          Error{"the controller is off the bus after too many errors", "CAN interface " + name_,
                fmt::format("check bit rate, wiring and both 120 ohm resistors; `ip link set {} type can restart-ms "
                            "100` lets it come back by itself",
                            name_)},
          true};
    else if ((id & CAN_ERR_RESTARTED) != 0)
      notice_ =
          CanNotice{Error{"the controller is on the bus again", "CAN interface " + name_, "nothing to do"}, false};
  }

  int socket_;
  std::string name_;
  std::optional<CanNotice> notice_;
};

tl::unexpected<Error> refused(const std::string& interface, const std::string& what, std::string remedy) {
  return failure(what, "CAN interface " + interface, std::move(remedy));
}

}  // namespace

std::unique_ptr<CanBus> can_bus_of_socket(int socket, std::string name) {
  return std::make_unique<SocketCan>(socket, std::move(name));
}

Expected<std::unique_ptr<CanBus>> open_socket_can(const std::string& interface, bool needs_fd) {
  const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (socket < 0)
    return refused(interface, fmt::format("this machine has no SocketCAN: {}", std::strerror(errno)),
                   "sudo modprobe can can-raw; or leave [can] out of the rig");
  auto bus = can_bus_of_socket(socket, interface);
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  if (ioctl(socket, SIOCGIFINDEX, &request) != 0)
    return refused(interface, "there is no such interface",
                   "check the adapter and `ip link`; the rig's [can] interface names it");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  if (ioctl(socket, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0)
    return refused(
        interface, "the interface is down",
        fmt::format("sudo ip link set {0} type can bitrate 500000 restart-ms 100; sudo ip link set {0} up", interface));
  const int on = 1;
  if (needs_fd && (ioctl(socket, SIOCGIFMTU, &request) != 0 || request.ifr_mtu < static_cast<int>(CANFD_MTU) ||
                   setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0))
    return refused(interface, "the DBC file has CAN FD messages, and the interface carries none",
                   fmt::format("sudo ip link set {} mtu 72 (a virtual one), or type can … fd on", interface));
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;
  setsockopt(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  if (bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return refused(interface, fmt::format("it cannot be opened: {}", std::strerror(errno)),
                   "check that it is a CAN interface");
  return bus;
}

}  // namespace septet::car_io
