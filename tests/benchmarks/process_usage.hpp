// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

namespace quoin::benchmarks {

/// Processor time, user and system, that all threads of a process have used.
inline std::chrono::nanoseconds processor_time(pid_t process) {
  clockid_t clock = 0;
  timespec time = {};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) {
    throw std::runtime_error("process " + std::to_string(process) + " has ended");
  }
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Resident memory [MiB], with the pages that it shares with other processes.
inline double resident_mib(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double total = 0;
  double resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// Memory [MiB] with each shared page divided by the number of processes that share it.
inline double proportional_mib(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
  std::string word;
  double kib = 0.0;
  while (file >> word) {
    if (word == "Pss:") file >> kib;
  }
  return kib / 1024.0;
}

}  // namespace quoin::benchmarks
