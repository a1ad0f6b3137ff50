// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What the RPLIDAR bridge costs and how late its scans are, measured on its process with an
// emulated device at the other end of a pseudo-terminal: processor time while it waits for a device
// and while it publishes at 10 Hz, and the time from the last byte of a revolution on the wire to
// the scan's publication. That byte is the last of the capsule behind the revolution, without which
// the angles of its last points are not known.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <idl/Scan.h>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "sensor_bridge/rplidar/emulator/emulated_device.hpp"
#include "sensor_bridge/rplidar/emulator/pseudo_terminal.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/clock.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace {

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using sensor_bridge::rplidar::EmulatedDevice;
using sensor_bridge::rplidar::PseudoTerminal;

/// A device that notes when it wrote.
class TimedDevice {
 public:
  explicit TimedDevice(const std::string& link)
      : terminal_(link, [](const std::string&) {}),
        device_({}, *built_in_world("domestic_room"), Clock::now()) {
    terminal_.plug_in();
    thread_ = std::thread([this] { run(); });
  }
  ~TimedDevice() {
    stop_ = true;
    thread_.join();
  }

  /// The last time [ns since the Unix epoch] not after `time` at which bytes were written.
  [[nodiscard]] std::int64_t last_write(std::int64_t time) {
    const std::lock_guard lock(mutex_);
    const auto after = std::upper_bound(writes_.begin(), writes_.end(), time);
    return after == writes_.begin() ? 0 : *(after - 1);
  }

 private:
  void run() {
    std::vector<std::uint8_t> bytes;
    while (!stop_) {
      bytes.clear();
      terminal_.read(bytes);
      const Clock::time_point now = Clock::now();
      device_.receive(bytes, now);
      bytes.clear();
      device_.send(now, bytes);
      if (!bytes.empty()) {
        terminal_.write(bytes, now);
        const std::lock_guard lock(mutex_);
        writes_.push_back(runtime::now_ns());
      }
      const Clock::time_point latest = Clock::now() + 1ms;
      std::this_thread::sleep_until(std::min(device_.next_event().value_or(latest), latest));
    }
  }

  PseudoTerminal terminal_;
  EmulatedDevice device_;
  std::mutex mutex_;
  std::vector<std::int64_t> writes_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Share of one processor [%] that a process uses during `time`.
double load(pid_t process, std::chrono::duration<double> time) {
  const std::chrono::nanoseconds before = processor_time(process);
  const Clock::time_point begin = Clock::now();
  std::this_thread::sleep_for(time);
  const std::chrono::duration<double> elapsed = Clock::now() - begin;
  return 100.0 * std::chrono::duration<double>(processor_time(process) - before) / elapsed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Processor time and latency of the RPLIDAR bridge"};
  double seconds = 30.0;
  bool json = false;
  app.add_option("--seconds", seconds, "How long to measure at 10 Hz [s]")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);

  const tests::TestDeployment deployment(
      "  - {name: front, kind: rplidar, parameters: {serial_port: ./device.tty, "
      "serial_baudrate: 256000, scan_frequency: 10 Hz}}\n");
  runtime::Participant participant(deployment.participant("benchmark"));
  runtime::Reader<msg::Scan> reader(participant, deployment.topic("front"),
                                    runtime::QosPreset::sensor);
  tests::Process bridge = deployment.start("front", 1);
  std::this_thread::sleep_for(2s);
  const double waiting = load(bridge.pid(), std::chrono::duration<double>(seconds / 3.0));

  TimedDevice device((deployment.directory().path() / "device.tty").string());
  msg::Scan scan;
  if (!tests::eventually([&] { return reader.take(scan); })) {
    std::cerr << "no scan came: " << bridge.errors();
    return 1;
  }
  std::vector<double> latencies;  // [s]
  std::atomic<bool> measured = false;
  double streaming = 0.0;
  std::thread watch([&] {
    streaming = load(bridge.pid(), std::chrono::duration<double>(seconds));
    measured = true;
  });
  while (!measured) {
    while (reader.take(scan)) {
      const std::int64_t published = scan.header().trace()[0].published();
      const std::int64_t written = device.last_write(published);
      latencies.push_back(static_cast<double>(published - written) * 1e-9);
    }
    std::this_thread::sleep_for(10ms);
  }
  watch.join();
  bridge.signal(SIGTERM);
  (void)bridge.wait(5s);

  const double p50 = 1e3 * quantile(latencies, 0.5);
  const double p99 = 1e3 * quantile(latencies, 0.99);
  const double worst = 1e3 * quantile(latencies, 1.0);
  if (json) {
    const nlohmann::ordered_json object{{"scans", latencies.size()},
                                        {"waiting_load_percent", waiting},
                                        {"streaming_load_percent", streaming},
                                        {"latency_p50_ms", p50},
                                        {"latency_p99_ms", p99},
                                        {"latency_worst_ms", worst}};
    std::cout << object.dump(2) << '\n';
    return 0;
  }
  std::printf("RPLIDAR bridge, %zu scans at 10 Hz\n", latencies.size());
  std::printf("  processor while it waits for a device   %6.2f %% of one\n", waiting);
  std::printf("  processor while it publishes            %6.2f %% of one\n", streaming);
  std::printf("  last byte to publication   p50 %.3f ms, p99 %.3f ms, worst %.3f ms\n", p50, p99,
              worst);
  return 0;
}
