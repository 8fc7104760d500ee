#include "car-io/can/dbc_signal.hpp"

#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace septet::car_io::dbc {
namespace {

constexpr const char* form = "SG_ NAME : START|BITS@ORDER SIGN (SCALE,OFFSET) [LOW|HIGH] \"UNIT\" RECEIVERS";

bool read_multiplex(std::string_view text, Signal& signal) {
  if (text == "M") return signal.selects = true;
  Scanner number(text.substr(1));
  signal.selected_by = number.take_unsigned();
  return text.starts_with('m') && signal.selected_by && number.at_end();
}

bool read_place(Scanner& scan, Signal& signal) {
  if (!scan.take(':')) return false;
  const auto start = scan.take_unsigned();
  if (!start || *start > 65535 || !scan.take('|')) return false;
  const auto bits = scan.take_unsigned();
  if (!bits || *bits < 1 || *bits > 64 || !scan.take('@')) return false;
  const auto order = scan.take_unsigned();
  if (!order || *order > 1) return false;
  signal.start_bit = static_cast<std::uint16_t>(*start);
  signal.bits = static_cast<std::uint8_t>(*bits);
  signal.order = *order == 1 ? ByteOrder::intel : ByteOrder::motorola;
  if (scan.take('-'))
    signal.number = Number::signed_whole;
  else if (!scan.take('+'))
    return false;
  return true;
}

bool read_scale(Scanner& scan, Signal& signal) {
  const auto pair = [&](char open, char between, char close, double& first, double& second) {
    if (!scan.take(open)) return false;
    const auto a = scan.take_number();
    if (!a || !scan.take(between)) return false;
    const auto b = scan.take_number();
    if (!b || !scan.take(close)) return false;
    first = *a;
    second = *b;
    return true;
  };
  if (!pair('(', ',', ')', signal.scale, signal.offset) || !pair('[', '|', ']', signal.low, signal.high)) return false;
  const Scanner before = scan;
  auto unit = scan.take_string();
  if (!unit || scan.line() != before.line()) {  // An end that is missing is not looked for in other statements.
    scan = before;
    return false;
  }
  signal.unit = std::move(*unit);
  return true;
}

}  // namespace

SignalLine take_signal(Scanner& scan, int line) {
  SignalLine read;
  Signal& signal = read.signal;
  const auto name = scan.take_name_in(line);
  if (!name) {
    read.fault = "a SG_ has no name";
    return read;
  }
  signal.name = *name;
  const auto multiplex = scan.take_identifier();
  read.is_nested = multiplex && multiplex->size() > 2 && multiplex->ends_with('M');
  if (read.is_nested) signal.selects = true;
  if (multiplex && !read_multiplex(multiplex->substr(0, multiplex->size() - (read.is_nested ? 1 : 0)), signal))
    read.fault = fmt::format("{} is multiplexed by {}, which is neither M nor mNUMBER", *name, *multiplex);
  else if (!read_place(scan, signal) || !read_scale(scan, signal))
    read.fault = fmt::format("the signal {} is not of the form {}", *name, form);
  return read;
}

/// Motorola's bits sit in rows from bit 7 down, byte after byte.
bool fits(const Signal& signal, std::uint8_t bytes) {
  const int begin =
      signal.order == ByteOrder::intel ? signal.start_bit : signal.start_bit / 8 * 8 + 7 - signal.start_bit % 8;
  return begin + signal.bits <= 8 * bytes;
}

}  // namespace septet::car_io::dbc
