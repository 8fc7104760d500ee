#include <filesystem>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/checkout.hpp"
#include "tests/sim-server/golden_hashes/golden_hashes.hpp"

namespace septet::server {
namespace fs = std::filesystem;

TEST_CASE("every shipped scenario drives to its golden hashes with every compiler") {
  check_golden_hashes(last_fast_tick);
}

TEST_CASE("no shipped scenario is without a golden hash") {
  std::set<std::string> shipped, golden;
  for (const auto& entry : fs::directory_iterator(fs::path(source_folder()) / "scenarios"))
    if (fs::exists(entry.path() / (entry.path().filename().string() + ".xosc")))
      shipped.insert(entry.path().filename().string());
  for (const auto& [key, hashes] : read_golden().drives) golden.insert(key.scenario);
  CHECK(shipped.size() >= 4);
  CHECK(golden == shipped);
}

}  // namespace septet::server
