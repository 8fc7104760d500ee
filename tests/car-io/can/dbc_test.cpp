#include "car-io/can/dbc.hpp"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "car-io/can/signal_codec.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::car_io::dbc {
namespace {

constexpr const char* head = "VERSION \"\"\nNS_ :\nBS_:\nBU_: A\n";

Database reference() {
  auto database = read_dbc(shipped_text("tests/car-io/can/reference.dbc"), "reference.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  return *database;
}

std::vector<std::byte> bytes_of(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

Error refusal(const std::string& text) {
  const auto read = read_dbc(text, "bad.dbc");
  REQUIRE_FALSE(read.has_value());
  return read.error();
}

}  // namespace

TEST_CASE("frames that cantools made decode to its values and those encode to the same frames") {
  const Database database = reference();
  std::istringstream lines(shipped_text("tests/car-io/can/reference.txt"));
  int frames = 0;
  for (std::string line; std::getline(lines, line); ++frames) {
    CAPTURE(line);
    std::istringstream words(line);
    std::string name, hex, value;
    words >> name >> hex;
    const Message* message = find_message(database, name);
    REQUIRE(message);
    const auto data = bytes_of(hex);
    REQUIRE(data.size() == message->bytes);
    std::vector<std::byte> encoded(data.size());
    std::size_t values = 0;
    for (; words >> value; ++values) {
      const auto equals = value.find('=');
      const Signal* signal = find_signal(*message, value.substr(0, equals));
      REQUIRE(signal);
      const double expected = std::stod(value.substr(equals + 1));
      const auto decoded = decode(*message, *signal, data);
      REQUIRE(decoded.has_value());
      CHECK(*decoded == doctest::Approx(expected).epsilon(1e-12).scale(1.0));
      encode(*signal, expected, encoded);
    }
    CHECK(encoded == data);
    std::size_t carried = 0;
    for (const Signal& signal : message->signals) carried += decode(*message, signal, data).has_value() ? 1 : 0;
    CHECK(carried == values);
  }
  CHECK(frames == 84);
}

TEST_CASE("a DBC file says how often messages are sent which are long and which are extended") {
  const Database database = reference();
  CHECK(database.messages.size() == 7);
  CHECK(find_message(database, "INTEL")->period_s == 0.01);
  CHECK(find_message(database, "MOTOROLA")->period_s == 0.05);
  CHECK_FALSE(find_message(database, "INTEL")->is_fd);
  CHECK(find_message(database, "WIDE")->is_fd);
  const Message* extended = find_message(database, "LONG");
  CHECK((extended->is_extended && extended->is_fd && extended->id == (2566844926u & 0x1FFFFFFFu)));
  CHECK(find_signal(*find_message(database, "MOTOROLA"), "d16")->unit == "\"quoted\"");
  CHECK_FALSE(overlap(*find_message(database, "MULTIPLEXED")).has_value());
}

TEST_CASE("an identifier that does not fit into eleven bits is one of twenty-nine, with its flag or without") {
  const auto database = read_dbc("BS_:\nBO_ 318291879 A: 8 X\nBO_ 2465775527 B: 8 X\nBO_ 2047 C: 8 X\n", "foreign.dbc");
  REQUIRE(database.has_value());
  CHECK((database->messages[0].is_extended && database->messages[0].id == 318291879u));
  CHECK((database->messages[1].is_extended && database->messages[1].id == 318291879u));
  CHECK_FALSE(database->messages[2].is_extended);
}

TEST_CASE("values that the bits cannot hold are taken to the nearest that they can") {
  Signal signal{.name = "s", .start_bit = 0, .bits = 8};
  std::vector<std::byte> data(8);
  const auto raw_for = [&](double value) {
    encode(signal, value, data);
    return std::to_integer<int>(data[0]);
  };
  CHECK(raw_for(300.0) == 255);
  CHECK(raw_for(-1.0) == 0);
  CHECK(raw_for(1e300) == 255);
  CHECK(raw_for(std::nan("")) == 0);
  CHECK(raw_for(2.5) == 2);
  signal.number = Number::signed_whole;
  CHECK(raw_for(300.0) == 127);
  CHECK(raw_for(-300.0) == 128);
  signal.low = -10.0;
  signal.high = 10.0;
  CHECK(raw_for(300.0) == 10);
  signal = {.name = "s", .start_bit = 0, .bits = 64};
  const Message message{.signals = {signal}};
  encode(signal, 1e30, data);
  CHECK(decode(message, signal, data) == 18446744073709551616.0);
  signal.number = Number::signed_whole;
  encode(signal, -1e30, data);
  CHECK(decode(message, signal, data) == -9223372036854775808.0);
}

TEST_CASE("data too short for a signal hold nothing for it and take nothing from it") {
  const Signal signal{.name = "s", .start_bit = 12, .bits = 8};
  const Message message{.signals = {signal}};
  std::vector<std::byte> data(2, std::byte{0xFF});
  CHECK_FALSE(decode(message, signal, data).has_value());
  encode(signal, 0.0, data);
  CHECK(data == std::vector<std::byte>(2, std::byte{0xFF}));
}

TEST_CASE("a file that is no DBC file is refused with its line") {
  const std::pair<const char*, std::string_view> files[] = {
      {"\nSG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n", "a SG_ stands before the first BO_"},
      {"VAL_ 7 s;\nHello;\n", "\"Hello\" begins no statement of a DBC file"},
      {"\n\x01\n", "a statement begins with"},
  };
  for (const auto& file : files) {
    CAPTURE(std::string(file.first));
    const Error error = refusal(std::string(head) + file.first);
    CHECK_MESSAGE(error.what.starts_with(file.second), error.what);
    CHECK(error.where == "bad.dbc:6");
  }
  CHECK(refusal("VERSION \"\"\nNS_ :\nBS_:\nBU_: A\nCM_ \"never ended;\n\n").what == "a text in quotes has no end");
}

TEST_CASE("a message with a fault is left unread with its line, and every other one is read") {
  const std::pair<const char*, std::string_view> faults[] = {
      {"BO_ 7 A: 8 X\n SG_ s : 60|8@1+ (1,0) [0|0] \"\" X\n", "s reaches beyond the 8 bytes of A"},
      {"BO_ 7 A: 8 X\n SG_ s : 60|14@0+ (1,0) [0|0] \"\" X\n", "s reaches beyond the 8 bytes of A"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|65@1+ (1,0) [0|0] \"\" X\n", "the signal s is not of the form"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|0@1+ (1,0) [0|0] \"\" X\n", "the signal s is not of the form"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (0,0) [0|0] \"\" X\n", "the scale of s is 0"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1e999,0) [0|0] \"\" X\n", "the signal s is not of the form"},
      {"BO_ 7 A: 8 X\n SG_ s m : 0|8@1+ (1,0) [0|0] \"\" X\n", "s is multiplexed by m"},
      {"BO_ 7 A: 8 X\n SG_ : 0|8@1+ (1,0) [0|0] \"\" X\n", "a SG_ has no name"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|8\n", "the signal s is not of the form"},
      {"\nBO_ 536870912 A: 8 X\n", "536870912 is no CAN identifier"},
      {"\nBO_ 18446744073709551615 A: 8 X\n", "18446744073709551615 is no CAN identifier"},
      {"\nBO_ 7 A\n", "a BO_ is not of the form"},
      {"\nBO_\n", "a BO_ is not of the form"},
      {"BO_ 7 A: 8 X\nBO_ 7 B: 8 X\n", "two messages have the identifier 7"},
      {"BO_ 7 A: 8 X\nBO_ 8 A: 8 X\n", "two messages are called A"},
      {"BO_ 7 A: 8 X\nBA_ \"GenMsgCycleTime\" BO_ 7 -1;\n", "A is sent every -1 ms"},
      {"BO_ 7 A: 8 X\nBA_ \"GenMsgCycleTime\" BO_ 7 3600000;\n", "A is sent every 3600000 ms"},
      {"BO_ 7 A: 8 X\nBA_ \"GenMsgCycleTime\" BO_ 7 often;\n",
       "BA_ \"GenMsgCycleTime\" BO_ 7 is not followed by a number"},
      {"BO_ 7 A: 8 X\nHello;\n", "a line of A, or after it, begins no statement"},
      {"BO_ 7 A: 8 X\n SG s : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ t : 0|8@1+ (1,0) [0|0] \"\" X\n",
       "a line of A, or after it, begins no statement"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"\"\" X\n", "a line of A, or after it, begins no statement"},
      {"BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"km X\n", "the signal s is not of the form"},
      {"\nBO_ 7 A: 8.5 X\n", "a BO_ is not of the form"},
      {"\nBO_ 7 A: 8 \"X\n", "a BO_ is not of the form"},
  };
  constexpr const char* sound = "BO_ 100 SOUND: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n";
  for (const auto& fault : faults) {
    CAPTURE(std::string(fault.first));
    const auto database = read_dbc(std::string(head) + fault.first + sound, "bad.dbc");
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    REQUIRE(database->messages.size() == 1);
    CHECK(database->messages[0].name == "SOUND");
    CHECK(database->messages[0].signals.size() == 1);
    REQUIRE(database->unread.size() >= 1);
    for (const UnreadMessage& unread : database->unread) {
      CHECK_MESSAGE(unread.why.what.starts_with(fault.second), unread.why.what);
      CHECK(unread.why.where == "bad.dbc:6");
    }
  }
}

TEST_CASE("a message whose BO_ is damaged is left unread with its signals and the one before is read") {
  const std::string before = "BO_ 7 A: 8 X\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" X\n";
  const std::string signals = " SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ t : 8|8@1+ (1,0) [0|0] \"\" X\n";
  const std::string behind = "BO_ 9 C: 8 X\n SG_ c : 0|8@1+ (1,0) [0|0] \"\" X\nBA_ \"GenMsgCycleTime\" BO_ 8 20;\n";
  for (const char* damaged :
       {"BX_ 8 B: 8 ECU", "BO 8 B: 8 ECU", "BO_8 B: 8 ECU", "B\x01_ 8 B: 8 ECU", "# 8 B : 8", "8 B: 8 ECU"}) {
    CAPTURE(std::string(damaged));
    const auto database = read_dbc(head + before + damaged + "\n" + signals + behind, "bad.dbc");
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    REQUIRE(database->messages.size() == 2);
    CHECK((database->messages[0].name == "A" && database->messages[0].signals.size() == 1));
    CHECK((database->messages[1].name == "C" && database->messages[1].signals.size() == 1));
    REQUIRE(database->unread.size() == 1);
    CHECK(database->unread[0].name == "B");
    CHECK(database->unread[0].signals == std::vector<std::string>{"s", "t"});
    const auto notice = notice_of(*database);
    REQUIRE(notice.has_value());
    CHECK(notice->what == "a message is not read: the line of the message B does not begin with BO_");
    CHECK(notice->where == "bad.dbc:7");
  }
  const auto first = read_dbc(head + ("BX_ 8 B: 8 ECU\n" + signals) + behind, "bad.dbc");
  REQUIRE_MESSAGE(first.has_value(), why_not(first));
  CHECK((first->messages.size() == 1 && first->messages[0].name == "C"));
  CHECK((first->unread.size() == 1 && first->unread[0].why.where == "bad.dbc:5"));
}

TEST_CASE("signals behind another statement than a message are no message's") {
  for (const char* other : {"BU_ 8 B: 8 ECU", "EV_ 8 B: 8 ECU", "VAL_ 8 B: 8 ECU"}) {
    CAPTURE(std::string(other));
    const auto database = read_dbc(std::string(head) + "BO_ 7 A: 8 X\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" X\n" + other +
                                       "\n SG_ s : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ t : 16|8@1+ (1,0) [0|0] \"\" X\n",
                                   "bad.dbc");
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    REQUIRE(database->messages.size() == 1);
    CHECK(database->messages[0].signals.size() == 1);
    REQUIRE(database->unread.size() == 1);
    CHECK(database->unread[0].why.what == "a SG_ stands behind no BO_");
    CHECK(database->unread[0].why.where == "bad.dbc:8");
    CHECK(database->unread[0].signals == std::vector<std::string>{"s", "t"});
  }
}

TEST_CASE("a message of more signals than any frame carries is left unread and the others are read") {
  std::string many = "BO_ 7 A: 8 X\n";
  for (int i = 0; i < 1100; ++i) many += fmt::format(" SG_ s{} m{} : 8|8@1+ (1,0) [0|0] \"\" X\n", i, i);
  const auto database = read_dbc(head + many + "BO_ 8 B: 8 X\n", "many.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  REQUIRE(database->messages.size() == 1);
  CHECK(database->messages[0].name == "B");
  REQUIRE(database->unread.size() == 1);
  CHECK(database->unread[0].why.what == "A has more than 1024 signals");
}

TEST_CASE("nodes with signs of other alphabets and hyphens are passed over") {
  const auto database = read_dbc(
      "VERSION \"\"\nBS_:\nBU_: Gerät Rear-ECU\nBO_ 7 A: 8 Gerät\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" Gerät, Rear-ECU;\n"
      " SG_ t : 8|8@1+ (1,0) [0|0] \"\" Rear-ECU // a remark: BO_\nBO_ 8 B: 8 Rear-ECU\n",
      "nodes.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  CHECK(database->unread.empty());
  REQUIRE(database->messages.size() == 2);
  CHECK(database->messages[0].signals.size() == 2);
}

TEST_CASE("what makers' files do with names, senders, remarks and ends of statements is read") {
  const auto database = read_dbc(std::string(head) +
                                     "// a remark\n"
                                     "BO_ 1073741824 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n"
                                     " SG_ spare : 0|8@1+ (1,0) [0|0] \"\" Vector__XXX\n"
                                     "BO_ 2001 2017_5: 8 1ECU\n"
                                     " SG_ 0_COUNTER : 35|4@0+ (1,0) [0|15] \"\" 1ECU, 2ECU\n"
                                     "BO_ 2009 ALONE: 8\n"
                                     " SG_ a : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                     "VAL_TABLE_ T 1 \"a\"\n 2 \"b; BO_\";\n"
                                     "BA_ \"GenMsgCycleTime\" BO_ 2009 50\n"
                                     "VAL_ 2009 a 1 \"a\" 0 \"b\"",
                                 "makers.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  CHECK(database->unread.empty());
  REQUIRE(database->messages.size() == 2);
  CHECK(database->messages[0].name == "2017_5");
  REQUIRE(database->messages[0].signals.size() == 1);
  CHECK(database->messages[0].signals[0].name == "0_COUNTER");
  CHECK(database->messages[1].signals.size() == 1);
  CHECK(database->messages[1].period_s == 0.05);
}

TEST_CASE("signals behind a message that a remark takes out are given to no other message") {
  const auto with = [](const std::string& remark) {
    return read_dbc(std::string(head) + "BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n\n" + remark +
                        " SG_ t : 8|8@1+ (1,0) [0|0] \"\" X\nBO_ 9 C: 8 X\n",
                    "out.dbc");
  };
  for (const char* remark : {"// BO_ 8 B: 8 X\n", "//BO_ 8 B: 8 X\n", " // was: BO_ 8 B : 8 X\n"}) {
    CAPTURE(std::string(remark));
    const auto database = with(remark);
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    REQUIRE(database->messages.size() == 2);
    CHECK(database->messages[0].signals.size() == 1);
    CHECK(database->messages[1].name == "C");
    REQUIRE(database->unread.size() == 1);
    CHECK(database->unread[0].why.what == "a SG_ stands behind no BO_");
  }
  // An earlier form of the same message, or words about it, take nothing out.
  for (const char* remark : {"// BO_ 7 A: 6 X\n", "// the BO_ above\n"}) {
    CAPTURE(std::string(remark));
    const auto database = with(remark);
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    CHECK(database->unread.empty());
    CHECK(database->messages[0].signals.size() == 2);
  }
}

TEST_CASE("a statement without its semicolon ends before the next line's statement") {
  for (const char* open :
       {"BA_ \"GenMsgCycleTime\" BO_ 7 50", "CM_ BO_ 7 \"a text\"", "BA_DEF_DEF_ \"VFrameFormat\" 1",
        "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"a\",\"b\"", "VAL_ 7 s 1 \"a\"", "SIG_VALTYPE_ 7 s : 0"}) {
    CAPTURE(std::string(open));
    const auto database =
        read_dbc(std::string(head) + "BO_ 7 A: 8 X\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n" + open +
                     "\nBO_ 8 B: 8 X\n SG_ t : 0|8@1+ (1,0) [0|0] \"\" X\nBA_ \"GenMsgCycleTime\" BO_ 8 20;\n",
                 "open.dbc");
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    CHECK(database->unread.empty());
    REQUIRE(database->messages.size() == 2);
    CHECK(database->messages[1].signals.size() == 1);
    CHECK(database->messages[1].period_s == 0.02);
  }
}

TEST_CASE("CAN FD is what the file's own list of frame formats calls so, by index, by name and by default") {
  const std::string list =
      "BO_ 7 A: 8 X\nBO_ 8 B: 8 X\nBA_DEF_ BO_ \"VFrameFormat\" ENUM "
      "\"StandardCAN\",\"ExtendedCAN\",\"StandardCAN_FD\",\"ExtendedCAN_FD\";\n";
  const auto is_fd = [](const std::string& text) {
    const auto database = read_dbc(head + text, "fd.dbc");
    REQUIRE_MESSAGE(database.has_value(), why_not(database));
    return std::pair(database->messages[0].is_fd, database->messages[1].is_fd);
  };
  CHECK(is_fd(list) == std::pair(false, false));
  CHECK(is_fd(list + "BA_ \"VFrameFormat\" BO_ 7 2;\nBA_ \"VFrameFormat\" BO_ 8 1;\n") == std::pair(true, false));
  CHECK(is_fd(list + "BA_ \"VFrameFormat\" BO_ 8 \"ExtendedCAN_FD\";\n") == std::pair(false, true));
  CHECK(is_fd(list + "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN_FD\";\nBA_ \"VFrameFormat\" BO_ 7 0;\n") ==
        std::pair(false, true));
  CHECK(is_fd("BO_ 7 A: 8 X\nBO_ 8 B: 8 X\nBA_ \"VFrameFormat\" BO_ 7 14;\nBA_ \"VFrameFormat\" BO_ 8 2;\n") ==
        std::pair(true, false));
}

TEST_CASE("a byte-order mark at the beginning of a file is skipped") {
  const auto database = read_dbc(
      "\xEF\xBB\xBF"
      "VERSION \"\"\nBS_:\nBO_ 7 A: 8 X\n",
      "marked.dbc");
  REQUIRE(database.has_value());
  CHECK(database->messages.size() == 1);
}

TEST_CASE("messages that no frame carries are read over with a notice, and the others are read") {
  const std::string read =
      "BO_ 7 A: 8 X\n SG_ s M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ t m3 : 8|8@1+ (1,0) [0|0] \"\" X\n";
  const std::string long_one = "BO_ 8 LONG: 1785 X\n SG_ u : 14000|256@1+ (1,0) [0|0] \"\" X\n";
  const std::string nested =
      "BO_ 9 NESTED: 8 X\n SG_ v M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ w m0M : 8|8@1+ (1,0) [0|0] \"\" X\n";
  const std::string ranges =
      "BO_ 10 RANGES: 8 X\n SG_ x M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ y m0 : 8|8@1+ (1,0) [0|0] \"\" X\n";
  const auto database = read_dbc(head + read + long_one + nested + ranges +
                                     "SG_MUL_VAL_ 7 t s 3-3;\nSG_MUL_VAL_ 9 w v 0-0;\nSG_MUL_VAL_ 10 y x 0-0, 4-5;\n",
                                 "large.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  REQUIRE(database->messages.size() == 1);
  CHECK(database->messages[0].signals.size() == 2);
  REQUIRE(database->unread.size() == 3);
  CHECK(database->unread[0].why.what == "LONG has 1785 bytes, which no frame has");
  CHECK(database->unread[0].why.where == "large.dbc:8");
  CHECK(database->unread[0].signals == std::vector<std::string>{"u"});
  CHECK(database->unread[1].why.what == "w of NESTED is one of several selecting signals");
  CHECK(database->unread[2].why.what == "y of RANGES is selected by more than one value");
  CHECK(notice_of(*database)->what == "3 messages are not read; of the first, LONG has 1785 bytes, which no frame has");
  CHECK_FALSE(notice_of(reference()).has_value());
}

TEST_CASE("signals on each other are found unless they are never in one frame") {
  Message message{.signals = {{.name = "a", .start_bit = 0, .bits = 9},
                              {.name = "b", .start_bit = 15, .bits = 8, .order = ByteOrder::motorola}}};
  const auto both = overlap(message);
  REQUIRE(both.has_value());
  CHECK((both->first->name == "a" && both->second->name == "b"));
  message.signals[0].selected_by = 1;
  message.signals[1].selected_by = 2;
  CHECK_FALSE(overlap(message).has_value());
}

}  // namespace septet::car_io::dbc
