#include "car-io/simulated_hid_device.hpp"

#include <condition_variable>
#include <mutex>
#include <utility>

namespace septet::car_io {

/// One device from plug to unplug.
struct SimulatedHidPort::Plugged {
  bool is_alive = true;
  std::deque<Bytes> waiting;
  std::deque<Bytes> written;
  std::map<std::uint8_t, Bytes> features;
  bool takes_writes = true;
  std::mutex mutex;
  std::condition_variable changed;
};

struct SimulatedHidPort::Socket {
  std::shared_ptr<Plugged> get() const {
    const std::lock_guard lock(mutex);
    return device;
  }
  std::shared_ptr<Plugged> exchange(std::shared_ptr<Plugged> other) {
    const std::lock_guard lock(mutex);
    return std::exchange(device, std::move(other));
  }

 private:
  mutable std::mutex mutex;
  std::shared_ptr<Plugged> device;
};

namespace {

constexpr std::size_t kernel_queue = 63;
constexpr std::size_t kept_reports = 4096;  // Limit on written reports; the oldest are dropped if they are not taken.
constexpr const char* where = "simulated HID device";

tl::unexpected<Error> dead() { return failure("no such device", where, "plug it in; it is opened again by itself"); }

class SimulatedHidDevice final : public HidDevice {
 public:
  explicit SimulatedHidDevice(std::shared_ptr<SimulatedHidPort::Plugged> plugged) : plugged_(std::move(plugged)) {}

  Expected<std::optional<Bytes>> read_newest() override {
    const std::lock_guard lock(plugged_->mutex);
    if (!plugged_->is_alive) return dead();
    std::optional<Bytes> newest;
    if (!plugged_->waiting.empty()) newest = std::move(plugged_->waiting.back());
    plugged_->waiting.clear();
    return newest;
  }
  Expected<void> write(std::span<const std::byte> report) override {
    std::unique_lock lock(plugged_->mutex);
    plugged_->changed.wait(lock, [&] { return plugged_->takes_writes || !plugged_->is_alive; });
    if (!plugged_->is_alive) return dead();
    if (plugged_->written.size() >= kept_reports) plugged_->written.pop_front();
    plugged_->written.emplace_back(report.begin(), report.end());
    return {};
  }
  Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) override {
    const std::lock_guard lock(plugged_->mutex);
    if (!plugged_->is_alive) return dead();
    const auto found = plugged_->features.find(id);
    if (found == plugged_->features.end())
      return failure("it has no such feature report", where, "use an id of its descriptor");
    Bytes report = found->second;
    if (report.size() > size) report.resize(size);
    return report;
  }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    const std::lock_guard lock(plugged_->mutex);
    if (!plugged_->is_alive) return dead();
    if (!report.empty()) plugged_->features[static_cast<std::uint8_t>(report[0])] = Bytes(report.begin(), report.end());
    return {};
  }

 private:
  std::shared_ptr<SimulatedHidPort::Plugged> plugged_;
};

}  // namespace

SimulatedHidPort::SimulatedHidPort() : socket_(std::make_shared<Socket>()) {}

void SimulatedHidPort::plug() {
  unplug();
  socket_->exchange(std::make_shared<Plugged>());
}

void SimulatedHidPort::unplug() {
  if (const auto device = socket_->exchange(nullptr)) {
    const std::lock_guard lock(device->mutex);
    device->is_alive = false;
    device->changed.notify_all();
  }
}

bool SimulatedHidPort::send(std::span<const std::byte> report) {
  const auto device = socket_->get();
  if (!device) return false;
  const std::lock_guard lock(device->mutex);
  if (device->waiting.size() >= kernel_queue) return false;
  device->waiting.emplace_back(report.begin(), report.end());
  return true;
}

std::vector<Bytes> SimulatedHidPort::take_written() {
  const auto device = socket_->get();
  if (!device) return {};
  const std::lock_guard lock(device->mutex);
  const auto written = std::exchange(device->written, {});
  return {written.begin(), written.end()};
}

void SimulatedHidPort::block_writes(bool block) {
  const auto device = socket_->get();
  if (!device) return;
  const std::lock_guard lock(device->mutex);
  device->takes_writes = !block;
  device->changed.notify_all();
}

std::optional<Bytes> SimulatedHidPort::feature(std::uint8_t id) const {
  const auto device = socket_->get();
  if (!device) return std::nullopt;
  const std::lock_guard lock(device->mutex);
  const auto found = device->features.find(id);
  return found == device->features.end() ? std::nullopt : std::optional(found->second);
}

Expected<std::unique_ptr<HidDevice>> SimulatedHidPort::open() const { return opener()(); }

OpenHidDevice SimulatedHidPort::opener() const {
  return [socket = socket_]() -> Expected<std::unique_ptr<HidDevice>> {
    auto device = socket->get();
    if (!device) return failure("the device is not plugged in", where, "plug it in");
    return std::make_unique<SimulatedHidDevice>(std::move(device));
  };
}

}  // namespace septet::car_io
