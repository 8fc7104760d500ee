#pragma once
/// Keeps signals, which belong to the program, from a library's threads.

#include <csignal>

namespace septet::page {

/// Threads started during its lifetime receive no signal.
class SignalsAway {
 public:
  SignalsAway() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsAway() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsAway(const SignalsAway&) = delete;
  SignalsAway& operator=(const SignalsAway&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace septet::page
