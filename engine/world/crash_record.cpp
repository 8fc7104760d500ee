#include "engine/world/crash_record.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/core.h>

#include "engine/world/solid.hpp"

namespace septet {
namespace {

constexpr double beyond_everything = 1e12;  ///< In any unit; an altered text may exceed it.

/// Calls `visit` with the key and the value of each number that may be missing: one list for both directions.
template <class Body, class Visit>
void visit_body(const std::string& of, Body& body, const Visit& visit) {
  visit(of + "mass_kg", body.mass_kg);
  visit(of + "yaw_inertia_kgm2", body.yaw_inertia_kgm2);
  visit(of + "mass_centre_ahead_m", body.mass_centre_ahead_m);
  visit(of + "mass_centre_above_m", body.mass_centre_above_m);
  visit(of + "before_", "_mps", body.before_mps);
  visit(of + "yaw_rate_before_radps", body.yaw_rate_before_radps);
  visit(of + "delta_v_", "_mps", body.delta_v_mps);
  visit(of + "delta_yaw_rate_radps", body.delta_yaw_rate_radps);
  visit(of + "principal_direction_rad", body.principal_direction_rad);
  visit(of + "crush_m", body.crush_m);
}
template <class Crash, class Visit>
void visit_numbers(Crash& crash, const Visit& visit) {
  visit("sliding_mps", crash.sliding_mps);
  visit("overlap_m", crash.overlap_m);
  visit("overlap_share", crash.overlap_share);
  visit("depth_m", crash.depth_m);
  visit("contact_s", crash.contact_s);
  visit_body("", crash.of_first, visit);
  visit_body("its_", crash.of_second, visit);
  visit("pieces_kinetic_j", crash.pieces_kinetic_j);
}
template <class Ledger, class Visit>
void visit_ledger(Ledger& ledger, const Visit& visit) {
  visit("kinetic_before_j", ledger.kinetic_before_j);
  visit("kinetic_after_j", ledger.kinetic_after_j);
  visit("crush_j", ledger.crush_j);
  visit("friction_j", ledger.friction_j);
  visit("debris_j", ledger.debris_j);
  visit("wheels_j", ledger.wheels_j);
}

struct Writer {
  std::string& text;

  void add(std::string_view key, double value) const { text += fmt::format(" {}={:.9g}", key, value); }
  void operator()(std::string_view key, const std::optional<double>& value) const {
    if (value) add(key, *value);
  }
  void operator()(const std::string& before, const std::string& unit, const std::optional<Vec2>& value) const {
    if (!value) return;
    add(before + "x" + unit, value->x);
    add(before + "y" + unit, value->y);
  }
};

/// The words of a detail, `key=value` each.
struct Reader {
  std::string_view detail;

  std::optional<std::string_view> word(std::string_view key) const {
    for (std::size_t at = 0; at < detail.size();) {
      const std::size_t end = std::min(detail.find(' ', at), detail.size());
      const std::string_view pair = detail.substr(at, end - at);
      if (pair.size() > key.size() && pair.starts_with(key) && pair[key.size()] == '=')
        return pair.substr(key.size() + 1);
      at = end + 1;
    }
    return std::nullopt;
  }
  template <class Number>
  static std::optional<Number> number_in(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
  }
  static std::optional<double> real_in(std::string_view text) {
    const auto value = number_in<double>(text);
    return value && std::abs(*value) < beyond_everything ? value : std::nullopt;
  }
  std::optional<double> real(std::string_view key) const {
    const auto text = word(key);
    return text ? real_in(*text) : std::nullopt;
  }
  template <class Number>
  std::optional<Number> whole(std::string_view key) const {
    const auto text = word(key);
    return text ? number_in<Number>(*text) : std::nullopt;
  }

