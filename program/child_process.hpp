#pragma once
/// A program started by this one: its end is noticed, its output can be read, and it does not outlive its parent.

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::program {

struct ChildOptions {
  std::string program;  ///< Path; no search through PATH.
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment;  ///< Added to this process's own.
  std::filesystem::path log;                       ///< Where its standard error goes; empty: to this process's.
  std::filesystem::path folder = {};               ///< In which it works; empty: in this process's.
};

/// How a child ended.
struct ChildExit {
  int code = 0;    ///< Exit status; −1 for one that a signal ended.
  int signal = 0;  ///< That signal, or 0.
};

/// Movable owner of one child. Destruction ends the child (SIGTERM, then SIGKILL after a second). One thread.
class ChildProcess {
 public:
  static Expected<ChildProcess> start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  int process_id() const { return process_id_; }
  /// Whether and how it has ended; does not wait.
  std::optional<ChildExit> poll();
  /// The next line of its standard output, or nothing after the time-out or at the end of the output.
  std::optional<std::string> read_line(std::chrono::milliseconds timeout);
  void send_signal(int signal);
  /// SIGTERM, a second of patience, SIGKILL.
  void stop();

 private:
  ChildProcess() = default;
  int process_id_ = -1;
  int output_ = -1;
  std::string unread_;
  std::optional<ChildExit> exit_;
};

/// Where the shell would find the program of this name; nothing where it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// The folder of the running program, where its sister programs lie.
std::filesystem::path own_folder();

}  // namespace septet::program
