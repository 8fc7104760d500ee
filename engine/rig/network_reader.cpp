#include "engine/rig/network_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/rig/sight_reader.hpp"

namespace septet::rig {
namespace {

using document::TableReader;

/// The first number of four from 0 to 255 with points between; empty otherwise.
std::optional<int> first_of_four_numbers(std::string_view text) {
  std::optional<int> first;
  int count = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++count) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    std::uint8_t number = 0;
    const auto [read_to, problem] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (problem != std::errc() || read_to != text.data() + end || end - begin > 3) return std::nullopt;
    if (count == 0) first = number;
    begin = end + 1;
  }
  return count == 4 ? first : std::nullopt;
}

/// False for an address in dotted form that is none, and for nothing at all; anything else may be a machine's name.
bool may_be_a_machine(std::string_view text) {
  return text.find_first_not_of("0123456789.") != std::string_view::npos || first_of_four_numbers(text).has_value();
}

void report_address(TableReader& reader, std::string_view full_key, const std::string& address,
                    const char* remedy = "write four numbers of 0 to 255, such as 10.7.0.3") {
  reader.report(full_key.substr(full_key.find('.') + 1), fmt::format("{} is \"{}\"", full_key, printable(address)),
                remedy);
}

}  // namespace

void check_address(TableReader& reader, std::string_view full_key, const std::string& address) {
  if (!first_of_four_numbers(address)) report_address(reader, full_key, address);
}

Network read_network(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "network", error);
  Network network;
  network.server_address = reader.get_string("server_address", network.server_address);
  network.scene_port = static_cast<std::uint16_t>(reader.get_integer("scene_port", network.scene_port, 0, 65535));
  network.tick_group = reader.get_string("tick_group", network.tick_group);
  network.tick_port = static_cast<std::uint16_t>(reader.get_integer("tick_port", network.tick_port, 0, 65535));
  network.interface_address = reader.get_string("interface_address", network.interface_address);
  if (!may_be_a_machine(network.server_address))
    report_address(reader, "network.server_address", network.server_address);
  constexpr int first_group = 224, last_group = 239;  // RFC 5771, 3.
  const auto group = first_of_four_numbers(network.tick_group);
  if (!group || *group < first_group || *group > last_group)
    report_address(reader, "network.tick_group", network.tick_group,
                   "write a multicast group, 224.0.0.0 to 239.255.255.255, such as 239.77.77.77");
  if (!network.interface_address.empty()) check_address(reader, "network.interface_address", network.interface_address);
  network.transport =
      static_cast<TickTransport>(reader.get_choice("transport", 0, {"automatic", "multicast", "unicast"}));
  network.max_payload_bytes =
      static_cast<std::uint32_t>(reader.get_integer("max_payload_bytes", network.max_payload_bytes, 512, 8900));
  network.playout_delay_ticks = reader.get_double("playout_delay_ticks", network.playout_delay_ticks, 0.0, 60.0);
  reader.finish(documented_in);
  return network;
}

}  // namespace septet::rig
