#include "car-io/pid/pid_reports.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace septet::car_io {
namespace {

constexpr HidUsage page_of(HidUsage usage) { return usage & 0xFFFF0000u; }

}  // namespace

std::optional<PidReport> PidReport::of(const HidReportFields& device, HidReportKind kind, HidUsage collection) {
  PidReport report;
  for (const HidField& field : device.fields) {
    if (field.kind != kind || field.report_id == 0 || std::ranges::count(field.collections, collection) == 0) continue;
    if (report.id_ == 0) report.id_ = field.report_id;
    if (report.id_ != field.report_id) continue;
    // The first of several choices from one list is enough.
    for (std::uint32_t i = 0; i < (field.is_array ? 1 : field.count); ++i) {
      Value value{.first_bit = field.first_bit + i * field.bits,
                  .bits = field.bits,
                  .least = field.least,
                  .most = field.most,
                  .unit_exponent = field.unit_exponent};
      const HidUsage named = field.usages.empty() ? 0 : field.usages[std::min<std::size_t>(i, field.usages.size() - 1)];
      // Lists, and merely numbered values (the axes of a direction), are identified by their collection.
      value.usage = field.is_array || page_of(named) != pid::page ? field.collections.back() : named;
      if (field.is_array) value.options = field.usages;
      report.values_.push_back(std::move(value));
    }
  }
  if (report.id_ == 0) return std::nullopt;
  report.bytes_ = device.bytes_of(kind, report.id_);
  return report;
}

const PidReport::Value* PidReport::find(HidUsage usage) const {
  const auto found = std::ranges::find(values_, usage, &Value::usage);
  return found == values_.end() ? nullptr : &*found;
}

Bytes PidReport::empty() const {
  Bytes report(bytes_);
  report[0] = static_cast<std::byte>(id_);
  return report;
}

void PidReport::put(Bytes& report, const Value& value, double number) const {
  const double low = std::min(value.least, value.most), high = std::max(value.least, value.most);
  const auto raw =
      static_cast<std::uint64_t>(std::llround(std::clamp(std::isfinite(number) ? number : 0.0, low, high)));
  for (std::uint32_t i = 0; i < value.bits; ++i) {
    const std::uint32_t bit = value.first_bit + i;
    if (bit / 8 >= report.size()) return;
    const auto mask = static_cast<std::byte>(1u << bit % 8);
    report[bit / 8] = (raw >> i & 1u) != 0 ? report[bit / 8] | mask : report[bit / 8] & ~mask;
  }
}

void PidReport::set(Bytes& report, HidUsage usage, double value) const {
  if (const Value* found = find(usage)) put(report, *found, value);
}

void PidReport::set_share(Bytes& report, HidUsage usage, double share) const {
  if (const Value* found = find(usage)) {
    const double size = std::clamp(std::isfinite(share) ? share : 0.0, -1.0, 1.0);
    put(report, *found, size < 0.0 ? -size * found->least : size * found->most);
  }
}

void PidReport::set_part(Bytes& report, HidUsage usage, double part) const {
  if (const Value* found = find(usage))
    put(report, *found, found->least + part * (static_cast<double>(found->most) - found->least));
}

void PidReport::set_seconds(Bytes& report, HidUsage usage, double seconds) const {
  if (const Value* found = find(usage)) {
    // Milliseconds, where the descriptor does not say.
    const int exponent = found->unit_exponent == 0 ? -3 : found->unit_exponent;
    put(report, *found, seconds * std::pow(10.0, -exponent));
  }
}

bool PidReport::choose(Bytes& report, HidUsage option) const {
  for (const Value& value : values_) {
    const auto found = std::ranges::find(value.options, option);
    if (found == value.options.end()) continue;
    put(report, value, value.least + static_cast<double>(found - value.options.begin()));
    return true;
  }
  if (!has(option)) return false;
  set(report, option, 1.0);
  return true;
}

std::optional<std::int64_t> PidReport::get(std::span<const std::byte> report, HidUsage usage) const {
  const Value* value = find(usage);
  if (!value || value->bits == 0 || value->first_bit + value->bits > 8 * report.size()) return std::nullopt;
  std::uint64_t raw = 0;
  for (std::uint32_t i = 0; i < value->bits; ++i) {
    const std::uint32_t bit = value->first_bit + i;
    raw |= std::uint64_t{std::to_integer<unsigned>(report[bit / 8]) >> bit % 8 & 1u} << i;
  }
  const bool is_negative = value->least < 0 && (raw >> (value->bits - 1) & 1u) != 0;
  return static_cast<std::int64_t>(raw) - (is_negative ? std::int64_t{1} << value->bits : 0);
}

bool PidReport::is_chosen(std::span<const std::byte> report, HidUsage option) const {
  for (const Value& value : values_) {
    const auto found = std::ranges::find(value.options, option);
    if (found == value.options.end()) continue;
    return get(report, value.usage) == std::int64_t{value.least} + (found - value.options.begin());
  }
  return get(report, option).value_or(0) != 0;
}

std::optional<PidReports> find_pid_reports(const HidReportFields& device) {
  const auto create = PidReport::of(device, HidReportKind::feature, pid::create_report),
             load = PidReport::of(device, HidReportKind::feature, pid::block_load_report),
             effect = PidReport::of(device, HidReportKind::output, pid::set_effect_report),
             constant = PidReport::of(device, HidReportKind::output, pid::set_constant_report),
             operation = PidReport::of(device, HidReportKind::output, pid::operation_report);
  if (!create || !load || !effect || !constant || !operation) return std::nullopt;
  PidReports reports{*create, *load, *effect, *constant, *operation, {}, {}, {}};
  Bytes report = create->empty();
  if (!create->choose(report, pid::constant_force) || !load->has(pid::block_index) || !constant->has(pid::magnitude) ||
      !constant->has(pid::block_index) || !operation->has(pid::block_index))
    return std::nullopt;
  reports.condition = PidReport::of(device, HidReportKind::output, pid::set_condition_report);
  reports.gain = PidReport::of(device, HidReportKind::output, pid::device_gain_report);
  reports.control = PidReport::of(device, HidReportKind::output, pid::control_report);
  if (!reports.control) reports.control = PidReport::of(device, HidReportKind::output, pid::device_control);
  return reports;
}

}  // namespace septet::car_io
