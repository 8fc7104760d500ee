#include "car-io/simulated_hid_device.hpp"

#include <utility>

namespace septet::car_io {

/// One device from plug to unplug.
struct SimulatedHidPort::Plugged {
  bool is_alive = true;
  std::deque<Bytes> waiting;
  std::vector<Bytes> written;
  std::map<std::uint8_t, Bytes> features;
};

struct SimulatedHidPort::Socket {
  std::shared_ptr<Plugged> device;
};

namespace {

constexpr std::size_t kernel_queue = 63;
constexpr const char* where = "simulated HID device";

tl::unexpected<Error> dead() {
  return failure("no such device", where, "plug it in; it is opened again by itself");
}

class SimulatedHidDevice final : public HidDevice {
 public:
  explicit SimulatedHidDevice(std::shared_ptr<SimulatedHidPort::Plugged> plugged)
      : plugged_(std::move(plugged)) {}

  Expected<std::optional<Bytes>> read_newest() override {
    if (!plugged_->is_alive) return dead();
    std::optional<Bytes> newest;
    if (!plugged_->waiting.empty()) newest = std::move(plugged_->waiting.back());
    plugged_->waiting.clear();
    return newest;
  }
  Expected<void> write(std::span<const std::byte> report) override {
    if (!plugged_->is_alive) return dead();
    plugged_->written.emplace_back(report.begin(), report.end());
    return {};
  }
  Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) override {
    if (!plugged_->is_alive) return dead();
    const auto found = plugged_->features.find(id);
    if (found == plugged_->features.end())
      return failure("it has no such feature report", where, "use an id of its descriptor");
    Bytes report = found->second;
    if (report.size() > size) report.resize(size);
    return report;
  }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    if (!plugged_->is_alive) return dead();
    if (!report.empty())
      plugged_->features[static_cast<std::uint8_t>(report[0])] =
          Bytes(report.begin(), report.end());
    return {};
  }

 private:
  std::shared_ptr<SimulatedHidPort::Plugged> plugged_;
};

}  // namespace

SimulatedHidPort::SimulatedHidPort() : socket_(std::make_shared<Socket>()) {}

void SimulatedHidPort::plug() {
  unplug();
  socket_->device = std::make_shared<Plugged>();
}

void SimulatedHidPort::unplug() {
  if (socket_->device) socket_->device->is_alive = false;
  socket_->device.reset();
}

bool SimulatedHidPort::send(std::span<const std::byte> report) {
  if (!socket_->device || socket_->device->waiting.size() >= kernel_queue) return false;
  socket_->device->waiting.emplace_back(report.begin(), report.end());
  return true;
}

std::vector<Bytes> SimulatedHidPort::take_written() {
  return socket_->device ? std::exchange(socket_->device->written, {}) : std::vector<Bytes>();
}

void SimulatedHidPort::set_feature(std::uint8_t id, Bytes report) {
  if (socket_->device) socket_->device->features[id] = std::move(report);
}

std::optional<Bytes> SimulatedHidPort::feature(std::uint8_t id) const {
  if (!socket_->device) return std::nullopt;
  const auto found = socket_->device->features.find(id);
  return found == socket_->device->features.end() ? std::nullopt : std::optional(found->second);
}

Expected<std::unique_ptr<HidDevice>> SimulatedHidPort::open() const { return opener()(); }

OpenHidDevice SimulatedHidPort::opener() const {
  return [socket = socket_]() -> Expected<std::unique_ptr<HidDevice>> {
    if (!socket->device) return failure("the device is not plugged in", where, "plug it in");
    return std::make_unique<SimulatedHidDevice>(socket->device);
  };
}

}  // namespace septet::car_io
