// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What ROS 2 as a source and as a reader costs. The same scans go as LaserScan to a chain behind
// ros2_scan and as Scan to one without it, in turn: how much later are corners? How many of 1440
// beams at 100 Hz are lost? And what does ros2_output take for markers of 40 lines and 20 ellipses?
// This program writes the LaserScans: no other DDS and no ROS 2 takes part.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/ros2/messages.hpp"
#include "services/ros2/scan_export.hpp"
#include "services/ros2/topics.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/benchmarks/room_scans.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace {

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

// The chain behind `source`, whose services begin with `prefix`.
std::string chain(const std::string& prefix, const std::string& source) {
  return "  - {name: " + prefix + "walls, kind: segmentation, input: " + source +
         "}\n  - {name: " + prefix + "lines, kind: line_fitting, input: " + prefix +
         "walls}\n  - {name: " + prefix + "corners, kind: corner_estimation, input: " + prefix +
         "lines}\n";
}

constexpr auto ros_source =
    "  - {name: driver, kind: ros2_scan, parameters: {topic: /scan, reliability: reliable}}\n";

/// The processes of a chain, with a reader at its end.
class Chain {
 public:
  Chain(const tests::TestDeployment& deployment, runtime::Participant& participant,
        const std::string& prefix, const std::vector<std::string>& sources)
      : corners_(participant, deployment.topic(prefix + "corners"), runtime::QosPreset::feature) {
    std::vector<std::string> services{prefix + "corners", prefix + "lines", prefix + "walls"};
    services.insert(services.end(), sources.begin(), sources.end());
    for (const std::string& service : services) {
      processes_.push_back(deployment.start(service, service == prefix + "corners" ? 1 : 0));
    }
    wait_set_.add(corners_);
    if (!corners_.wait_for_writers(1, 30s)) throw std::runtime_error("a chain did not start");
  }

  /// Corners that came until all of `sent`, or for at most that long.
  void collect(std::size_t sent, std::chrono::milliseconds timeout) {
    const auto deadline = steady_clock::now() + timeout;
    while (arrivals_.size() < sent && steady_clock::now() < deadline) {
      while (corners_.take(message_)) {
        arrivals_[message_.header().stamp()] = corners_.last_sample().received;
      }
      if (arrivals_.size() < sent) (void)wait_set_.wait(5ms);
    }
  }
  /// [ns since the Unix epoch] by the stamp of the scan.
  [[nodiscard]] const std::map<std::int64_t, std::int64_t>& arrivals() const { return arrivals_; }

 private:
  runtime::Reader<msg::Corners> corners_;
  runtime::WaitSet wait_set_;
  std::vector<tests::Process> processes_;
  msg::Corners message_;
  std::map<std::int64_t, std::int64_t> arrivals_;
};

std::vector<double> latencies(const std::map<std::int64_t, std::int64_t>& sent,
                              const Chain& chain) {
  std::vector<double> all;
  for (const auto& [stamp, arrival] : chain.arrivals()) {
    all.push_back(1e-6 * static_cast<double>(arrival - sent.at(stamp)));
  }
  return all;
}

