// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/rplidar_source.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "sensor_bridge/rplidar/driver/driver.hpp"
#include "sensor_bridge/rplidar/service/parameters.hpp"
#include "sensor_bridge/rplidar/service/scan_conversion.hpp"
#include "sensor_bridge/transport/find_port.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using Clock = std::chrono::steady_clock;

std::string number(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  std::string text = std::to_string(std::round(value * scale) / scale);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

TimeOuts::Time in_milliseconds(double seconds) {
  return std::chrono::round<TimeOuts::Time>(std::chrono::duration<double>(seconds));
}

TimeOuts time_outs_of(const RplidarParameters& parameters) {
  TimeOuts time_outs;
  time_outs.answer = in_milliseconds(parameters.answer_timeout);
  time_outs.probing = time_outs.answer / 2;  // is asked twice
  time_outs.spin_up = in_milliseconds(parameters.spin_up_timeout);
  return time_outs;
}

class Bridge final : public DriverListener {
 public:
  Bridge(const RplidarParameters& parameters, const Endpoint& endpoint, runtime::Source& source)
      : parameters_(parameters),
        source_(source),
        driver_({.endpoint = endpoint,
                 .baud_rate = static_cast<unsigned>(parameters.serial_baudrate),
                 .scan_mode = parameters.scan_mode,
                 .scan_frequency = parameters.scan_frequency,
                 .idle_stop = in_milliseconds(parameters.idle_stop),
                 .time_outs = time_outs_of(parameters)},
                *this) {
    // REP-138 names the keys.
    const bool serial = endpoint.kind == Endpoint::Kind::serial;
    report_value(serial ? "Serial Port" : "IP Address", serial ? endpoint.path : endpoint.host);
    if (!serial) report_value("IP Port", std::to_string(endpoint.port));
    report_value("Vendor Name", "Slamtec");
  }

  void run() {
    driver_.run([this](Clock::time_point time) { return source_.wait_until(time); });
  }

  [[nodiscard]] bool is_wanted() override { return source_.readers() > 0; }

  void state_changed(DriverState state) override {
    report_value("Driver State", std::string(name_of(state)));
  }

  void connected(const DeviceFacts& facts, const ScanPlan& plan) override {
    if (facts.baud_rate != 0) report_value("Serial Baud", std::to_string(facts.baud_rate));
    const std::string product = "RPLIDAR " + model_text(facts.info);
    report_value("Product Name", product);
    report_value("Firmware Version", firmware_text(facts.info));
    report_value("Hardware Version", std::to_string(facts.info.hardware));
    report_value("Device ID", serial_number_text(facts.info));
    report_value("Health",
                 std::string(name_of(facts.health.status)) +
                     (facts.health.status == Health::good ? "" : ", " + health_text(facts.health)));
    tell_mode(plan.mode);
    source_.clear_warning("connected to " + product + " " + serial_number_text(facts.info) +
                          " at " + facts.endpoint + ", scan mode " + plan.mode.name);
    mode_.reset();
    troubled_ = false;
  }

  void revolution(const Revolution& revolution, const ScanMode& mode) override {
    if (!mode_ || mode_->format != mode.format || mode_->id != mode.id) {
      mode_ = mode;
      scan_ = declared_scan(parameters_, mode);
      tell_mode(mode);
    }
    fill_rays(revolution, parameters_, scan_);
    scan_.header().stamp(runtime::epoch_ns(revolution.begin));
    (void)source_.publish(scan_);  // the driver notices by itself that it is to stop
    if (troubled_) {
      source_.clear_warning("measuring again");
      troubled_ = false;
    }
    tell_counts(revolution);
  }

  void problem(const Diagnosis& diagnosis) override {
    source_.warn(to_text(diagnosis));
    tell_recoveries();
    troubled_ = true;
  }

 private:
  void report_value(const std::string& name, const std::string& value) {
    source_.set_diagnostic(name, value);
  }

  void tell_mode(const ScanMode& mode) {
    report_value("Protocol Version", format_name(mode.format));
    report_value("Scan Mode", mode.name);
    report_value("Sample Period", number(mode.sample_period * 1e6, 3) + " us");
  }

  void tell_period() {
    const double measured = driver_.counts().sample_period;
    if (measured > 0.0) {
      report_value("Measured Sample Period", number(measured * 1e6, 3) + " us");
    }
  }

  /// As often as the heartbeat can show it.
  void tell_counts(const Revolution& revolution) {
    const Clock::time_point now = Clock::now();
    if (now < next_counts_) return;
    next_counts_ = now + std::chrono::seconds(1);
    const double period = std::chrono::duration<double>(revolution.end - revolution.begin).count();
    report_value("Scan Frequency", number(1.0 / period, 2) + " Hz");
    report_value("Samples", std::to_string(driver_.counts().samples));
    report_value("Lost Samples", std::to_string(driver_.counts().lost_samples));
    tell_period();
    report_value("Frames Out Of Line", std::to_string(driver_.counts().out_of_line));
    report_value("Checksum Errors", std::to_string(driver_.counts().checksum_errors));
    tell_recoveries();
  }

  void tell_recoveries() {
    const DriverCounts& counts = driver_.counts();
    report_value("Connections", std::to_string(counts.connections));
    report_value("Device Resets", std::to_string(counts.resets));
    for (int i = 0; i < finding_count; ++i) {
      const auto finding = static_cast<Finding>(i);
      const std::uint64_t count = counts.recoveries_from(finding);
      if (count > 0) {
        report_value("Recoveries from " + std::string(name_of(finding)), std::to_string(count));
      }
    }
  }

  RplidarParameters parameters_;
  runtime::Source& source_;
  Driver driver_;
  std::optional<ScanMode> mode_;  // of scan_
  msg::Scan scan_;
  bool troubled_ = false;  // a problem was reported since the last revolution
  Clock::time_point next_counts_{};
};

}  // namespace

std::function<void(runtime::Source&)> open_rplidar(const ServiceConfig& config,
                                                   const std::filesystem::path& base_directory) {
  const auto parameters = make_parameters<RplidarParameters>(config.parameters);
  Endpoint endpoint = find_endpoint(parameters.serial_port);
  if (endpoint.kind == Endpoint::Kind::serial) endpoint.path = base_directory / endpoint.path;
  return [parameters, endpoint](runtime::Source& source) {
    try {
      Bridge(parameters, endpoint, source).run();
    } catch (const SettingsError& error) {
      throw runtime::SourceError(error.what());
    }
  };
}

}  // namespace quoin::sensor_bridge::rplidar
