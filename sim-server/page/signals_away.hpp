#pragma once
/// Signals are the program's: none is to be delivered to a thread of a library.

#include <csignal>

namespace septet::page {

/// No signal is delivered to a thread that is made while this lives: they are the program's.
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
