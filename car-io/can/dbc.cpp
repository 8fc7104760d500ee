#include "car-io/can/dbc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "car-io/can/dbc_draft.hpp"
#include "car-io/can/dbc_scanner.hpp"
#include "car-io/can/dbc_signal.hpp"
#include "engine/core/printable.hpp"

namespace septet::car_io::dbc {
namespace {

constexpr std::size_t largest_file = 8u << 20, most_signals = 1024;
constexpr std::uint64_t extended_flag = 1ull << 31;
/// Vector's pseudo messages for signals without a message, today's and an older one.
constexpr std::array<std::uint64_t, 2> independent_signals{0xC0000000, 0x40000000};

constexpr std::string_view statements[] = {"VERSION",
                                           "NS_",
                                           "BS_",
                                           "BU_",
                                           "VAL_TABLE_",
                                           "BO_",
                                           "SG_",
                                           "BO_TX_BU_",
                                           "EV_",
                                           "EV_DATA_",
                                           "ENVVAR_DATA_",
                                           "SGTYPE_",
                                           "SGTYPE_VAL_",
                                           "CM_",
                                           "BA_DEF_",
                                           "BA_DEF_DEF_",
                                           "BA_",
                                           "BA_DEF_REL_",
                                           "BA_REL_",
                                           "BA_DEF_DEF_REL_",
                                           "BA_DEF_SGTYPE_",
                                           "BA_SGTYPE_",
                                           "VAL_",
                                           "CAT_DEF_",
                                           "CAT_",
                                           "FILTER",
                                           "SIG_GROUP_",
                                           "SIG_VALTYPE_",
                                           "SIGTYPE_VALTYPE_",
                                           "SIG_TYPE_REF_",
                                           "SG_MUL_VAL_",
                                           "BU_SG_REL_",
                                           "BU_EV_REL_",
                                           "BU_BO_REL_",
                                           "NS_DESC_"};

bool is_statement(std::string_view word) { return std::ranges::find(statements, word) != std::end(statements); }

bool is_length(std::uint64_t bytes) {
  constexpr std::array<std::uint64_t, 7> of_fd{12, 16, 20, 24, 32, 48, 64};
  return bytes <= 8 || std::ranges::find(of_fd, bytes) != of_fd.end();
}

/// Name of the message that `line` begins, where it is of a BO_'s form but for its first word; empty for another line.
std::optional<std::string_view> message_begun_by(std::string_view line) {
  if (line.find_first_of("|@([\"") != std::string_view::npos) return std::nullopt;  // A signal has them.
  Scanner scan(line.substr(std::min(line.find_first_of(" \t"), line.size())));
  scan.take_unsigned();
  const auto name = scan.take_name();
  return name && scan.take(':') && scan.take_unsigned() ? name : std::nullopt;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : scan_(text), name_(name) {}

  Expected<Database> read() {
    while (error_.what.empty() && !scan_.at_end()) statement();
    if (!error_.what.empty()) return tl::unexpected(std::move(error_));
    return std::move(draft_).finish();
  }

 private:
  void refuse(std::string what, std::string remedy = "correct it, or export the file again") {
    if (error_.what.empty()) error_ = {std::move(what), fmt::format("{}:{}", name_, line_), std::move(remedy)};
  }

  void statement() {
    line_ = scan_.line();
    if (scan_.peek() == '/') return remark();
    Scanner from_word = scan_;
    const auto word = scan_.take_identifier();
    const bool follows_message = std::exchange(in_message_, word == "BO_" || word == "SG_");
    if (!word || !is_statement(*word)) {
      if (const auto name = message_begun_by(from_word.rest_of_line())) return lose_message(*name);
      if (follows_message) return leave_line_unread();
      refuse(word ? fmt::format("\"{}\" begins no statement of a DBC file", printable(std::string(word->substr(0, 40))))
                  : fmt::format("a statement begins with \"{}\"", printable(std::string(1, scan_.peek()))));
    } else if (*word == "VERSION") {
      if (!scan_.take_string()) refuse("VERSION has no text in quotes");
    } else if (*word == "NS_") {
      new_symbols();
    } else if (*word == "BS_") {
      while (scan_.take(':') || scan_.take(',') || scan_.take_unsigned()) {
      }
    } else if (*word == "BU_") {
      scan_.take(':');
      names_until_statement();
    } else if (*word == "BO_") {
      message();
    } else if (*word == "SG_") {
      if (!follows_message && draft_.size() > 0) lose_signals();
      signal();
    } else if (*word == "BA_") {
      attribute();
    } else if (*word == "BA_DEF_") {
      definition_of_attribute();
    } else if (*word == "SG_MUL_VAL_") {
      selected_values();
    } else if (*word == "BA_DEF_DEF_") {
      default_of_attribute();
    } else if (*word == "SIG_VALTYPE_") {
      value_type();
    } else {
      end_statement();
    }
  }

  /// A person's remark; the format itself has CM_. One that takes a message out leaves the signals behind it to nobody.
  void remark() {
    const std::string_view line = scan_.rest_of_line();
    const auto message = message_begun_by(line.substr(std::min(line.find("BO_"), line.size())));
    if (message && draft_.size() > 0 && *message != draft_[draft_.size() - 1].name) in_message_ = false;
    scan_.skip_line();
  }

  /// Past its `;`; where that is missing, up to the line that begins another statement, or to the end.
  void end_statement() {
    for (int line = line_; !scan_.take(';'); line = scan_.line()) {
      if (scan_.at_end()) return;
      const auto word = scan_.peek_identifier();
      if (scan_.line() > line && word && is_statement(*word)) return;
      if (!scan_.skip_word()) return refuse("a text in quotes has no end", "end it with \"");
    }
  }

  void skip_rest_of_line() {
    if (scan_.line() == line_) scan_.skip_line();
  }

  /// Skips names of nodes, which nothing here depends on, with other characters in their line, up to a text or a
  /// remark, or a line that is a message's but for its first word.
  void names_until_statement() {
    int line = line_;
    for (auto word = scan_.peek_identifier(); !word || !is_statement(*word); word = scan_.peek_identifier()) {
      if (scan_.line() > line && message_begun_by(scan_.rest_of_line())) return;
      line = scan_.line();
      if (scan_.take_name() || scan_.take(',')) continue;
      if (scan_.peek() == '"' || scan_.peek() == '/' || scan_.line() != line_ || !scan_.skip_word()) return;
    }
  }

  /// A message whose first word is damaged: one section with the signals that follow, all unread.
  void lose_message(std::string_view name) {
    ignored_ = false;
    in_message_ = true;
    if (const auto place = add_message(name))
      leave_unread(*place, fmt::format("the line of the message {} does not begin with BO_", name));
    skip_rest_of_line();
  }

  /// Signals behind a statement that is no message: what it was before a damage is unknown.
  void lose_signals() {
    ignored_ = false;
    if (const auto place = add_message({})) leave_unread(*place, "a SG_ stands behind no BO_");
  }

  /// A line among a message's that begins no statement nor, but for its first word, a message: a part of that message,
  /// most likely. Signals that follow may be another one's.
  void leave_line_unread() {
    if (!ignored_) {
      const std::size_t last = draft_.size() - 1;
      leave_unread(last, fmt::format("a line of {}, or after it, begins no statement", draft_[last].name));
    }
    ignored_ = in_message_ = true;
    skip_rest_of_line();
  }

  /// A list of words that are statements elsewhere, up to the first other word.
  void new_symbols() {
    if (!scan_.take(':')) return refuse("NS_ has no colon");
    for (auto word = scan_.peek_identifier(); word && *word != "BS_" && *word != "BU_" && *word != "BO_";
         word = scan_.peek_identifier())
      scan_.take_identifier();
  }

  void leave_unread(std::size_t message, std::string what,
                    std::string remedy = "correct it, or export the file again") {
    draft_.leave_unread(message, {std::move(what), fmt::format("{}:{}", name_, line_), std::move(remedy)});
  }
  /// Leaves both unread, since the intended one is unknown.
  void leave_both_unread(std::size_t one, std::size_t other, const std::string& what) {
    leave_unread(one, what, "keep one of them");
    leave_unread(other, what, "keep one of them");
  }

  /// Empty, and the file is refused, where it has too many.
  std::optional<std::size_t> add_message(std::string_view name) {
    const auto place = draft_.add(name);
    if (!place) refuse(fmt::format("the file has more than {} messages", Draft::most_messages), "split it");
    return place;
  }

  static constexpr const char* form_of_message = "a BO_ is not of the form BO_ ID NAME: BYTES SENDER";

  void message() {
    const auto id = scan_.take_unsigned();
    const auto name = scan_.take_name_in(line_);
    const bool has_colon = name && scan_.take(':');
    const auto bytes = has_colon ? scan_.take_unsigned() : std::nullopt;
    ignored_ = id && std::ranges::find(independent_signals, *id) != independent_signals.end();
    if (ignored_) return skip_rest_of_line();
    const auto added = add_message(name.value_or(std::string_view()));
    if (!added) return;
    const std::size_t place = *added;
    Message& message = draft_[place];
    if (!id || !name || !has_colon || !bytes) {
      leave_unread(place, form_of_message);
      return skip_rest_of_line();
    }
    // Its sender may be missing.
    const auto sender = scan_.peek_identifier();
    if (scan_.line() == line_ && !scan_.at_end() && !(sender && is_statement(*sender))) {
      if (!scan_.take_name()) leave_unread(place, form_of_message);
      names_until_statement();
    }
    const std::uint64_t number = *id & ~extended_flag;
    // Many files of other people leave the flag out.
    message.is_extended = (*id & extended_flag) != 0 || number > 0x7FFu;
    message.id = static_cast<std::uint32_t>(number);
    message.bytes = static_cast<std::uint8_t>(is_length(*bytes) ? *bytes : 0);
    message.is_fd = *bytes > 8;
    if (number > 0x1FFFFFFFu)
      leave_unread(place, fmt::format("{} is no CAN identifier", *id), "use 11 bits, or 29 bits with bit 31 set");
    if (!is_length(*bytes))
      leave_unread(place, fmt::format("{} has {} bytes, which no frame has", *name, *bytes),
                   "use a message of 0 to 8, 12, 16, 20, 24, 32, 48 or 64 bytes");
    if (const auto other = draft_.take_name(place))
      leave_both_unread(place, *other, fmt::format("two messages are called {}", message.name));
    if (const auto other = draft_.take_number(place, *id))
      leave_both_unread(place, *other, fmt::format("two messages have the identifier {}", *id));
  }

  void signal() {
    if (draft_.size() == 0 && !ignored_) return refuse("a SG_ stands before the first BO_");
    auto [signal, is_nested, fault] = take_signal(scan_, line_);
    if (fault)
      skip_rest_of_line();
    else
      names_until_statement();  // Its receivers.
    if (ignored_) return;
    const std::size_t place = draft_.size() - 1;
    Message& message = draft_[place];
    if (message.signals.size() == most_signals)
      return leave_unread(place, fmt::format("{} has more than {} signals", message.name, most_signals));
    if (fault)
      leave_unread(place, *fault);
    else if (is_nested ||
             (signal.selects && std::ranges::find(message.signals, true, &Signal::selects) != message.signals.end()))
      leave_unread(place, fmt::format("{} of {} is one of several selecting signals", signal.name, message.name),
                   simple);
    else if (!std::isnormal(signal.scale))
      leave_unread(place, fmt::format("the scale of {} is 0", signal.name));
    else if (!fits(signal, message.bytes))
      leave_unread(place,
                   fmt::format("{} reaches beyond the {} bytes of {}", signal.name, message.bytes, message.name));
    else if (find_signal(message, signal.name))
      leave_unread(place, fmt::format("{} has two signals {}", message.name, signal.name));
    message.signals.push_back(std::move(signal));
  }

  static constexpr const char* simple =
      "use a message that one signal M selects by mNUMBER; extended multiplexing is not read";

  /// BA_ "NAME" BO_ ID VALUE; the attributes of everything else are skipped.
  void attribute() {
    const auto name = scan_.take_string();
    if (!name) return refuse("BA_ names no attribute");
    const auto of = scan_.peek_identifier();
    if (of && *of == "BO_" && (*name == cycle_time || *name == frame_format)) {
      scan_.take_identifier();
      const auto id = scan_.take_unsigned();
      const auto name_of_value = *name == frame_format ? scan_.take_string() : std::nullopt;
      const auto value = name_of_value ? std::optional(0.0) : scan_.take_number();
      const auto message = find(id);
      if (!message) return end_statement();
      if (!value)
        leave_unread(*message, fmt::format("BA_ \"{}\" BO_ {} is not followed by a number", *name, *id));
      else if (*name == frame_format)
        draft_.set_format(*message, {*value, name_of_value});
      else
        set_period(*message, *value);
    }
    end_statement();
  }

  /// BA_DEF_ BO_ "NAME" ENUM "NAME OF 0","NAME OF 1",…;
  void definition_of_attribute() {
    constexpr std::size_t most_formats = 256;
    const auto of = scan_.peek_identifier();
    if (of && *of == "BO_") {
      scan_.take_identifier();
      const auto name = scan_.take_string();
      const auto kind = scan_.peek_identifier();
      if (name && *name == frame_format && kind && *kind == "ENUM") {
        scan_.take_identifier();
        std::vector<std::string> formats;
        for (auto value = scan_.take_string(); value && formats.size() < most_formats;) {
          formats.push_back(std::move(*value));
          value = scan_.take(',') ? scan_.take_string() : std::nullopt;
        }
        draft_.set_format_names(std::move(formats));
      }
    }
    end_statement();
  }

  /// SG_MUL_VAL_ ID SIGNAL SELECTING FIRST-LAST,…; repeats the meaning of mNUMBER, or is extended multiplexing.
  void selected_values() {
    const auto id = scan_.take_unsigned();
    const auto name = scan_.take_name();
    const auto selecting = scan_.take_name();
    const auto first = scan_.take_unsigned();
    const bool has_range = scan_.take('-');
    const auto last = scan_.take_unsigned();
    if (const auto place = find(id)) {
      const Message& message = draft_[*place];
      if (!name || !selecting || !first || !has_range || !last) {
        leave_unread(*place, "a SG_MUL_VAL_ is not of the form SG_MUL_VAL_ ID SIGNAL SELECTING FIRST-LAST;");
        return end_statement();
      }
      const Signal *signal = find_signal(message, *name), *by = find_signal(message, *selecting);
      if (signal && (scan_.peek() == ',' || *first != *last || signal->selected_by != first || !by || !by->selects))
        leave_unread(*place, fmt::format("{} of {} is selected by more than one value", *name, message.name), simple);
    }
    end_statement();
  }

  void set_period(std::size_t place, double period_ms) {
    if (period_ms < 0.0 || period_ms > Draft::longest_period_ms)
      leave_unread(place, fmt::format("{} is sent every {} ms", draft_[place].name, period_ms), "use 0 to 600000 ms");
    else
      draft_.set_period(place, period_ms);
  }

  void default_of_attribute() {
    const auto name = scan_.take_string();
    if (!name) return refuse("BA_DEF_DEF_ names no attribute");
    if (*name == frame_format) {
      FrameFormat format{0.0, scan_.take_string()};
      if (!format.name) format.index = scan_.take_number().value_or(0.0);
      draft_.set_default_format(std::move(format));
    }
    if (*name == cycle_time) draft_.set_default_period(scan_.take_number().value_or(0.0));
    end_statement();
  }

  /// SIG_VALTYPE_ ID SIGNAL : 1 or 2;
  void value_type() {
    const auto id = scan_.take_unsigned();
    const auto name = scan_.take_name();
    scan_.take(':');
    const auto type = scan_.take_unsigned();
    end_statement();
    const auto message = find(id);
    if (!message || type == 0u || draft_.is_unread(*message)) return;
    if (!name || !type || *type > 2)
      return leave_unread(*message, "a SIG_VALTYPE_ is not of the form SIG_VALTYPE_ ID SIGNAL : 0, 1 or 2;");
    auto& signals = draft_[*message].signals;
    const auto signal = std::ranges::find(signals, *name, &Signal::name);
    if (signal == signals.end()) return;
    if (signal->bits != 32 * *type)
      return leave_unread(*message, fmt::format("{} is a float of {} bits", *name, signal->bits), "use 32 or 64 bits");
    signal->number = *type == 1 ? Number::float32 : Number::float64;
  }

  std::optional<std::size_t> find(std::optional<std::uint64_t> number) const {
    return number ? draft_.find(*number) : std::nullopt;
  }

  static constexpr const char *cycle_time = "GenMsgCycleTime", *frame_format = "VFrameFormat";

  Scanner scan_;
  std::string name_;
  Draft draft_;
  int line_ = 1;             ///< Line of the statement's beginning.
  bool ignored_ = false;     ///< The signals that follow belong to no message.
  bool in_message_ = false;  ///< The statement before was a message, or a signal of one.
  Error error_;
};

}  // namespace

const Message* find_message(const Database& database, std::string_view name) {
  const auto found = std::ranges::find(database.messages, name, &Message::name);
  return found == database.messages.end() ? nullptr : &*found;
}

const Signal* find_signal(const Message& message, std::string_view name) {
  const auto found = std::ranges::find(message.signals, name, &Signal::name);
  return found == message.signals.end() ? nullptr : &*found;
}

std::optional<Error> notice_of(const Database& database) {
  if (database.unread.empty()) return std::nullopt;
  const Error& first = database.unread.front().why;
  if (database.unread.size() == 1) return Error{"a message is not read: " + first.what, first.where, first.remedy};
  return Error{fmt::format("{} messages are not read; of the first, {}", database.unread.size(), first.what),
               first.where, first.remedy};
}

Expected<Database> read_dbc(std::string_view text, std::string_view name) {
  if (text.size() > largest_file)
    return failure("the file is larger than 8 MB", std::string(name), "name a file with the messages that are used");
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return Reader(text, name).read();
}

}  // namespace septet::car_io::dbc
