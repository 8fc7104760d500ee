#include "car-io/can/dbc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "car-io/can/dbc_scanner.hpp"
#include "engine/core/printable.hpp"

namespace septet::car_io::dbc {
namespace {

constexpr std::size_t largest_file = 8u << 20, most_messages = 10'000, most_signals = 1024;
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

/// True if all bits of the signal lie in its message. Motorola's sit in rows from bit 7 down, byte after byte.
bool fits(const Signal& signal, std::uint8_t bytes) {
  const int begin =
      signal.order == ByteOrder::intel ? signal.start_bit : signal.start_bit / 8 * 8 + 7 - signal.start_bit % 8;
  return begin + signal.bits <= 8 * bytes;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : scan_(text), name_(name) {}

  Expected<Database> read() {
    while (error_.what.empty() && !scan_.at_end()) statement();
    if (error_.what.empty()) finish();
    if (!error_.what.empty()) return tl::unexpected(std::move(error_));
    return std::move(database_);
  }

 private:
  void refuse(std::string what, std::string remedy = "correct it, or export the file again") {
    if (error_.what.empty()) error_ = {std::move(what), fmt::format("{}:{}", name_, line_), std::move(remedy)};
  }

  void statement() {
    line_ = scan_.line();
    if (scan_.peek() == '/') return scan_.skip_line();  // A person's remark; the format itself has CM_.
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
      if (!follows_message && !database_.messages.empty()) lose_signals();
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

  /// Past its `;`; where that is missing, up to the line that begins another statement, or to the end.
  void end_statement() {
    for (int line = line_; !scan_.take(';'); line = scan_.line()) {
      if (scan_.at_end()) return;
      const auto word = scan_.peek_identifier();
      if (scan_.line() > line && word && is_statement(*word)) return;
      if (!scan_.skip_word()) return refuse("a text in quotes has no end", "end it with \"");
    }
  }

  std::optional<std::string_view> take_name_in_line() {
    return !scan_.at_end() && scan_.line() == line_ ? scan_.take_name() : std::nullopt;
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
    if (Message* lost = add_message(name))
      leave_unread(database_.messages.size() - 1,
                   fmt::format("the line of the message {} does not begin with BO_", lost->name));
    skip_rest_of_line();
  }

  /// Signals behind a statement that is no message: what it was before a damage is unknown.
  void lose_signals() {
    ignored_ = false;
    if (add_message({})) leave_unread(database_.messages.size() - 1, "a SG_ stands behind no BO_");
  }

  /// A line among a message's that begins no statement nor, but for its first word, a message: a part of that message,
  /// most likely. Signals that follow belong to it for certain no more.
  void leave_line_unread() {
    if (!ignored_)
      leave_unread(database_.messages.size() - 1,
                   fmt::format("a line of {}, or after it, begins no statement", database_.messages.back().name));
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

  /// A message with a fault, or that is no frame of ours, refuses the file only for a rig that names it.
  void leave_unread(std::size_t message, std::string what,
                    std::string remedy = "correct it, or export the file again") {
    unread_.try_emplace(message, Error{std::move(what), fmt::format("{}:{}", name_, line_), std::move(remedy)});
  }
  /// Leaves both unread, since the intended one is unknown.
  void leave_both_unread(std::size_t one, std::size_t other, const std::string& what) {
    leave_unread(one, what, "keep one of them");
    leave_unread(other, what, "keep one of them");
  }
  bool is_unread(std::size_t message) const { return unread_.contains(message); }

  /// None, and the file is refused, where it has too many.
  Message* add_message(std::string_view name) {
    if (database_.messages.size() == most_messages) {
      refuse(fmt::format("the file has more than {} messages", most_messages), "split it");
      return nullptr;
    }
    Message& message = database_.messages.emplace_back();
    message.name = name;
    return &message;
  }

  static constexpr const char* form_of_message = "a BO_ is not of the form BO_ ID NAME: BYTES SENDER";

  void message() {
    const auto id = scan_.take_unsigned();
    const auto name = take_name_in_line();
    const bool has_colon = name && scan_.take(':');
    const auto bytes = has_colon ? scan_.take_unsigned() : std::nullopt;
    ignored_ = id && std::ranges::find(independent_signals, *id) != independent_signals.end();
    if (ignored_) return skip_rest_of_line();
    const std::size_t place = database_.messages.size();
    Message* const added = add_message(name.value_or(std::string_view()));
    if (!added) return;
    Message& message = *added;
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
    if (const auto [other, is_new] = names_.emplace(message.name, place); !is_new)
      leave_both_unread(place, other->second, fmt::format("two messages are called {}", message.name));
    if (const auto [other, is_new] = numbers_.emplace(*id, place); !is_new)
      leave_both_unread(place, other->second, fmt::format("two messages have the identifier {}", *id));
  }

  void signal() {
    if (database_.messages.empty() && !ignored_) return refuse("a SG_ stands before the first BO_");
    Signal signal;
    const auto fault = read_signal(signal);
    if (ignored_) return;
    Message& message = database_.messages.back();
    const std::size_t place = database_.messages.size() - 1;
    if (message.signals.size() == most_signals)
      return leave_unread(place, fmt::format("{} has more than {} signals", message.name, most_signals));
    if (fault)
      leave_unread(place, *fault);
    else if (is_nested_ ||
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

  /// The fault, if it has one; the rest of its line is skipped then.
  std::optional<std::string> read_signal(Signal& signal) {
    const auto faulty = [&](std::string what) {
      skip_rest_of_line();
      return std::optional(std::move(what));
    };
    const auto name = take_name_in_line();
    if (!name) return faulty("a SG_ has no name");
    signal.name = *name;
    const auto multiplex = scan_.take_identifier();
    is_nested_ = multiplex && multiplex->size() > 2 && multiplex->ends_with('M');
    if (is_nested_) signal.selects = true;
    if (multiplex && !read_multiplex(is_nested_ ? multiplex->substr(0, multiplex->size() - 1) : *multiplex, signal))
      return faulty(fmt::format("{} is multiplexed by {}, which is neither M nor mNUMBER", *name, *multiplex));
    if (!read_place(signal) || !read_scale(signal))
      return faulty(fmt::format("the signal {} is not of the form {}", *name, form));
    names_until_statement();  // Its receivers.
    return std::nullopt;
  }

  static constexpr const char* form = "SG_ NAME : START|BITS@ORDER SIGN (SCALE,OFFSET) [LOW|HIGH] \"UNIT\" RECEIVERS";

  static constexpr const char* simple =
      "use a message that one signal M selects by mNUMBER; extended multiplexing is not read";

  static bool read_multiplex(std::string_view text, Signal& signal) {
    if (text == "M") return signal.selects = true;
    Scanner number(text.substr(1));
    signal.selected_by = number.take_unsigned();
    return text.starts_with('m') && signal.selected_by && number.at_end();
  }

  bool read_place(Signal& signal) {
    if (!scan_.take(':')) return false;
    const auto start = scan_.take_unsigned();
    if (!start || *start > 65535 || !scan_.take('|')) return false;
    const auto bits = scan_.take_unsigned();
    if (!bits || *bits < 1 || *bits > 64 || !scan_.take('@')) return false;
    const auto order = scan_.take_unsigned();
    if (!order || *order > 1) return false;
    signal.start_bit = static_cast<std::uint16_t>(*start);
    signal.bits = static_cast<std::uint8_t>(*bits);
    signal.order = *order == 1 ? ByteOrder::intel : ByteOrder::motorola;
    if (scan_.take('-'))
      signal.number = Number::signed_whole;
    else if (!scan_.take('+'))
      return false;
    return true;
  }

  bool read_scale(Signal& signal) {
    const auto pair = [&](char open, char between, char close, double& first, double& second) {
      if (!scan_.take(open)) return false;
      const auto a = scan_.take_number();
      if (!a || !scan_.take(between)) return false;
      const auto b = scan_.take_number();
      if (!b || !scan_.take(close)) return false;
      first = *a;
      second = *b;
      return true;
    };
    if (!pair('(', ',', ')', signal.scale, signal.offset) || !pair('[', '|', ']', signal.low, signal.high))
      return false;
    const Scanner before = scan_;
    auto unit = scan_.take_string();
    if (!unit || scan_.line() != before.line()) {  // An end that is missing is not looked for in other statements.
      scan_ = before;
      return false;
    }
    signal.unit = std::move(*unit);
    return true;
  }

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
      const auto found = id ? numbers_.find(*id) : numbers_.end();
      if (found == numbers_.end()) return end_statement();
      if (!value)
        leave_unread(found->second, fmt::format("BA_ \"{}\" BO_ {} is not followed by a number", *name, *id));
      else if (*name == frame_format)
        formats_[found->second] = FrameFormat{*value, name_of_value};
      else
        set_period(found->second, *value);
    }
    end_statement();
  }

  /// Frame format as in the file: an index, or a name in quotes.
  struct FrameFormat {
    double index = 0.0;
    std::optional<std::string> name;
  };

  bool is_fd(const FrameFormat& format) const {
    if (format.name) return format.name->ends_with("_FD");
    for (std::size_t i = 0; i < frame_formats_.size(); ++i)
      if (format.index == static_cast<double>(i)) return frame_formats_[i].ends_with("_FD");
    constexpr double standard_fd = 14.0, extended_fd = 15.0;
    return format.index == standard_fd || format.index == extended_fd;
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
        frame_formats_.clear();
        for (auto value = scan_.take_string(); value && frame_formats_.size() < most_formats;) {
          frame_formats_.push_back(std::move(*value));
          value = scan_.take(',') ? scan_.take_string() : std::nullopt;
        }
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
    if (const auto found = id ? numbers_.find(*id) : numbers_.end(); found != numbers_.end()) {
      const Message& message = database_.messages[found->second];
      if (!name || !selecting || !first || !has_range || !last) {
        leave_unread(found->second, "a SG_MUL_VAL_ is not of the form SG_MUL_VAL_ ID SIGNAL SELECTING FIRST-LAST;");
        return end_statement();
      }
      const Signal *signal = find_signal(message, *name), *by = find_signal(message, *selecting);
      if (signal && (scan_.peek() == ',' || *first != *last || signal->selected_by != first || !by || !by->selects))
        leave_unread(found->second, fmt::format("{} of {} is selected by more than one value", *name, message.name),
                     simple);
    }
    end_statement();
  }

  void set_period(std::size_t place, double value) {
    constexpr double longest_ms = 600'000.0;
    Message& message = database_.messages[place];
    if (value < 0.0 || value > longest_ms)
      leave_unread(place, fmt::format("{} is sent every {} ms", message.name, value), "use 0 to 600000 ms");
    else if (value > 0.0)
      message.period_s = value / 1000.0;
    else
      periodless_.insert(message.name);
  }

  void default_of_attribute() {
    const auto name = scan_.take_string();
    if (!name) return refuse("BA_DEF_DEF_ names no attribute");
    if (*name == frame_format) {
      default_format_ = FrameFormat{0.0, scan_.take_string()};
      if (!default_format_->name) default_format_->index = scan_.take_number().value_or(0.0);
    }
    if (*name == cycle_time) default_period_ms_ = scan_.take_number().value_or(0.0);
    end_statement();
  }

  /// SIG_VALTYPE_ ID SIGNAL : 1 or 2;
  void value_type() {
    const auto id = scan_.take_unsigned();
    const auto name = scan_.take_name();
    scan_.take(':');
    const auto type = scan_.take_unsigned();
    end_statement();
    const auto message = id ? numbers_.find(*id) : numbers_.end();
    if (message == numbers_.end() || type == 0u || is_unread(message->second)) return;
    if (!name || !type || *type > 2)
      return leave_unread(message->second, "a SIG_VALTYPE_ is not of the form SIG_VALTYPE_ ID SIGNAL : 0, 1 or 2;");
    auto& signals = database_.messages[message->second].signals;
    const auto signal = std::ranges::find(signals, *name, &Signal::name);
    if (signal == signals.end()) return;
    if (signal->bits != 32 * *type)
      return leave_unread(message->second, fmt::format("{} is a float of {} bits", *name, signal->bits),
                          "use 32 or 64 bits");
    signal->number = *type == 1 ? Number::float32 : Number::float64;
  }

  void finish() {
    for (std::size_t i = 0; i < database_.messages.size(); ++i) {
      const auto own = formats_.find(i);
      if (own != formats_.end() || default_format_)
        database_.messages[i].is_fd |= is_fd(own != formats_.end() ? own->second : *default_format_);
    }
    set_default_period();
    std::vector<Message> read;
    for (std::size_t i = 0; i < database_.messages.size(); ++i) {
      Message& message = database_.messages[i];
      const auto unread = unread_.find(i);
      if (unread == unread_.end()) {
        read.push_back(std::move(message));
        continue;
      }
      database_.unread.push_back({message.name, {}, std::move(unread->second)});
      for (const Signal& signal : message.signals) database_.unread.back().signals.push_back(signal.name);
    }
    database_.messages = std::move(read);
  }

  void set_default_period() {
    if (!(default_period_ms_ > 0.0 && default_period_ms_ <= 600'000.0)) return;
    for (Message& message : database_.messages)
      if (!message.period_s && !periodless_.contains(message.name)) message.period_s = default_period_ms_ / 1000.0;
  }

  static constexpr const char *cycle_time = "GenMsgCycleTime", *frame_format = "VFrameFormat";

  Scanner scan_;
  std::string name_;
  Database database_;
  std::map<std::uint64_t, std::size_t> numbers_;  ///< Messages by their identifier as the file writes it.
  std::map<std::string, std::size_t> names_;
  std::set<std::string> periodless_;
  std::map<std::size_t, Error> unread_;  ///< Reason, by the message's place in the database, likewise the next.
  std::map<std::size_t, FrameFormat> formats_;
  std::vector<std::string> frame_formats_;  ///< The names of VFrameFormat's values, where the file lists them.
  std::optional<FrameFormat> default_format_;
  int line_ = 1;             ///< Line of the statement's beginning.
  bool ignored_ = false;     ///< The signals that follow belong to no message.
  bool in_message_ = false;  ///< The statement before was a message, or a signal of one.
  bool is_nested_ = false;   ///< The signal that was read is selected and selects.
  double default_period_ms_ = 0.0;
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
