#include "car-io/pid/pid_node.hpp"

#include <cstddef>
#include <fstream>
#include <ios>
#include <span>
#include <system_error>
#include <utility>

#include "car-io/pid/hid_fields.hpp"
#include "engine/core/bytes.hpp"

namespace septet::car_io {

std::optional<PidNode> find_pid_node(const std::string& event, const std::filesystem::path& sys,
                                     const std::filesystem::path& dev) {
  const auto hid = sys / "class/input" / event / "device/device";
  std::error_code none;
  const std::filesystem::directory_iterator nodes(hid / "hidraw", none);
  if (none || nodes == std::filesystem::directory_iterator()) return std::nullopt;
  std::ifstream file(hid / "report_descriptor", std::ios::binary);
  Bytes descriptor(most_descriptor_bytes + 1);
  file.read(reinterpret_cast<char*>(descriptor.data()), static_cast<std::streamsize>(descriptor.size()));
  const auto fields = read_hid_fields(std::span(descriptor).first(static_cast<std::size_t>(file.gcount())));
  if (!fields) return std::nullopt;
  auto reports = find_pid_reports(*fields);
  if (!reports) return std::nullopt;
  return PidNode{(dev / nodes->path().filename()).string(), std::move(*reports)};
}

}  // namespace septet::car_io
