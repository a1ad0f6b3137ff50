// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/starter/first_deployment.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace quoin::deploy {

namespace {

/// Whether YAML takes it for text as it is, and for nothing else.
bool is_plain(const std::string& text) {
  constexpr std::array words{"true", "false", "yes", "no", "on", "off", "null", "y", "n"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_allowed = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '/' || c == '.' || c == '-';
  };
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(),
                         [&](char c) { return is_letter(c) ? static_cast<char>(c | 0x20) : c; });
  return !text.empty() && (is_letter(text.front()) || text.front() == '/') &&
         std::ranges::all_of(text, is_allowed) && std::ranges::find(words, lower) == words.end();
}

/// As it is or in double quotes, with all escaped that would end or change it.
std::string quoted(const std::string& text) {
  if (is_plain(text)) return text;
  if (text.find("${") != std::string::npos) {
    throw std::invalid_argument("'" + text +
                                "': a deployment file takes ${...} for a variable of the "
                                "environment; choose a name without it");
  }
  constexpr std::array digits{'0', '1', '2', '3', '4', '5', '6', '7',
                              '8', '9', 'a', 'b', 'c', 'd', 'e', 'f'};
  std::string result = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') {
      result += {'\\', character};
    } else if (byte < 0x20 || byte == 0x7f) {
      result += {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
    } else {
      result += character;
    }
  }
  return result + '"';
}

std::string list_of(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return "[" + text + "]";
}

std::string head(const FirstDeployment& first) {
  std::string text =
      "# quoin check FILE  tells what is wrong with it      quoin up FILE      runs it\n"
      "# quoin methods     lists kinds, methods, parameters  quoin status FILE  says how it is\n"
      "version: 1\n"
      "namespace: " +
      quoted(first.name_space) + "  # prefix of all topics\n";
  if (first.source == ScanSource::recording) {
    text += "qos: lossless  # a slow reader slows the recording down; nothing is lost\n";
  }
  if (!first.interfaces.empty()) {
    std::vector<std::string> names;
    for (const std::string& name : first.interfaces) names.push_back(quoted(name));
    text += "network: {interfaces: " + list_of(names) + ", discovery: multicast}\n";
  } else {
    text +=
        "# network: {interfaces: [eth0], discovery: multicast}  # without it, this host alone\n";
  }
  return text + "\nservices:\n";
}

std::string noise(const char* range_stddev) {
  return std::string(
             "    # How far ranges scatter decides how sure lines and corners are. Measure "
             "it once:\n"
             "    #   quoin calibrate FILE_OR_SERVICE\n"
             "    sensor: {range_stddev: ") +
         range_stddev + ", noise: estimated}  # begins with this and learns\n";
}

std::string source(const FirstDeployment& first) {
  switch (first.source) {
    case ScanSource::rplidar:
      return "  - name: front\n"
             "    kind: rplidar\n"
             "    parameters:\n"
             "      serial_port: " +
             quoted(first.serial_port) +
             "  # quoin lidar probe finds it\n"
             "      # angle_offset: 180 deg   # where x of the robot is, counted from the device's "
             "own zero\n"
             "      # inverted: true          # hangs upside down\n" +
             noise("10 mm");
    case ScanSource::ros2:
      return "  - name: front\n"
             "    kind: ros2_scan\n"
             "    parameters: {topic: " +
             quoted(first.scan_topic) + "}\n" + noise("10 mm");
    case ScanSource::recording:
      return "  - name: front\n"
             "    kind: replay\n"
             "    parameters:\n"
             "      path: " +
             quoted(first.recording) +
             "  # relative to this file\n"
             "      speed: 1                  # 0 is as fast as the readers accept\n" +
             (first.map ? "      stamps: recorded\n"
                          "      # odometry: true          # if it has any that is not corrected; "
                          "then also an input of slam\n"
                        : "") +
             noise("10 mm");
    case ScanSource::simulated:
      break;
  }
  return "  - name: front\n"
         "    kind: simulated\n"
         "    parameters:\n"
         "      environment: domestic_room  # or a world file of your own\n"
         "      rate_hz: 10\n"
         "      speed: 0.3 m/s              # 0 stands still\n" +
         std::string(first.map ? "      odometry: true              # what the wheels count\n"
                               : "");
}

/// The service that gives odometry; "" for none.
std::string odometry_service(const FirstDeployment& first) {
  if (first.source == ScanSource::ros2 && !first.odometry_topic.empty()) return "odometry";
  return first.source == ScanSource::simulated && first.map ? "front" : "";
}

std::string chain(const FirstDeployment& first) {
  const std::string odometry = odometry_service(first);
  std::string text;
  std::string scans = "front";
  if (odometry == "odometry") {
    text += "  - {name: odometry, kind: ros2_odometry, parameters: {topic: " +
            quoted(first.odometry_topic) + "}}\n";
  }
  if (!odometry.empty()) {
    text +=
        "  # Rays of one turn are cast from different places; odometry says from which.\n"
        "  - {name: still, kind: deskewing, inputs: {scan: front, odometry: " +
        odometry + "}}\n";
    scans = "still";
  }
  text += "  - {name: walls, kind: segmentation, input: " + scans + "}\n";
  const bool several = first.fitters.size() > 1;
  if (several) text += "  # Side by side on the same segments: quoin compare FILE\n";
  const std::vector<std::string> fitters =
      first.fitters.empty() ? std::vector<std::string>{""} : first.fitters;
  for (const std::string& method : fitters) {
    const std::string name = several ? method : "lines";
    const std::string corners = several ? method + "_corners" : "corners";
    text += "  - {name: " + quoted(name) + ", kind: line_fitting, input: walls" +
            (method.empty() ? "" : ", method: " + quoted(method)) + "}\n";
    text += "  - {name: " + quoted(corners) + ", kind: corner_estimation, input: " + quoted(name) +
            "}\n";
  }
  if (first.circles) text += "  - {name: columns, kind: circle_fitting, input: walls}\n";
  if (first.map) {
    const std::string lines = quoted(several ? first.fitters.front() : "lines");
    text +=
        "  - name: slam\n"
        "    kind: mapping\n"
        "    inputs: {lines: " +
        lines + ", segments: walls" + (odometry.empty() ? "" : ", odometry: " + odometry) +
        "}\n"
        "    parameters:\n"
        "      map: map.qmap               # kept beside this file and gone on with; quoin map "
        "draws it\n"
        "      # mounting_x: 0.2 m         # place of the sensor on the robot\n";
  }
  return text;
}

std::string observers(const FirstDeployment& first) {
  std::string text;
  if (first.ros2_output) {
    text += "  - {name: ros, kind: ros2_output, inputs: all}  # docs/ros2.md\n";
  }
  if (first.recorder) {
    text +=
        "  - {name: tape, kind: recorder, inputs: all, parameters: {path: recordings/, split: "
        "10min}}\n";
  }
  if (first.page) {
    text += "  - {name: page, kind: viewer, inputs: all}  # http://127.0.0.1:8765\n";
  }
  return text;
}

}  // namespace

std::string deployment_text(const FirstDeployment& first) {
  return head(first) + source(first) + chain(first) + observers(first);
}

}  // namespace quoin::deploy
