#include <doctest/doctest.h>

#include "sim-server/server_program.hpp"

namespace septet::server {
namespace {

/// Message for a drive whose files do not exist either.
Error refusal_of(ServerOptions options) {
  options.scenario = options.rig = "no-such-file";
  const auto end = run_server(options);
  REQUIRE_FALSE(end.has_value());
  return end.error();
}

}  // namespace

TEST_CASE("a name that nobody bears is told before a file is read") {
  const Error driver = refusal_of({.driver = "nobody"}), traffic = refusal_of({.traffic = "nobody's"});
  CHECK(driver.where == "--driver");
  CHECK(driver.what.find("'nobody'") != std::string::npos);
  CHECK(driver.remedy.find("plain, novice") != std::string::npos);
  CHECK(traffic.where == "--traffic");
  CHECK(traffic.what.find("\"nobody's\"") != std::string::npos);
  CHECK(refusal_of({.driver = "plain", .traffic = "sumo"}).where == "no-such-file");
}

TEST_CASE("a participant's code is a hundred printable characters at most") {
  std::string longest;
  for (int i = 0; i < 100; ++i) longest += "ä";
  for (const std::string& code : {std::string(), std::string("P 07, Müller"), longest})
    CHECK(check_names({.participant = code}).has_value());
  for (const std::string& code : {longest + "ä", std::string("P\n7"), std::string("\x1b[2J"), std::string("\xff")}) {
    const Error error = refusal_of({.participant = code});
    CHECK(error.where == "--participant");
    CHECK(error.what.find('\x1b') == std::string::npos);
    CHECK(error.remedy.find("100 characters") != std::string::npos);
  }
}

}  // namespace septet::server
