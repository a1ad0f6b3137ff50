// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/memory.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace quoin::soak {

namespace {

constexpr std::size_t window = 10;
constexpr std::size_t shortest = 3 * window;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// When the process began, as the kernel counts; "" when there is none.
std::string start_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(file, line);
  // The name of the program, the second field, may hold anything; it ends at the last parenthesis.
  std::istringstream rest(line.substr(std::min(line.rfind(')'), line.size())));
  std::string field;
  for (int i = 2; i <= 22; ++i) rest >> field;
  return rest ? field : "";
}

}  // namespace

void Memory::begin() {
  for (auto& [process, history] : histories_) history.samples.clear();
}

void Memory::sample(const std::map<pid_t, std::string>& processes) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::seconds(1);
  for (const auto& [process, service] : processes) {
    std::ifstream file("/proc/" + std::to_string(process) + "/statm");
    double total = 0.0;
    double resident = 0.0;
    if (!(file >> total >> resident) || resident == 0.0) continue;  // gone, or not yet reaped
    const std::string started = start_of(process);
    History& history = histories_.try_emplace(process, History{service, started, {}}).first->second;
    if (history.started != started) continue;
    history.samples.push_back(resident * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  }
}

std::vector<Memory::Growth> Memory::growths() const {
  std::vector<Growth> growths;
  for (const auto& [process, history] : histories_) {
    if (history.samples.size() < shortest) continue;
    const auto begin = history.samples.begin();
    growths.push_back({history.service, median({begin, begin + window}),
                       median({history.samples.end() - window, history.samples.end()})});
  }
  return growths;
}

}  // namespace quoin::soak
