#pragma once
/// What the frames of a CAN bus mean, read from a DBC file (Vector's format, as cantools and most tools write it).
///
/// Read are messages, signals with their multiplexing, floating point signals (SIG_VALTYPE_), and the attributes GenMsgCycleTime and
/// VFrameFormat (CAN FD is what its list of names calls `…_FD`; without a list 14 and 15); everything else that the format knows (comments,
/// value tables, nodes, environment variables) is skipped, and so are a byte-order mark, remarks that begin with `//`, a sender that is missing
/// and a `;` that is missing before the next line's statement. Names may begin with a digit. Files of makers have faults in messages that a rig
/// does not need: a message with a fault is left unread, with its reason and line, and the others are read. The file comes from outside: the
/// outcome is a database whose signals all lie within their messages, or an Error with the line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::car_io::dbc {

/// Of a signal longer than a byte: Intel counts its bits upwards from `start_bit`, Motorola begins there with the most significant
/// one and goes on in the next byte's bit 7. Bit b lies in byte b / 8, 0 is that byte's least significant.
enum class ByteOrder : std::uint8_t { motorola, intel };
enum class Number : std::uint8_t { unsigned_whole, signed_whole, float32, float64 };

struct Signal {
  std::string name;
  std::uint16_t start_bit = 0;
  std::uint8_t bits = 1;  ///< 1 to 64.
  ByteOrder order = ByteOrder::intel;
  Number number = Number::unsigned_whole;
  double scale = 1.0, offset = 0.0;  ///< Physical value = raw · scale + offset.
  double low = 0.0, high = 0.0;      ///< Physical range; equal: the file gives none.
  std::string unit;
  bool selects = false;                      ///< Its raw value says which of the multiplexed signals a frame carries.
  std::optional<std::uint64_t> selected_by;  ///< Multiplexed: only in frames whose selecting signal has this raw value.
};

struct Message {
  std::uint32_t id = 0;  ///< 11 bits, or 29 where it is extended.
  bool is_extended = false;
  std::string name;
  std::uint8_t bytes = 8;          ///< 0 to 8, with CAN FD to 64.
  bool is_fd = false;              ///< Longer than a classic frame, or declared so.
  std::optional<double> period_s;  ///< How often it is sent, where the file says so.
  std::vector<Signal> signals;
};

/// A message with a fault, or that no frame carries (a transport message, extended multiplexing). It matters only to a rig that names it.
struct UnreadMessage {
  std::string name;
  std::vector<std::string> signals;
  Error why;
};

struct Database {
  std::vector<Message> messages;
  std::vector<UnreadMessage> unread;
};

/// What a person should know of a file that was read: how many messages of it were not, and why the first was not.
std::optional<Error> notice_of(const Database& database);

const Message* find_message(const Database& database, std::string_view name);
const Signal* find_signal(const Message& message, std::string_view name);

/// `name` is used in messages: "cluster.dbc:12".
Expected<Database> read_dbc(std::string_view text, std::string_view name);

}  // namespace septet::car_io::dbc
