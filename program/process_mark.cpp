#include "program/process_mark.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace septet::program {
namespace {

constexpr std::size_t longest_machine = 1 << 16;

/// This start of the system, and its process namespace: a container numbers its own.
std::string own_machine() {
  std::string boot;
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::getline(file, boot);
  std::error_code error;
  const auto space = std::filesystem::read_symlink("/proc/self/ns/pid", error);
  return boot.empty() || error ? "" : boot + " " + space.string();
}

}  // namespace

ProcessMark own_process_mark() { return {own_machine(), ::getpid()}; }

void put_process(ByteWriter& writer, const ProcessMark& process) {
  writer.put_string(process.machine);
  writer.put(static_cast<std::uint32_t>(process.number));
}

ProcessMark get_process(ByteReader& reader) {
  ProcessMark process;
  process.machine = reader.get_string(longest_machine);
  process.number = static_cast<std::int32_t>(reader.get<std::uint32_t>());
  return process;
}

std::optional<bool> is_there(const ProcessMark& process) {
  // 0 and less would mean whole groups of processes.
  if (process.machine.empty() || process.number <= 0 || process.machine != own_machine()) return std::nullopt;
  return ::kill(process.number, 0) == 0 || errno != ESRCH;
}

}  // namespace septet::program
