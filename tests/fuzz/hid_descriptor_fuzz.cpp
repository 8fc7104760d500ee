// A HID report descriptor of any bytes, and behind it a wheel that returns any bytes: reports sent to it always have
// the announced length and id.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "car-io/pid/hid_fields.hpp"
#include "car-io/pid/pid_reports.hpp"
#include "car-io/pid/pid_wheel.hpp"

namespace {

using namespace septet;
using namespace septet::car_io;

/// Returns the rest of the input.
struct Stranger final : HidDevice {
  explicit Stranger(std::span<const std::byte> what, const HidReportFields& said) : answers(what), fields(said) {}
  Expected<std::optional<Bytes>> read_newest() override { return std::nullopt; }
  Expected<void> write(std::span<const std::byte> report) override { return take(report, HidReportKind::output); }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    return take(report, HidReportKind::feature);
  }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t size) override {
    if (answers.empty()) return failure("unplugged", "fuzz", "plug");
    const auto length = std::to_integer<std::size_t>(answers.front()) % (size + 2);
    const auto answer = answers.subspan(1).first(std::min(length, answers.size() - 1));
    answers = answers.subspan(1 + answer.size());
    return Bytes(answer.begin(), answer.end());
  }
  Expected<void> take(std::span<const std::byte> report, HidReportKind kind) {
    if (report.empty() || report.size() != fields.bytes_of(kind, std::to_integer<std::uint8_t>(report[0])))
      std::abort();
    return {};
  }
  std::span<const std::byte> answers;
  const HidReportFields& fields;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  // The first two bytes: how long the descriptor is.
  if (bytes.size() < 2) return 0;
  const std::size_t length = std::to_integer<std::size_t>(bytes[0]) | std::to_integer<std::size_t>(bytes[1]) << 8;
  const auto descriptor = bytes.subspan(2).first(std::min(length, bytes.size() - 2));
  const auto fields = read_hid_fields(descriptor);
  if (!fields) return 0;
  for (const HidField& field : fields->fields)
    if (field.first_bit + std::size_t{field.bits} * field.count > 8 * std::size_t{most_report_bytes}) std::abort();
  const auto reports = find_pid_reports(*fields);
  if (!reports) return 0;
  PidWheel wheel(std::make_unique<Stranger>(bytes.subspan(2 + descriptor.size()), *fields), *reports);
  for (const double force : {0.5, -1.0, 0.0}) {
    (void)wheel.set_condition(PidCondition::spring, 0.3);
    (void)wheel.set_condition(PidCondition::damper, 1.0);
    (void)wheel.set_condition(PidCondition::friction, force);
    (void)wheel.set_force(force);
  }
  return 0;
}
