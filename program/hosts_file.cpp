#include "program/hosts_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"

namespace septet::program {
namespace {

constexpr std::size_t longest_name = 255, largest_bytes = 1 << 20;
constexpr const char* remedy = "write a machine's name or address a line, as: lab-pc-2 slots=4";

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool is_machine(std::string_view word) {
  const auto may_be = [](char c) {
    return is_letter_or_digit(c) || std::string_view("-._:[]%@").find(c) != std::string_view::npos;
  };
  return word.size() <= longest_name && std::ranges::all_of(word, may_be) &&
         (is_letter_or_digit(word.front()) || word.front() == '[' || word.front() == ':' || word.front() == '_');
}

bool is_setting(std::string_view word) {
  constexpr std::array names{"slots", "max_slots", "max-slots", "slots_max", "cpus", "count"};
  const auto equals = word.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string_view name = word.substr(0, equals), number = word.substr(equals + 1);
  return std::ranges::find(names, name) != names.end() && !number.empty() && number.size() <= 6 &&
         std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Expected<void> check_hosts_file(const std::filesystem::path& file) {
  const auto text = read_regular_file(file, largest_bytes);
  if (!text) return tl::unexpected(text.error());
  std::istringstream lines(*text);
  std::size_t number = 0, machines = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word;
    if (!(words >> word)) continue;
    const auto wrong = [&](const char* what) {
      return failure(fmt::format("\"{}\" is {}", printable(word, 60), what),
                     fmt::format("{}:{}", file.string(), number), remedy);
    };
    if (!is_machine(word)) return wrong("no machine's name");
    ++machines;
    while (words >> word)
      if (!is_setting(word)) return wrong("nothing that is said of a machine");
  }
  if (machines == 0) return failure("it names no machine", file.string(), remedy);
  return {};
}

}  // namespace septet::program
