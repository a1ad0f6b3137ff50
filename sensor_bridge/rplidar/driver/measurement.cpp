// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/measurement.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>
#include <vector>

#include "sensor_bridge/rplidar/driver/driver.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using Clock = std::chrono::steady_clock;

class Recorder final : public DriverListener {
 public:
  explicit Recorder(std::size_t wanted) : wanted_(wanted) {}

  void connected(const DeviceFacts& /*facts*/, const ScanPlan& plan) override {
    result_.plan = plan;
  }

  void revolution(const Revolution& revolution, const ScanMode& mode) override {
    if (result_.plan && result_.plan->mode.format != mode.format) result_.plan->mode = mode;
    ++result_.revolutions;
    durations_.push_back(std::chrono::duration<double>(revolution.end - revolution.begin).count());
    samples_ += revolution.distance_q2.size();
    lost_ += revolution.lost;
    returns_ += revolution.distance_q2.size() -
                static_cast<std::size_t>(std::ranges::count(revolution.distance_q2, 0U));
  }

  void problem(const Diagnosis& diagnosis) override { result_.problems.push_back(diagnosis); }

  /// Adds it unless it is what was reported last.
  void end(const Diagnosis& diagnosis) {
    if (result_.problems.empty() || result_.problems.back().finding != diagnosis.finding) {
      result_.problems.push_back(diagnosis);
    }
  }

  [[nodiscard]] bool done() const { return result_.revolutions >= wanted_; }

  [[nodiscard]] Measurement result() const {
    Measurement result = result_;
    if (!durations_.empty()) {
      std::vector<double> durations = durations_;
      const auto median = durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2);
      std::ranges::nth_element(durations, median);
      result.frequency = 1.0 / *median;
      result.sample_rate = static_cast<double>(samples_ + lost_) /
                           std::accumulate(durations.begin(), durations.end(), 0.0);
    }
    if (samples_ > 0) {
      result.return_share = static_cast<double>(returns_) / static_cast<double>(samples_);
    }
    return result;
  }

 private:
  std::size_t wanted_;
  Measurement result_;
  std::vector<double> durations_;  // [s] of the revolutions
  std::size_t samples_ = 0;
  std::size_t lost_ = 0;
  std::size_t returns_ = 0;
};

}  // namespace

Measurement measure(const DriverSettings& settings, std::size_t revolutions,
                    TimeOuts::Time time_limit, const Interruption& interruption, Opener open) {
  Recorder recorder(revolutions);
  Driver driver(settings, recorder, std::move(open));
  const Clock::time_point end = Clock::now() + time_limit;
  try {
    driver.run([&](Clock::time_point time) {
      return !recorder.done() && Clock::now() < end && interruption(std::min(time, end));
    });
  } catch (const SettingsError& error) {
    recorder.end(error.diagnosis());
  }
  Measurement result = recorder.result();
  result.counts = driver.counts();
  return result;
}

}  // namespace quoin::sensor_bridge::rplidar