  void operator()(std::string_view key, std::optional<double>& value) const { value = real(key); }
  void operator()(const std::string& before, const std::string& unit, std::optional<Vec2>& value) const {
    const auto x = real(before + "x" + unit), y = real(before + "y" + unit);
    if (x && y) value = Vec2(*x, *y);
  }
};

/// "x:y,x:y"; empty where one of them is none.
std::vector<Vec2> pulse_in(std::string_view text) {
  std::vector<Vec2> pulse;
  while (!text.empty() && pulse.size() < most_pulse_ticks) {
    const std::string_view one = text.substr(0, text.find(','));
    const std::size_t colon = one.find(':');
    if (colon == std::string_view::npos) return {};
    const auto x = Reader::real_in(one.substr(0, colon)), y = Reader::real_in(one.substr(colon + 1));
    if (!x || !y) return {};
    pulse.emplace_back(*x, *y);
    text.remove_prefix(std::min(one.size() + 1, text.size()));
  }
  return pulse;
}

std::string in_one_word(std::string text) {
  std::ranges::replace(text, ' ', '_');
  return text;
}

}  // namespace

std::optional<Vec2> impulse_ns(const CrashRecord& crash) {
  if (crash.pulse_ns.empty()) return std::nullopt;
  Vec2 sum(0.0);
  for (const Vec2& part : crash.pulse_ns) sum += part;
  return sum;
}

std::string contact_text(double contact_s) {
  return contact_s > told_within_s - parted_s ? fmt::format("{:.0f} s or longer", told_within_s)
                                              : fmt::format("{:.1f} s", contact_s);
}

double share_missing(const CrashLedger& ledger) {
  const double lost_j = ledger.kinetic_before_j - ledger.kinetic_after_j;
  const double told_j = ledger.crush_j + ledger.friction_j + ledger.debris_j + ledger.wheels_j;
  return std::abs(lost_j - told_j) / std::max(std::abs(lost_j), std::numeric_limits<double>::min());
}

std::string text_of(const CrashRecord& crash) {
  std::string text = fmt::format("version={} tick={} ticks={}", crash_record_version, crash.tick, crash.ticks);
  if (crash.second) text += fmt::format(" with={}", *crash.second);
  if (!crash.second && !crash.stands.empty()) text += fmt::format(" stands={}", in_one_word(crash.stands));
  const Writer write{text};
  write.add("point_x_m", crash.point_m.x);
  write.add("point_y_m", crash.point_m.y);
  write.add("point_z_m", crash.point_m.z);
  write.add("normal_rad", crash.normal_rad);
  write.add("closing_speed_mps", crash.closing_speed_mps);
  visit_numbers(crash, write);
  if (crash.ledger)
    visit_ledger(*crash.ledger, [&](std::string_view key, const double& value) { write.add(key, value); });
  for (std::size_t i = 0; i < crash.pulse_ns.size(); ++i)
    text += fmt::format("{}{:.6g}:{:.6g}", i == 0 ? " pulse_ns=" : ",", crash.pulse_ns[i].x, crash.pulse_ns[i].y);
  if (crash.is_unfinished) text += " unfinished=1";
  if (crash.second && !crash.stands.empty()) text += name_of_struck(crash.stands);
  return text;
}

std::optional<CrashRecord> read_crash(ParticipantId first, std::string_view detail) {
  const Reader read{detail};
  if (read.whole<int>("version") != crash_record_version) return std::nullopt;
  const auto tick = read.whole<Tick>("tick");
  const auto ticks = read.whole<std::uint32_t>("ticks");
  const auto x = read.real("point_x_m"), y = read.real("point_y_m"), z = read.real("point_z_m");
  const auto normal = read.real("normal_rad"), closing = read.real("closing_speed_mps");
  if (!tick || !ticks || !x || !y || !z || !normal || !closing) return std::nullopt;
  CrashRecord crash;
  crash.tick = *tick;
  crash.ticks = *ticks;
  crash.first = first;
  crash.second = read.whole<ParticipantId>("with");
  if (crash.second) {
    crash.stands = struck_by_name(detail).value_or("");
  } else {
    crash.stands = std::string(read.word("stands").value_or(""));
    std::ranges::replace(crash.stands, '_', ' ');
  }
  crash.point_m = Vec3(*x, *y, *z);
  crash.normal_rad = *normal;
  crash.closing_speed_mps = *closing;
  visit_numbers(crash, read);
  CrashLedger ledger;
  bool whole = true;
  visit_ledger(ledger, [&](std::string_view key, double& value) {
    const auto told = read.real(key);
    whole = whole && told;
    value = told.value_or(0.0);
  });
  if (whole) crash.ledger = ledger;
  if (const auto pulse = read.word("pulse_ns")) crash.pulse_ns = pulse_in(*pulse);
  crash.is_unfinished = read.word("unfinished") == "1";
  return crash;
}

}  // namespace septet
