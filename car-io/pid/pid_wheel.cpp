#include "car-io/pid/pid_wheel.hpp"

#include <utility>

namespace septet::car_io {
namespace {

constexpr double lasts_s = 0.25;
constexpr double from_the_right = 0.25;  // Share of a turn: a force from there pushes to the left.

}  // namespace

PidWheel::~PidWheel() {
  if (device_ && is_on_) (void)control(pid::stop_all);
}

Expected<void> PidWheel::control(HidUsage what) {
  if (!reports_.control) return {};
  Bytes report = reports_.control->empty();
  if (!reports_.control->choose(report, what)) return {};
  return device_->write(report);
}

Expected<void> PidWheel::switch_on() {
  if (std::exchange(is_on_, true)) return {};
  for (const HidUsage what : {pid::reset, pid::enable_actuators})
    if (auto told = control(what); !told) return told;
  if (!reports_.gain) return {};
  Bytes report = reports_.gain->empty();
  reports_.gain->set_share(report, pid::device_gain, 1.0);
  return device_->write(report);
}

Expected<std::optional<PidWheel::Block>> PidWheel::create(HidUsage kind) {
  Bytes asked = reports_.create.empty();
  if (!reports_.create.choose(asked, kind)) return std::nullopt;
  if (auto sent = device_->send_feature(asked); !sent) return tl::unexpected(std::move(sent.error()));
  const auto answer = device_->get_feature(reports_.load.id(), reports_.load.bytes());
  if (!answer) return tl::unexpected(answer.error());
  const auto block = reports_.load.get(*answer, pid::block_index);
  if (!block || *block < 1 || !reports_.load.is_chosen(*answer, pid::load_success)) return std::nullopt;

  const PidReport& effect = reports_.effect;
  Bytes report = effect.empty();
  effect.set(report, pid::block_index, static_cast<double>(*block));
  effect.choose(report, kind);
  effect.set_seconds(report, pid::duration, lasts_s);
  effect.set_share(report, pid::gain, 1.0);
  effect.set(report, pid::direction_enable, 1.0);
  effect.set_part(report, pid::direction, from_the_right);
  if (auto sent = device_->write(report); !sent) return tl::unexpected(std::move(sent.error()));
  return std::optional(*block);
}

Expected<void> PidWheel::start(Block block) {
  Bytes report = reports_.operation.empty();
  reports_.operation.set(report, pid::block_index, static_cast<double>(block));
  reports_.operation.choose(report, pid::start);
  reports_.operation.set(report, pid::loop_count, 1.0);
  return device_->write(report);
}

Expected<bool> PidWheel::set_force(double force) {
  if (auto on = switch_on(); !on) return tl::unexpected(std::move(on.error()));
  if (!constant_ && has_room_) {
    auto made = create(pid::constant_force);
    if (!made) return tl::unexpected(std::move(made.error()));
    constant_ = *made;
    has_room_ = constant_.has_value();
  }
  if (!constant_) return false;
  Bytes report = reports_.constant.empty();
  reports_.constant.set(report, pid::block_index, static_cast<double>(*constant_));
  reports_.constant.set_share(report, pid::magnitude, force);
  if (auto sent = device_->write(report); !sent) return tl::unexpected(std::move(sent.error()));
  if (auto begun = start(*constant_); !begun) return tl::unexpected(std::move(begun.error()));
  for (const auto& block : conditions_)
    if (block)
      if (auto begun = start(*block); !begun) return tl::unexpected(std::move(begun.error()));
  return true;
}

Expected<bool> PidWheel::set_condition(PidCondition kind, double share) {
  static constexpr HidUsage usages[] = {pid::spring, pid::damper, pid::friction};
  const auto which = static_cast<std::size_t>(kind);
  std::optional<Block>& block = conditions_[which];
  if (!reports_.condition || (share <= 0.0 && !block)) return false;
  if (auto on = switch_on(); !on) return tl::unexpected(std::move(on.error()));
  if (!block) {
    auto made = create(usages[which]);
    if (!made) return tl::unexpected(std::move(made.error()));
    if (!*made) return false;
    block = *made;
  }
  const PidReport& condition = *reports_.condition;
  Bytes report = condition.empty();
  condition.set(report, pid::block_index, static_cast<double>(*block));
  condition.set(report, pid::parameter_offset, 0.0);  // Offset of the first axis, the only one of a wheel.
  condition.set(report, pid::centre_offset, 0.0);
  for (const HidUsage side : {pid::positive_coefficient, pid::negative_coefficient})
    condition.set_share(report, side, share < 0.0 ? 0.0 : share);
  for (const HidUsage side : {pid::positive_saturation, pid::negative_saturation})
    condition.set_share(report, side, 1.0);
  condition.set(report, pid::dead_band, 0.0);
  if (auto sent = device_->write(report); !sent) return tl::unexpected(std::move(sent.error()));
  return true;
}

}  // namespace septet::car_io
