#pragma once
/// Output of a running program. Never throws for a closed pipe or a full disk, as fmt::print does.

#include <cstdio>
#include <string_view>

namespace septet::program {

/// A line for people, on standard error.
void say(std::string_view line);

/// A line for the parent program, on standard output, flushed.
void announce(std::string_view line);

/// Progress of a program: on a terminal one line that is overwritten, elsewhere a line every ten seconds.
///
///     if (progress.is_due(now_s)) progress.show(fmt::format("{} of {} frames", made, planned));
class ProgressLine {
 public:
  ProgressLine();  ///< On standard error.
  ProgressLine(std::FILE* file, bool is_terminal) : file_(file), is_terminal_(is_terminal) {}

  /// True if it is time to show again. `now_s` may be any clock, and may restart.
  bool is_due(double now_s);
  void show(std::string_view text);
  /// A line of its own, which stays.
  void message(std::string_view text);
  /// Ends a line that is still open.
  void close();

 private:
  std::FILE* file_;
  bool is_terminal_;
  double shown_s_ = -1.0;  ///< Negative: never.
  bool is_open_ = false;
};

}  // namespace septet::program
