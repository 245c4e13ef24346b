// CPU time of the calling thread.
#pragma once

#include <ctime>

namespace bench {

inline double threadMilliseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double cpuMilliseconds(const Work& work) {
  const double from_ms = threadMilliseconds();
  work();
  return threadMilliseconds() - from_ms;
}

}  // namespace bench
