#include "program/process_mark.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace septet::program {
namespace {

/// This start of the system, and whose processes are counted: a container counts its own.
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

std::optional<bool> is_there(const ProcessMark& process) {
  // 0 and less would mean whole groups of processes.
  if (process.machine.empty() || process.number <= 0 || process.machine != own_machine()) return std::nullopt;
  return ::kill(process.number, 0) == 0 || errno != ESRCH;
}

}  // namespace septet::program
