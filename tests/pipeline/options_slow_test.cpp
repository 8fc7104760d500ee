/// What the programs say of themselves.

#include <cstdio>

#include "car-io/driving_keys.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

/// Standard output of a command that succeeds.
std::string output_of(const std::string& command) {
  FILE* pipe = ::popen(fmt::format("SEPTET_DATA={} {}/{} 2>&1", SEPTET_SOURCE_DIR, SEPTET_BINARY_DIR, command).c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) output += buffer;
  INFO(output);
  CHECK(::pclose(pipe) == 0);
  return output;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("the help of a drive has the keys and every default") {
  const std::string help = output_of("septet drive --help");
  for (const auto& key : car_io::driving_keys()) CHECK(has(help, key.does));
  for (const char* words : {"--rig TEXT=desktop with a display, else seven-screens", "=out/latest", "--scenario TEXT=motorway-ambulance",
                            "--seed UINT=1", "--traffic TEXT=own", "--driver TEXT=whom the rig names"}) {
    CAPTURE(words);
    CHECK(has(help, words));
  }
  CHECK(has(output_of("septet film --help"), "--size WIDTHxHEIGHT=1280x720"));
  CHECK(has(output_of("septet-screen --help"), "--server TEXT=127.0.0.1:4750"));
}

TEST_CASE("septet list names what there is with a description each") {
  const std::string scenarios = output_of("septet list scenarios");
  CHECK(has(scenarios, "motorway-ambulance  A Volvo S80 follows an ambulance"));
  CHECK(has(scenarios, "winter-lorry        Ice slides"));
  const std::string rigs = output_of("septet list rigs");
  CHECK(has(rigs, "desktop         One window on a desktop"));
  CHECK(has(rigs, "seven-screens   Seven projection screens"));
  CHECK(has(output_of("septet list vehicles"), "volvo-s80-manual"));
  CHECK(has(output_of("septet list drivers"), "tired        Corrects late"));
}

}  // namespace septet::pipeline
