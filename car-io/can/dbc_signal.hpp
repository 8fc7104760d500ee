#pragma once
/// Form of one signal in a DBC file: `SG_ NAME MULTIPLEX : START|BITS@ORDER SIGN (SCALE,OFFSET) [LOW|HIGH] "UNIT"`. For
/// dbc.cpp.

#include <cstdint>
#include <optional>
#include <string>

#include "car-io/can/dbc.hpp"
#include "car-io/can/dbc_scanner.hpp"

namespace septet::car_io::dbc {

struct SignalLine {
  Signal signal;           ///< As far as it was read.
  bool is_nested = false;  ///< It is selected and selects (extended multiplexing).
  std::optional<std::string> fault;
};

/// Takes what stands between SG_, in `line`, and the receivers. With a fault, `scan` is wherever that was found.
SignalLine take_signal(Scanner& scan, int line);

/// True if all bits of the signal lie in its message.
bool fits(const Signal& signal, std::uint8_t bytes);

}  // namespace septet::car_io::dbc
