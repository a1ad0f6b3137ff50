// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/lidar_report.hpp"

#include <cstdio>
#include <string>

#include "deploy/observation/table.hpp"

namespace quoin::deploy {
namespace {

using namespace sensor_bridge;
using namespace sensor_bridge::rplidar;
using Json = nlohmann::ordered_json;

Json to_json(const ScanMode& mode, const DeviceFacts& facts) {
  return {{"id", mode.id},
          {"name", mode.name},
          {"format", format_name(mode.format)},
          {"sample_period_us", mode.sample_period * 1e6},
          {"range_max", mode.range_max},
          {"typical", mode.id == facts.typical_mode}};
}

Json to_json(const Measurement& measurement) {
  Json problems = Json::array();
  for (const Diagnosis& problem : measurement.problems) {
    problems.push_back({{"finding", name_of(problem.finding)},
                        {"text", problem.text},
                        {"advice", problem.advice}});
  }
  return {{"scan_mode", measurement.plan ? Json(measurement.plan->mode.name) : Json()},
          {"revolutions", measurement.revolutions},
          {"scan_frequency_hz", measurement.frequency},
          {"sample_rate_hz", measurement.sample_rate},
          {"return_share", measurement.return_share},
          {"sample_period_declared_us",
           measurement.plan ? Json(measurement.plan->mode.sample_period * 1e6) : Json()},
          {"sample_period_measured_us", measurement.counts.sample_period > 0.0
                                            ? Json(measurement.counts.sample_period * 1e6)
                                            : Json()},
          {"frames_out_of_line", measurement.counts.out_of_line},
          {"frames_repeated", measurement.counts.repeated},
          {"lost_samples", measurement.counts.lost_samples},
          {"checksum_errors", measurement.counts.checksum_errors},
          {"problems", problems}};
}

std::string hexadecimal(std::uint16_t value) {
  char text[8];
  std::snprintf(text, sizeof text, "%04x", static_cast<unsigned>(value));
  return text;
}

void print_line(std::ostream& out, const std::string& name, const std::string& value) {
  out << "  " << name << std::string(name.size() < 16 ? 16 - name.size() : 1, ' ') << value << '\n';
}

std::string period_text(double seconds) {
  return seconds > 0.0 ? fixed(seconds * 1e6, 2) + " us" : "no time";
}

}  // namespace

void print(const LidarReport& report, std::ostream& out) {
  if (!report.found()) {
    out << to_text(report.probe.diagnosis) << '\n';
    return;
  }
  const DeviceFacts& facts = *report.probe.facts;
  out << facts.endpoint << ": RPLIDAR " << model_text(facts.info) << '\n';
  if (facts.baud_rate != 0) print_line(out, "baud rate", std::to_string(facts.baud_rate));
  print_line(out, "firmware", firmware_text(facts.info));
  print_line(out, "hardware", std::to_string(facts.info.hardware));
  print_line(out, "serial number", serial_number_text(facts.info));
  print_line(out, "health",
             std::string(name_of(facts.health.status)) +
                 (facts.health.status == Health::good ? "" : ", " + health_text(facts.health)));
  for (const ScanMode& mode : facts.modes) {
    print_line(out, "scan mode " + std::to_string(mode.id),
               mode.name + ", " + format_name(mode.format) + ", " +
                   period_text(mode.sample_period) + " a sample, up to " +
                   fixed(mode.range_max, 0) + " m" +
                   (mode.id == facts.typical_mode ? ", typical" : ""));
  }
  if (facts.speed) {
    print_line(out, "scan frequency",
               fixed(facts.speed->smallest / 60.0, 1) + " to " +
                   fixed(facts.speed->largest / 60.0, 1) + " Hz, usually " +
                   fixed(facts.speed->usual / 60.0, 1) + " Hz");
  }
  if (report.measurement && report.measurement->revolutions > 0) {
    const Measurement& measurement = *report.measurement;
    print_line(out, "measured",
               fixed(measurement.frequency, 2) + " Hz, " + fixed(measurement.sample_rate, 0) +
                   " samples a second, " +
                   fixed(measurement.sample_rate / measurement.frequency, 0) + " a revolution, " +
                   fixed(100.0 * measurement.return_share, 0) + " % with a range, " +
                   std::to_string(measurement.counts.lost_samples) + " lost");
    if (measurement.counts.sample_period > 0.0) {
      print_line(out, "sample period",
                 fixed(measurement.counts.sample_period * 1e6, 2) + " us measured, " +
                     period_text(measurement.plan->mode.sample_period) + " declared");
    }
  }
  print_line(out, "x axis",
             "the device's 0 degrees, bearings counter-clockwise from there; the "
             "vendor's ROS driver has x at its 180 degrees (angle_offset: 180 deg)");
  if (report.probe.diagnosis.finding != Finding::fine) {
    out << to_text(report.probe.diagnosis) << '\n';
  }
  if (!report.measurement) return;
  for (const Diagnosis& problem : report.measurement->problems) out << to_text(problem) << '\n';
}

Json to_json(const LidarReport& report) {
  Json object{{"finding", name_of(report.probe.diagnosis.finding)},
              {"text", report.probe.diagnosis.text},
              {"advice", report.probe.diagnosis.advice}};
  if (report.found()) {
    const DeviceFacts& facts = *report.probe.facts;
    Json modes = Json::array();
    for (const ScanMode& mode : facts.modes) modes.push_back(to_json(mode, facts));
    object["endpoint"] = facts.endpoint;
    object["baud_rate"] = facts.baud_rate;
    object["model"] = model_text(facts.info);
    object["firmware"] = firmware_text(facts.info);
    object["hardware"] = facts.info.hardware;
    object["serial_number"] = serial_number_text(facts.info);
    object["health"] = name_of(facts.health.status);
    object["health_status"] = facts.health.reported;
    object["health_error_code"] = facts.health.error_code;
    object["scan_modes"] = modes;
    if (facts.speed) {
      object["scan_frequency_hz"] = {{"smallest", facts.speed->smallest / 60.0},
                                     {"largest", facts.speed->largest / 60.0},
                                     {"usual", facts.speed->usual / 60.0}};
    }
    object["was_sending"] = report.probe.was_sending;
  }
  if (report.measurement) object["measured"] = to_json(*report.measurement);
  return object;
}

void print(const std::vector<SerialPortEntry>& ports, std::ostream& out) {
  if (ports.empty()) out << "no USB serial port is there\n";
  for (const SerialPortEntry& port : ports) {
    out << port.device;
    if (!port.link.empty()) out << " (" << port.link << ")";
    if (port.usb) {
      out << ": " << port.usb->product_name << ", USB " << hexadecimal(port.usb->vendor) << ':'
          << hexadecimal(port.usb->product) << ", serial number " << port.usb->serial_number;
      if (is_usual_adapter(*port.usb)) out << "; the adapter that RPLIDARs come with";
    }
    out << '\n';
  }
}

Json to_json(const std::vector<SerialPortEntry>& ports) {
  Json list = Json::array();
  for (const SerialPortEntry& port : ports) {
    Json object{{"device", port.device}, {"link", port.link}};
    if (port.usb) {
      object["usb_vendor"] = hexadecimal(port.usb->vendor);
      object["usb_product"] = hexadecimal(port.usb->product);
      object["product"] = port.usb->product_name;
      object["serial_number"] = port.usb->serial_number;
      object["usual_adapter"] = is_usual_adapter(*port.usb);
    }
    list.push_back(object);
  }
  return list;
}

}  // namespace quoin::deploy
