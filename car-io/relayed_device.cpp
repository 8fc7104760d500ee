#include "car-io/relayed_device.hpp"

#include <optional>
#include <utility>

namespace septet::car_io {

struct RelayedDevice::Cable {
  std::string problem = "septet-car has not connected yet";
  std::optional<std::uint32_t> number;
  std::optional<Bytes> newest;

  bool is_there() const { return problem.empty(); }
  tl::unexpected<Error> away() const {
    return failure(problem, "car on another machine", "it comes back by itself; see septet-car there");
  }
};

namespace {

class Reader final : public HidDevice {
 public:
  explicit Reader(std::shared_ptr<RelayedDevice::Cable> cable) : cable_(std::move(cable)) {}

  Expected<std::optional<Bytes>> read_newest() override {
    if (!cable_->is_there()) return cable_->away();
    return std::exchange(cable_->newest, std::nullopt);
  }
  Expected<void> write(std::span<const std::byte>) override { return far_only(); }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override { return far_only(); }
  Expected<void> send_feature(std::span<const std::byte>) override { return far_only(); }

 private:
  static tl::unexpected<Error> far_only() {
    return failure("only septet-car writes to it", "car on another machine", "send it feedback");
  }
  std::shared_ptr<RelayedDevice::Cable> cable_;
};

}  // namespace

RelayedDevice::RelayedDevice() : cable_(std::make_shared<Cable>()) {}

void RelayedDevice::receive(std::uint32_t number, Bytes report, const std::string& problem) {
  // Numbers wrap; half their range counts as older.
  if (cable_->number && static_cast<std::int32_t>(number - *cable_->number) <= 0) return;
  cable_->number = number;
  cable_->problem = problem;
  cable_->newest = report.empty() ? std::nullopt : std::optional(std::move(report));
}

void RelayedDevice::lose(const std::string& why) {
  cable_->problem = why.empty() ? "the connection to septet-car was lost" : why;
  cable_->number.reset();
  cable_->newest.reset();
}

OpenHidDevice RelayedDevice::opener() const {
  return [cable = cable_]() -> Expected<std::unique_ptr<HidDevice>> {
    if (!cable->is_there()) return cable->away();
    return std::make_unique<Reader>(cable);
  };
}

}  // namespace septet::car_io
