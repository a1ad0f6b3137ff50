// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator_service/emulator_service.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "sensor_bridge/rplidar/emulator/emulator.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

void report_status(const EmulatorStatus& status, runtime::Activity& activity) {
  activity.set_diagnostic("Device State", std::string(state_name(status.state)));
  activity.set_diagnostic("Endpoint", status.endpoint);
  activity.set_diagnostic("Bytes Sent", std::to_string(status.sent_bytes));
  activity.set_diagnostic("Bytes Lost", std::to_string(status.lost_bytes));
}

/// What happens to the device goes to the log. The emulator is made before there is one.
class Reporter {
 public:
  void operator()(const std::string& what) const {
    if (activity_ != nullptr) activity_->clear_warning(what);
  }
  void set(runtime::Activity* activity) { activity_ = activity; }

 private:
  runtime::Activity* activity_ = nullptr;
};

}  // namespace

std::function<void(runtime::Activity&)> open_emulator(const ServiceConfig& config,
                                                      const std::filesystem::path& base_directory) {
  auto settings = make_parameters<EmulatorSettings>(config.parameters);
  if (!settings.link.empty()) settings.link = base_directory / settings.link;
  const auto reporter = std::make_shared<Reporter>();
  const auto emulator = std::make_shared<Emulator>(
      settings, [reporter](double, const std::string& what) { (*reporter)(what); }, base_directory);
  return [reporter, emulator](runtime::Activity& activity) {
    reporter->set(&activity);
    activity.clear_warning("emulated RPLIDAR at " + emulator->status().endpoint);
    std::thread thread([&] { emulator->run(); });
    do {
      report_status(emulator->status(), activity);
    } while (activity.wait_until(std::chrono::steady_clock::now() + std::chrono::seconds(1)));
    emulator->stop();
    thread.join();
    reporter->set(nullptr);
  };
}

}  // namespace quoin::sensor_bridge::rplidar
