#pragma once
/// The signals that end a program in order, and those that must not end it out of order.

#include <optional>

namespace septet::program {

/// From here on SIGINT, SIGTERM and SIGHUP are recorded instead of ending the program, and SIGUSR1, by which `septet
/// drive` reports that no screen can be started. SIGHUP stays ignored if it was (nohup). Called once there is something
/// to end in order: before, a signal ends the program at once, however stuck it is.
void catch_stop_signals(unsigned patience_s = 30);

/// First of them that has come; empty: none.
std::optional<int> stop_signal();

/// Guards the time between the first signal and its handling: a program that does not look at `stop_signal` within
/// `patience_s` is stuck and is ended by SIGALRM. Call this once the end is under way.
void obey_stop_signal();

/// For a program that just ends: true if one of them has come; the caller counts as not stuck.
bool should_stop();

/// A full pipe or file is an error of the writer, and not this program's end: SIGPIPE and SIGXFSZ are ignored.
void survive_failed_writes();

}  // namespace septet::program