/// [ms] from writing to corners, in turn through ros2_scan and without it.
void measure_latency(int count, nlohmann::ordered_json& figures) {
  const tests::TestDeployment deployment(
      "  - {name: front, kind: external, type: scan, topic: " + tests::test_namespace() +
      "/own}\n" + chain("", "front") + ros_source + chain("ros_", "driver"));
  runtime::Participant participant(deployment.participant("benchmark"));
  Chain own(deployment, participant, "", {});
  Chain ros(deployment, participant, "ros_", {"driver"});
  runtime::Writer<msg::Scan> own_scans(participant, deployment.topic("front"),
                                       runtime::QosPreset::sensor);
  runtime::Writer<ros2::LaserScan> ros_scans(participant, ros2::dds_topic("/scan"),
                                             ros2::writer_qos(ros2::topic_type<ros2::LaserScan>()));
  if (!own_scans.wait_for_readers(1, 30s) || !ros_scans.wait_for_readers(1, 30s)) {
    throw std::runtime_error("nobody reads the scans");
  }
  std::this_thread::sleep_for(1s);
  std::vector<msg::Scan> scans = make_scans();
  ros2::ScanExport beams(0);
  ros2::LaserScan laser_scan;
  std::map<std::int64_t, std::int64_t> sent;
  std::map<std::int64_t, std::int64_t> sent_to_ros;
  auto next = steady_clock::now();
  for (int i = 0; i < count; ++i) {
    msg::Scan& scan = scans[static_cast<std::size_t>(i) % scans.size()];
    scan.header().stamp(runtime::now_ns());
    (void)beams.convert(scan, laser_scan);
    sent_to_ros[scan.header().stamp()] = runtime::now_ns();
    (void)ros_scans.write(laser_scan);
    ros.collect(sent_to_ros.size(), 45ms);
    std::this_thread::sleep_until(next += 50ms);
    scan.header().stamp(runtime::now_ns());
    number(scan, static_cast<std::uint64_t>(i));
    sent[scan.header().stamp()] = runtime::now_ns();
    (void)own_scans.write(scan);
    own.collect(sent.size(), 45ms);
    std::this_thread::sleep_until(next += 50ms);
  }
  const std::vector<double> with_ros = latencies(sent_to_ros, ros);
  const std::vector<double> without = latencies(sent, own);
  figures["ros_p50_ms"] = quantile(with_ros, 0.5);
  figures["own_p50_ms"] = quantile(without, 0.5);
  figures["ros_p50_over_own"] = quantile(with_ros, 0.5) / quantile(without, 0.5);
  figures["ros_p99_over_own"] = quantile(with_ros, 0.99) / quantile(without, 0.99);
  figures["ros_scans_lost"] = sent_to_ros.size() - with_ros.size();
}

/// A room, all around.
ros2::LaserScan scan_of(std::size_t beams) {
  ros2::LaserScan scan;
  scan.header().frame_id("laser");
  const double step = 2.0 * M_PI / static_cast<double>(beams);
  scan.angle_min(static_cast<float>(-M_PI));
  scan.angle_increment(static_cast<float>(step));
  scan.angle_max(static_cast<float>(M_PI - step));
  scan.range_min(0.1F);
  scan.range_max(12.0F);
  for (std::size_t i = 0; i < beams; ++i) {
    const double bearing = -M_PI + (static_cast<double>(i) + 0.3) * step;
    const double x = std::cos(bearing);
    const double y = std::sin(bearing);
    scan.ranges().push_back(
        static_cast<float>(std::min((x >= 0.0 ? 2.5 : -1.5) / x, (y >= 0.0 ? 1.25 : -1.75) / y)));
  }
  return scan;
}

void measure_loss(int count, nlohmann::ordered_json& figures) {
  const tests::TestDeployment deployment(ros_source + chain("", "driver"));
  runtime::Participant participant(deployment.participant("benchmark"));
  Chain chain(deployment, participant, "", {"driver"});
  runtime::Writer<ros2::LaserScan> writer(participant, ros2::dds_topic("/scan"),
                                          ros2::writer_qos(ros2::topic_type<ros2::LaserScan>()));
  if (!writer.wait_for_readers(1, 30s)) throw std::runtime_error("nobody reads the scans");
  std::this_thread::sleep_for(1s);
  ros2::LaserScan scan = scan_of(1440);
  auto next = steady_clock::now();
  const auto begin = next;
  for (int i = 0; i < count; ++i) {
    ros2::set_header(scan.header(), runtime::now_ns(), "laser");
    (void)writer.write(scan);
    chain.collect(static_cast<std::size_t>(i) + 1, 1ms);
    std::this_thread::sleep_until(next += 10ms);
  }
  const std::chrono::duration<double> elapsed = steady_clock::now() - begin;
  chain.collect(static_cast<std::size_t>(count), 5s);
  figures["scans_of_1440_beams"] = count;
  figures["rate_hz"] = count / elapsed.count();
  figures["lost"] = static_cast<std::size_t>(count) - chain.arrivals().size();
}

