#include "engine/core/printable.hpp"

#include <doctest/doctest.h>

#include "engine/core/message_limit.hpp"

namespace septet {

TEST_CASE("text from outside cannot move the cursor or begin a line") {
  CHECK(printable("ahead-2") == "ahead-2");
  CHECK(printable("Gänsefüßchen „“ 日本") == "Gänsefüßchen „“ 日本");
  CHECK(printable("a\nb\r\x1b[31mred\x7f") == "a\\x0ab\\x0d\\x1b[31mred\\x7f");
  CHECK(printable("C:\\x0a") == "C:\\\\x0a");
  CHECK(printable("\xc2\x9b[2J") == "\\xc2\\x9b[2J");           // A C1 code: the same as ESC [.
  CHECK(printable("\xe2\x80\xaetxt") == "\\xe2\\x80\\xaetxt");  // Turns the direction of writing.
  CHECK(printable("\xff\xc0\xafok\xed\xa0\x80") ==
        "\\xff\\xc0\\xafok\\xed\\xa0\\x80");  // No UTF-8, too long a form, a surrogate.
  CHECK(printable("\xf0\x9f") == "\\xf0\\x9f");
  CHECK(printable(std::string_view("\0", 1)) == "\\x00");
}

TEST_CASE("text from outside is cut at a whole character") {
  CHECK(printable("aäää", 5) == "aää…");
  CHECK(printable(std::string(1000, '\n'), 12) == "\\x0a\\x0a\\x0a…");
}

TEST_CASE("characters are counted where all of them can be printed") {
  CHECK(printable_characters("") == 0);
  CHECK(printable_characters("Müller \\ 7") == 10);
  for (const std::string_view text : {"a\nb", "\x1b[31m", "\x7f", "\xc2\x9b", "\xe2\x80\xae", "\xff"})
    CHECK_FALSE(printable_characters(text).has_value());
}

TEST_CASE("one source says ten things at once and then one a second and what was left out is counted") {
  MessageLimit limit;
  int said = 0;
  for (int i = 0; i < 100; ++i) said += limit.take("text", 5.0).has_value();
  CHECK(said == 10);
  CHECK_FALSE(limit.take("text", 5.9).has_value());
  CHECK(limit.take("text", 6.1) == "text (91 more of its messages were left out)");
  CHECK_FALSE(limit.take("text", 6.2).has_value());
}

}  // namespace septet
