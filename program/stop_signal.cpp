#include "program/stop_signal.hpp"

#include <unistd.h>

#include <csignal>

namespace septet::program {
namespace {

volatile std::sig_atomic_t patience = 0;
volatile std::sig_atomic_t first_signal = 0;  // Written by the handler: with alarm, all it may do.

void on_signal(int signal) {
  if (first_signal != 0) return;
  first_signal = signal;
  ::alarm(static_cast<unsigned>(patience));
}

}  // namespace

void catch_stop_signals(unsigned patience_s) {
  patience = static_cast<std::sig_atomic_t>(patience_s);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    std::signal(signal, on_signal);
  }
}

std::optional<int> stop_signal() {
  const int signal = first_signal;
  return signal == 0 ? std::nullopt : std::optional(signal);
}

void obey_stop_signal() { ::alarm(0); }

bool should_stop() {
  if (first_signal == 0) return false;
  obey_stop_signal();
  return true;
}

void survive_failed_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace septet::program