/// Share of a processor [%] that a process uses during `seconds`, while `step` is called at 10 Hz.
template <class Step>
double load(pid_t process, double seconds, Step step) {
  const auto before = processor_time(process);
  const auto begin = steady_clock::now();
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) {
    step();
    std::this_thread::sleep_until(begin + (i + 1) * 100ms);
  }
  const std::chrono::duration<double> elapsed = steady_clock::now() - begin;
  return 100.0 * std::chrono::duration<double>(processor_time(process) - before) / elapsed;
}

void measure_markers(double seconds, nlohmann::ordered_json& figures) {
  const std::string own = tests::test_namespace();
  const tests::TestDeployment deployment(
      "  - {name: lines, kind: external, type: lines, topic: " + own +
      "/lines}\n  - {name: corners, kind: external, type: "
      "corners, topic: " +
      own +
      "/corners}\n  - {name: ros, kind: ros2_output, inputs: "
      "[lines, corners], parameters: {prefix: robot}}\n");
  runtime::Participant participant(deployment.participant("benchmark"));
  runtime::Writer<msg::Lines> lines(participant, deployment.topic("lines"),
                                    runtime::QosPreset::feature);
  runtime::Writer<msg::Corners> corners(participant, deployment.topic("corners"),
                                        runtime::QosPreset::feature);
  const auto& type = ros2::topic_type<ros2::MarkerArray>();
  runtime::Reader<ros2::MarkerArray> markers(participant, ros2::dds_topic("/robot/markers"),
                                             ros2::reader_qos(type, true));
  const tests::Process output = deployment.start("ros");
  if (!lines.wait_for_readers(1, 30s) || !corners.wait_for_readers(1, 30s) ||
      !markers.wait_for_writers(1, 30s)) {
    throw std::runtime_error("ros2_output did not start");
  }
  std::this_thread::sleep_for(2s);
  const double idle = load(output.pid(), seconds, [] {});
  msg::Lines some_lines;
  some_lines.header().frame("laser");
  for (int i = 0; i < 40; ++i) {
    msg::Line& line = some_lines.lines().emplace_back();
    line.start().x(0.1 * i);
    line.end().y(1.0);
  }
  msg::Corners some_corners;
  some_corners.header().frame("laser");
  for (int i = 0; i < 20; ++i) {
    msg::Corner& corner = some_corners.corners().emplace_back();
    corner.x(0.1 * i);
    corner.ellipse95_major(0.02);
    corner.ellipse95_minor(0.01);
  }
  std::size_t written = 0;
  std::size_t arrived = 0;
  std::size_t drawn = 0;
  ros2::MarkerArray array;
  const double busy = load(output.pid(), seconds, [&] {
    const std::int64_t now = runtime::now_ns();
    some_lines.header().stamp(now);
    some_corners.header().stamp(now);
    written += static_cast<std::size_t>(lines.write(some_lines)) +
               static_cast<std::size_t>(corners.write(some_corners));
    while (markers.take(array)) {
      ++arrived;
      for (const ros2::Marker& marker : array.markers()) drawn += marker.points().size();
    }
  });
  figures["markers_load_percent"] = busy;
  figures["idle_load_percent"] = idle;
  figures["markers_written"] = written;
  figures["markers_arrived"] = arrived;
  figures["points_a_message"] = arrived == 0 ? 0 : drawn / arrived;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Latency, losses and processor time of the ROS 2 kinds"};
  int scans = 300;
  int fast_scans = 3000;
  double seconds = 20.0;
  bool json = false;
  app.add_option("--scans", scans, "Scans of each chain, at 10 Hz")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  app.add_option("--fast-scans", fast_scans, "Scans of 1440 beams, at 100 Hz")
      ->check(CLI::Range(10, 1000000))
      ->capture_default_str();
  app.add_option("--seconds", seconds, "How long to measure the markers [s]")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  try {
    nlohmann::ordered_json figures;
    measure_latency(scans, figures);
    measure_loss(fast_scans, figures);
    measure_markers(seconds, figures);
    print(figures, json);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
