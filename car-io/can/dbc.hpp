#pragma once
/// Meaning of a CAN bus's frames, read from a DBC file (Vector's format, as cantools and most tools write it).
///
/// Parsed: messages, signals with their multiplexing, floating point signals (SIG_VALTYPE_), and the attributes
/// GenMsgCycleTime and VFrameFormat (CAN FD is an entry of its list of names that ends in `_FD`; without a list 14 and
/// 15). Skipped: everything else in the format (comments, value tables, nodes, environment variables), a byte-order
/// mark, remarks that begin with `//`, a missing sender and a missing `;` before the next line's statement. Names may
/// begin with a digit. Makers' files have faults in messages that a rig does not need: a faulty message is left unread,
/// with its reason and line, and the others are read. Likewise one whose line does not begin with BO_, together with its
/// signals; signals behind another statement; and one with any other line after it that begins no statement. The file is
/// untrusted: the outcome is a database whose signals all lie within their messages, or an Error with the line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::car_io::dbc {

/// For a signal longer than a byte: Intel counts its bits upwards from `start_bit`, Motorola begins there with the most
/// significant one and goes on in the next byte's bit 7. Bit b lies in byte b / 8, 0 is that byte's least significant.
enum class ByteOrder : std::uint8_t { motorola, intel };
enum class Number : std::uint8_t { unsigned_whole, signed_whole, float32, float64 };

struct Signal {
  std::string name;
  std::uint16_t start_bit = 0;
  std::uint8_t bits = 1;  ///< 1 to 64.
  ByteOrder order = ByteOrder::intel;
  Number number = Number::unsigned_whole;
  double scale = 1.0, offset = 0.0;  ///< Physical value = raw · scale + offset.
  double low = 0.0, high = 0.0;      ///< Physical range; equal: not given.
  std::string unit;
  bool selects = false;                      ///< Its raw value selects the multiplexed signals of a frame.
  std::optional<std::uint64_t> selected_by;  ///< Multiplexed: only in frames whose selecting signal has this raw value.
};

struct Message {
  std::uint32_t id = 0;  ///< 11 bits, or 29 if it is extended.
  bool is_extended = false;
  std::string name;
  std::uint8_t bytes = 8;          ///< 0 to 8, with CAN FD to 64.
  bool is_fd = false;              ///< Longer than a classic frame, or declared so.
  std::optional<double> period_s;  ///< Cycle time, if the file gives one.
  std::vector<Signal> signals;
};

/// A message with a fault, or without a frame of its own (a transport message, extended multiplexing). It matters only
/// to a rig that names it.
struct UnreadMessage {
  std::string name;
  std::vector<std::string> signals;
  Error why;
};

struct Database {
  std::vector<Message> messages;
  std::vector<UnreadMessage> unread;
};

/// Notice on unread messages of a file: their number, and the first one's reason.
std::optional<Error> notice_of(const Database& database);

const Message* find_message(const Database& database, std::string_view name);
const Signal* find_signal(const Message& message, std::string_view name);

/// `name` is used in messages: "cluster.dbc:12".
Expected<Database> read_dbc(std::string_view text, std::string_view name);

}  // namespace septet::car_io::dbc
