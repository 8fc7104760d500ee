#include "program/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>
#include <utility>

#include <fmt/core.h>

namespace septet::program {

namespace {

/// End of a child between fork and exec: reports the reason if its output can still be read. Nothing may allocate here.
[[noreturn]] void give_up(const std::string& program, const char* why, int status) {
  for (const char* text : {"septet: ", program.c_str(), ": ", why, "\n"})
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  ::_exit(status);
}

}  // namespace

Expected<ChildProcess> ChildProcess::start(const ChildOptions& options) {
  int output[2];
  if (::pipe2(output, O_CLOEXEC) != 0)
    return failure(std::strerror(errno), options.program, "close other programs: the system has no pipe left");
  // Everything that allocates happens before fork.
  std::vector<std::string> arguments{options.program};
  arguments.insert(arguments.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::vector<std::string> variables;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!options.environment.contains(text.substr(0, text.find('=')))) variables.push_back(text);
  }
  for (const auto& [name, value] : options.environment) variables.push_back(fmt::format("{}={}", name, value));
  std::vector<char*> envp;
  envp.reserve(variables.size() + 1);
  for (auto& variable : variables) envp.push_back(variable.data());
  envp.push_back(nullptr);
  const std::string log = options.log.string(), folder = options.folder.string();

  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) {
    const int error = errno;
    ::close(output[0]);
    ::close(output[1]);
    return failure(std::strerror(error), options.program, "close other programs: the system starts no more");
  }
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // Dies with its parent, in any case.
    if (::getppid() != parent) give_up(options.program, "the program that starts it ended first", 1);
    ::setpgid(0, 0);  // Ctrl-C reaches the parent only, which then ends the drive in order.
    ::dup2(output[1], STDOUT_FILENO);
    if (!log.empty()) {
      const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
      if (file >= 0) ::dup2(file, STDERR_FILENO);
    }
    if (!folder.empty() && ::chdir(folder.c_str()) != 0) give_up(folder, ::strerrordesc_np(errno), 127);
    ::execve(argv[0], argv.data(), envp.data());
    give_up(options.program, ::strerrordesc_np(errno), 127);
  }
  ::close(output[1]);
  ChildProcess process;
  process.process_id_ = child;
  process.output_ = output[0];
  return process;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept { *this = std::move(other); }

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(process_id_, other.process_id_);
  std::swap(output_, other.output_);
  std::swap(unread_, other.unread_);
  std::swap(exit_, other.exit_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (process_id_ > 0) stop();
  if (output_ >= 0) ::close(output_);
}

std::optional<ChildExit> ChildProcess::poll() {
  if (exit_ || process_id_ <= 0) return exit_;
  int status = 0;
  if (::waitpid(process_id_, &status, WNOHANG) == process_id_)
    exit_ = WIFSIGNALED(status) ? ChildExit{-1, WTERMSIG(status)} : ChildExit{WEXITSTATUS(status), 0};
  return exit_;
}

std::optional<std::string> ChildProcess::read_line(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (true) {
    if (const auto end = unread_.find('\n'); end != std::string::npos) {
      std::string line = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return line;
    }
    // Pending output is read even when it is late: this process may have waited for its turn since it looked at the
    // clock.
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd waiting{output_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return std::nullopt;
    char buffer[4096];
    const ssize_t count = ::read(output_, buffer, sizeof buffer);
    if (count <= 0) return std::nullopt;
    unread_.append(buffer, static_cast<std::size_t>(count));
  }
}

void ChildProcess::send_signal(int signal) {
  if (!poll() && process_id_ > 0) ::kill(process_id_, signal);
}

void ChildProcess::stop() {
  send_signal(SIGTERM);
  for (int i = 0; i < 100 && !poll(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (poll()) return;
  send_signal(SIGKILL);
  int status = 0;
  if (::waitpid(process_id_, &status, 0) == process_id_) exit_ = ChildExit{-1, SIGKILL};
}

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string folder;
  for (std::istringstream folders(path ? path : "/usr/bin"); std::getline(folders, folder, ':');)
    if (const auto file = std::filesystem::path(folder) / name;
        !folder.empty() && ::access(file.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(file))
      return file;
  return std::nullopt;
}

std::filesystem::path own_folder() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
}

}  // namespace septet::program
