#include "program/console.hpp"

#include <unistd.h>

#include <cmath>
#include <string>
#include <utility>

namespace septet::program {
namespace {

/// As one text: two programs that write to one terminal do not mix their lines.
void write(std::FILE* file, const std::string& text) { std::fputs(text.c_str(), file); }

}  // namespace

void say(std::string_view line) { write(stderr, std::string(line) + '\n'); }

void announce(std::string_view line) {
  write(stdout, std::string(line) + '\n');
  std::fflush(stdout);
}

ProgressLine::ProgressLine() : ProgressLine(stderr, ::isatty(STDERR_FILENO) != 0) {}

bool ProgressLine::is_due(double now_s) {
  if (shown_s_ >= 0.0 && std::abs(now_s - shown_s_) < (is_terminal_ ? 0.1 : 10.0)) return false;
  shown_s_ = now_s;
  return true;
}

void ProgressLine::show(std::string_view text) {
  write(file_, is_terminal_ ? "\r\033[K" + std::string(text) : std::string(text) + '\n');
  is_open_ = is_terminal_;
}

void ProgressLine::message(std::string_view text) {
  close();
  write(file_, std::string(text) + '\n');
}

void ProgressLine::close() {
  if (std::exchange(is_open_, false)) write(file_, "\n");
}

}  // namespace septet::program
