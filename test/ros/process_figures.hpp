#pragma once

#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace lstm_planner {

/// Entries of a folder of /proc.
inline int countEntries(const char* folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<int>(std::distance(begin(entries), end(entries)));
}
inline int countThreads() { return countEntries("/proc/self/task"); }
inline int countDescriptors() { return countEntries("/proc/self/fd"); }

/// MB of this process that are in memory.
inline double residentMemory() {
  long size = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

/// s of processor time that the calling thread has used: unlike the clock's, no more on a computer that is busy.
inline double threadTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace lstm_planner
