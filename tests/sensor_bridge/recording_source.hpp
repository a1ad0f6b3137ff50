// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Segments.h>
#include <map>
#include <string>
#include <vector>

#include "services/runtime/process/source.hpp"

namespace quoin::tests {

/// A service kit that never waits and keeps what is published.
class RecordingSource : public runtime::Source {
 public:
  bool wait_until(std::chrono::steady_clock::time_point time) override {
    deadlines.push_back(time);
    return !stopping();
  }
  [[nodiscard]] bool stopping() const { return scans.size() >= stop_after; }
  bool publish(msg::Scan& scan) override {
    scans.push_back(scan);
    memory.push_back(scan.ranges().data());
    return !stopping();
  }
  [[nodiscard]] std::size_t readers() const override { return reader_count; }
  void warn(const std::string& text) override { warnings.push_back(text); }
  void clear_warning(const std::string& text) override { notes.push_back(text); }
  void set_diagnostic(const std::string& name, const std::string& value) override {
    diagnostics[name] = value;
  }

  bool publish_own(const std::type_info& type, void* message, msg::Header&) override {
    if (type == typeid(msg::Odometry)) {
      odometry.push_back(*static_cast<const msg::Odometry*>(message));
    } else if (type == typeid(msg::Lines)) {
      lines.push_back(*static_cast<const msg::Lines*>(message));
    } else if (type == typeid(msg::Segments)) {
      segments.push_back(*static_cast<const msg::Segments*>(message));
    } else {
      poses.push_back(*static_cast<const msg::Pose*>(message));
    }
    return !stopping();
  }

  std::atomic<std::size_t> reader_count = 1;
  std::size_t stop_after = 10000;  ///< published scans
  std::vector<std::chrono::steady_clock::time_point> deadlines;
  std::vector<msg::Scan> scans;
  std::vector<msg::Odometry> odometry;
  std::vector<msg::Pose> poses;
  std::vector<msg::Lines> lines;
  std::vector<msg::Segments> segments;
  std::vector<const float*> memory;  ///< of the ranges of the published messages
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::map<std::string, std::string> diagnostics;
};

/// The configuration of a source with these parameters.
inline ServiceConfig source_config(ParameterSettings parameters) {
  ServiceConfig config;
  config.parameters = std::move(parameters);
  return config;
}

}  // namespace quoin::tests
