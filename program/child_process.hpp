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
  std::string program;  ///< Path; PATH is not searched.
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment;  ///< Added to this process's own.
  std::filesystem::path log;                       ///< File for its standard error; empty: this process's.
  std::filesystem::path folder = {};               ///< Working folder; empty: this process's.
};

/// End of a child.
struct ChildExit {
  int code = 0;    ///< Exit status; −1 after a signal.
  int signal = 0;  ///< The signal, or 0.
};

/// Movable owner of one child. Destruction ends the child (SIGTERM, then SIGKILL after a second). One thread.
class ChildProcess {
 public:
  static Expected<ChildProcess> start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  int process_id() const { return process_id_; }
  /// The child's end, if it has ended; does not wait.
  std::optional<ChildExit> poll();
  /// Next line of its standard output; empty after the time-out or at the end of the output.
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

/// Path at which the shell would find the program of this name; empty if it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// The folder of the running program, where its sister programs lie.
std::filesystem::path own_folder();

}  // namespace septet::program
