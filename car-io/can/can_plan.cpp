#include "car-io/can/can_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "car-io/can/signal_codec.hpp"

namespace septet::car_io {
namespace {

constexpr std::string_view frame_counter = "counter";
constexpr double usual_period_s = 0.1, shortest_period_s = 0.005;

constexpr Quantity<Instruments> instruments[] = {
    {"ignition", &Instruments::ignition},
    {"speed_kmh", &Instruments::speed_kmh},
    {"engine_rpm", &Instruments::engine_rpm},
    {"gear", &Instruments::gear},
    {"selector", &Instruments::selector},
    {"coolant_temperature_c", &Instruments::coolant_temperature_c},
    {"outside_temperature_c", &Instruments::outside_temperature_c},
    {"fuel_percent", &Instruments::fuel_percent},
    {"indicator_left", &Instruments::indicator_left},
    {"indicator_right", &Instruments::indicator_right},
    {"low_beam", &Instruments::low_beam},
    {"high_beam", &Instruments::high_beam},
    {"rear_fog", &Instruments::rear_fog},
    {"parking_brake", &Instruments::parking_brake},
    {"anti_lock", &Instruments::anti_lock},
    {"engine_fault", &Instruments::engine_fault},
    {"tyre_pressure", &Instruments::tyre_pressure},
    {"lamp_fault", &Instruments::lamp_fault},
    {"engine_stopped", &Instruments::engine_stopped},
    {"controls_lost", &Instruments::controls_lost},
};
constexpr Quantity<CanControls> controls[] = {
    {"steering_wheel_deg", &CanControls::steering_wheel_deg},
    {"accelerator_percent", &CanControls::accelerator_percent},
    {"brake_percent", &CanControls::brake_percent},
    {"clutch_percent", &CanControls::clutch_percent},
    {"indicator_left_switch", &CanControls::indicator_left_switch},
    {"indicator_right_switch", &CanControls::indicator_right_switch},
    {"hazard_switch", &CanControls::hazard_switch},
    {"horn_switch", &CanControls::horn_switch},
    {"low_beam_switch", &CanControls::low_beam_switch},
    {"high_beam_switch", &CanControls::high_beam_switch},
    {"parking_brake_switch", &CanControls::parking_brake_switch},
    {"selector_position", &CanControls::selector_position},
    {"gear_position", &CanControls::gear_position},
    {"emergency_stop_switch", &CanControls::emergency_stop_switch},
    {"rearm_switch", &CanControls::rearm_switch},
};
constexpr std::size_t axes = 4;  // The first of the controls.

template <class Values>
std::optional<double Values::*> find(std::span<const Quantity<Values>> quantities, std::string_view name) {
  const auto found = std::ranges::find(quantities, name, &Quantity<Values>::name);
  return found == quantities.end() ? std::nullopt : std::optional(found->value);
}

bool is_axis(double CanControls::*control) {
  return std::ranges::any_of(std::span(controls).first(axes), [&](const auto& axis) { return axis.value == control; });
}

/// The rig's assignment of a signal, or else its own name.
std::variant<std::string_view, double> meaning(const rig::Can& can, const dbc::Message& message,
                                               const dbc::Signal& signal) {
  const std::string name = message.name + "." + signal.name;
  const auto found = std::ranges::find(can.signals, name, &rig::CanSignal::signal);
  if (found == can.signals.end()) return std::string_view(signal.name);
  if (found->quantity.empty()) return found->constant;
  return std::string_view(found->quantity);
}

const dbc::Signal* selecting_of(const dbc::Message& message) {
  const auto found = std::ranges::find(message.signals, true, &dbc::Signal::selects);
  return found == message.signals.end() ? nullptr : &*found;
}

/// The signal with the raw bits as its value, without its scale and range.
dbc::Signal raw(const dbc::Signal& signal) {
  return {.name = signal.name,
          .start_bit = signal.start_bit,
          .bits = signal.bits,
          .order = signal.order,
          .selects = signal.selects};
}

/// The selecting signal's raw value in a sent message, if the rig sets it to a constant.
std::optional<double> held_selection(const SentMessage& sent, const dbc::Signal& selecting) {
  const auto found = std::ranges::find_if(sent.signals, [&](const SentSignal& of) { return of.signal.selects; });
  const double* constant = found == sent.signals.end() ? nullptr : std::get_if<double>(&found->carries);
  if (!constant) return std::nullopt;
  std::array<std::byte, 64> data{};
  const auto frame = std::span(data).first(sent.message.bytes);
  dbc::encode(selecting, *constant, frame);
  return dbc::decode(sent.message, raw(selecting), frame);
}

/// A frame carries the signals of one selected value, so that a multiplexed message becomes several: one for each value
/// that selects a signal in use, or the rig's constant.
Expected<std::vector<SentMessage>> by_selection(SentMessage sent, const std::string& dbc) {
  std::set<std::uint64_t> values;
  for (const SentSignal& of : sent.signals)
    if (of.signal.selected_by) values.insert(*of.signal.selected_by);
  if (values.empty()) return std::vector{std::move(sent)};
  const dbc::Signal& selecting = *selecting_of(sent.message);
  const auto held = held_selection(sent, selecting);
  constexpr std::uint64_t largest_exact = 1ull << 53;
  std::vector<SentMessage> all;
  for (const std::uint64_t value : values) {
    if (value > largest_exact || (selecting.bits < 64 && value >> selecting.bits != 0))
      return failure(
          fmt::format("{} of {} cannot hold {}, which selects a signal", selecting.name, sent.message.name, value), dbc,
          "correct the signal's mNUMBER or the selecting signal's bits");
    if (held && *held != static_cast<double>(value)) continue;
    SentMessage one{sent.message, sent.period_s, {{raw(selecting), static_cast<double>(value)}}};
    for (const SentSignal& of : sent.signals)
      if (!of.signal.selects && (!of.signal.selected_by || *of.signal.selected_by == value)) one.signals.push_back(of);
    all.push_back(std::move(one));
  }
  if (all.empty()) {
    std::erase_if(sent.signals, [](const SentSignal& of) { return of.signal.selected_by.has_value(); });
    all.push_back(std::move(sent));
  }
  return all;
}

/// Splits a heard message by selected values too, since each of them has to beat for itself.
std::vector<HeardMessage> by_selection(const HeardMessage& heard) {
  std::vector<HeardMessage> all;
  for (const HeardSignal& of : heard.signals) {
    auto one = std::ranges::find_if(all, [&](const HeardMessage& other) {
      return other.signals.front().signal.selected_by == of.signal.selected_by;
    });
    if (one == all.end()) one = all.insert(all.end(), {heard.message, {}, false});
    one->signals.push_back(of);
    one->must_beat |= is_axis(of.control);
  }
  return all;
}

Expected<void> check_names(const dbc::Database& database, const rig::Can& can) {
  for (const rig::CanSignal& named : can.signals) {
    const auto point = named.signal.find('.');
    const auto unread = std::ranges::find(database.unread, named.signal.substr(0, point), &dbc::UnreadMessage::name);
    if (unread != database.unread.end()) return tl::unexpected(unread->why);
    const auto* message = dbc::find_message(database, named.signal.substr(0, point));
    if (!message || !dbc::find_signal(*message, named.signal.substr(point + 1)))
      return failure(fmt::format("[can.signals] names {}, which {} has not", named.signal, can.dbc), "the rig",
                     "name a message and signal of it");
    if (named.quantity.empty() || named.quantity == frame_counter) continue;
    if (find(instrument_quantities(), named.quantity) || find(control_quantities(), named.quantity)) continue;
    return failure(
        fmt::format("[can.signals] gives {} the quantity \"{}\", which there is not", named.signal, named.quantity),
        "the rig", "choose one of car-io/can/README.md");
  }
  return {};
}

}  // namespace

std::span<const Quantity<Instruments>> instrument_quantities() { return instruments; }
std::span<const Quantity<CanControls>> control_quantities() { return controls; }

Expected<CanPlan> plan_can(const dbc::Database& database, const rig::Can& can) {
  if (const auto known = check_names(database, can); !known) return tl::unexpected(known.error());
  // A signal that is called as a quantity is used, and so is its message.
  for (const dbc::UnreadMessage& unread : database.unread)
    for (const std::string& name : unread.signals)
      if (find(instrument_quantities(), name) || find(control_quantities(), name))
        return failure(fmt::format("{} of {} cannot be used: {}", name, unread.name, unread.why.what), unread.why.where,
                       unread.why.remedy + ", or call the signal otherwise");
  CanPlan plan;
  for (const dbc::Message& message : database.messages) {
    SentMessage sent{message, std::max(message.period_s.value_or(usual_period_s), shortest_period_s), {}};
    HeardMessage heard{message, {}, false};
    bool shows = false;  // Constants and counters alone make no message of ours.
    for (const dbc::Signal& signal : message.signals) {
      const auto means = meaning(can, message, signal);
      if (const auto* constant = std::get_if<double>(&means)) {
        sent.signals.push_back({signal, *constant});
        shows = true;
        continue;
      }
      const auto name = std::get<std::string_view>(means);
      if (const auto instrument = find(instrument_quantities(), name)) {
        sent.signals.push_back({signal, *instrument});
        shows = true;
      } else if (const auto control = find(control_quantities(), name)) {
        heard.signals.push_back({signal, *control});
      } else if (name == frame_counter) {
        sent.signals.push_back({signal, FrameCounter{}});
      }
    }
    if (shows && !heard.signals.empty())
      return failure(fmt::format("{} would be sent and heard", message.name), can.dbc,
                     "let a message carry instruments or controls");
    const auto is_selected = [](const auto& of) { return of.signal.selected_by.has_value(); };
    if (!selecting_of(message) &&
        ((shows && std::ranges::any_of(sent.signals, is_selected)) || std::ranges::any_of(heard.signals, is_selected)))
      return failure(fmt::format("{} has multiplexed signals and none that selects them", message.name), can.dbc,
                     "mark the selecting signal with M");
    if (shows) {
      dbc::Message ours = message;
      ours.signals.clear();
      for (const auto& signal : sent.signals) ours.signals.push_back(signal.signal);
      const dbc::Signal* selecting = selecting_of(message);
      if (selecting && std::ranges::any_of(sent.signals, is_selected) && !dbc::find_signal(ours, selecting->name))
        ours.signals.push_back(*selecting);
      if (const auto both = dbc::overlap(ours))
        return failure(fmt::format("{} and {} of {} share bits", both->first->name, both->second->name, message.name),
                       can.dbc, "send only one of them");
    }
    if (shows || !heard.signals.empty()) plan.needs_fd |= message.is_fd;
    if (shows) {
      auto all = by_selection(std::move(sent), can.dbc);
      if (!all) return tl::unexpected(std::move(all.error()));
      std::ranges::move(*all, std::back_inserter(plan.sent));
    } else {
      std::ranges::move(by_selection(heard), std::back_inserter(plan.heard));
    }
  }
  if (plan.sent.empty() && plan.heard.empty())
    return failure("none of its signals carries anything of the car", can.dbc, "name some in the rig's [can.signals]");
  return plan;
}

}  // namespace septet::car_io
