#pragma once
/// Processor time of this thread, which other load does not lengthen.

#include <time.h>

namespace septet::figures {

inline double thread_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace septet::figures
