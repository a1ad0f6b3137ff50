// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Quoin beside programs of ROS 2. What stands for them: Cyclone DDS with types made by ROS 2's own
// tool (tests/interoperability/ros2), and another implementation of its serialization.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/ros2/topics.hpp"
#include "services/topics/header.hpp"
#include "services/topics/message_json.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/services/ros2/estimates.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;
using tests::CornerRecorder;
using tests::estimate;
using tests::Process;
using tests::Recorder;
using tests::StatusRecorder;
using tests::TestDeployment;

const std::string here = QUOIN_ROS2_DIR;  // empty when something of it is not there

class Ros2 : public testing::Test {
 protected:
  void SetUp() override {
    if (here.empty()) {
      GTEST_SKIP() << "built without Cyclone DDS, rosidl or the packages of tests/npm";
    }
    setenv("CYCLONEDDS_URI", ("file://" + std::string(QUOIN_CYCLONE_CONFIGURATION)).c_str(), 1);
  }
};

std::string domain_of(const TestDeployment& deployment) {
  return std::to_string(deployment.deployment().domain);
}

/// What a script of tests/interoperability/ros2 prints.
std::string run_script(const std::string& script, std::vector<std::string> arguments,
                       const TestDeployment& deployment) {
  arguments.insert(arguments.begin(), {here + "/" + script, QUOIN_NPM_MODULES});
  Process node(QUOIN_NODE, arguments, deployment.directory().path());
  EXPECT_EQ(node.wait(60s), 0) << node.errors();
  return node.output();
}

/// `quoin up`, which ends in order with its services.
class Up {
 public:
  explicit Up(const TestDeployment& deployment)
      : process_(deployment.quoin({"up", "FILE", "--json"})) {}
  ~Up() {
    process_.signal(SIGINT);
    EXPECT_EQ(process_.wait(20s), 0) << process_.errors();
  }
  Up(const Up&) = delete;
  Up& operator=(const Up&) = delete;

  [[nodiscard]] std::string errors() const { return process_.errors(); }

 private:
  Process process_;
};

std::string diagnostic(const msg::ServiceStatus& status, const std::string& part_of_name) {
  for (const msg::Diagnostic& each : status.diagnostics()) {
    if (each.name().find(part_of_name) != std::string::npos) return each.value();
  }
  return "";
}

const std::string chain_of_scans = R"(
  - {name: walls, kind: segmentation, input: front}
  - {name: lines, kind: line_fitting, input: walls}
  - {name: corners, kind: corner_estimation, input: lines}
)";

TEST_F(Ros2, ScansOfSensorDataQosBecomeCornersAndNoneIsLost) {
  const TestDeployment deployment(
      "\n  - {name: front, kind: ros2_scan, parameters: {topic: /scan}}" + chain_of_scans);
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder corners(participant, deployment, "corners");
  StatusRecorder status(participant, deployment);
  const Up up(deployment);
  ASSERT_TRUE(corners.wait_for_writer()) << up.errors();
  Process ros("ros2_peer",
              {"write", domain_of(deployment), "/scan", "best_effort", "1", "20", "40"},
              deployment.directory().path());
  ASSERT_TRUE(corners.wait_for(40)) << up.errors() << ros.errors();
  EXPECT_EQ(corners.accounting().lost(), 0U);
  for (const msg::Corners& message : corners.messages()) {
    EXPECT_EQ(message.header().frame(), "laser");
    ASSERT_EQ(message.corners().size(), 4U);
    std::set<std::pair<int, int>> places;  // [cm]
    for (const msg::Corner& corner : message.corners()) {
      places.emplace(std::lround(corner.x() * 100.0), std::lround(corner.y() * 100.0));
    }
    // The program writes the bearing of the middle of a ray, 0.3 steps on: up to 8 mm at 3 m.
    for (const auto& [x, y] : places) {
      EXPECT_NEAR(x > 0 ? 250 : -150, x, 2);
      EXPECT_NEAR(y > 0 ? 125 : -175, y, 2);
    }
    EXPECT_EQ(places.size(), 4U);
  }
  ASSERT_TRUE(status.wait_for("front", [](const auto& s) { return s.published() == 40; }));
  EXPECT_EQ(diagnostic(status.latest("front"), "Lost on the way"), "0");
}

TEST_F(Ros2, OddScansAreCountedAndNamedAndTheStreamGoesOn) {
  const TestDeployment deployment(
      "\n  - {name: front, kind: ros2_scan, parameters: {topic: /scan, reliability: reliable, "
      "frame: "
      "laser}}" +
      chain_of_scans);
  {
    std::ofstream file(deployment.directory().path() / "scans");
    const std::string good = "laser -1 1 0.5 0 0 0.1 10 5 1 2 3 4 5\n";
    file << good << "rear -1 1 0.5 0 0 0.1 10 5 1 2 3 4 5\n"  // another sensor
         << "laser -1 1 0 0 0 0.1 10 5 1 2 3 4 5\n"           // no increment
         << "laser -1 1 -0.5 0 0 0.1 10 5 1 2 3 4 5\n"        // of the wrong sign
         << "laser -1 1 0.5 0 0 0.1 10 3 1 2 3\n"             // fewer rays
         << "laser nan nan nan 0 0 0.1 10 5 1 2 3 4 5\n"      // no angles at all
         << "laser -1 1 0.5 -1 0 0 0 5 inf -inf nan 0 11\n"   // no times, no limits
         << good;
  }
  runtime::Participant participant(deployment.participant("test"));
  Recorder<msg::Scan> scans(participant, deployment, "front");
  StatusRecorder status(participant, deployment);
  const Up up(deployment);
  ASSERT_TRUE(scans.wait_for_writer()) << up.errors();
  Process ros("ros2_peer",
              {"write", domain_of(deployment), "/scan", "reliable", "1", "20", "8",
               deployment.directory().path() / "scans"},
              deployment.directory().path());
  ASSERT_TRUE(scans.wait_for(6)) << up.errors() << ros.errors();
  EXPECT_THAT(scans.messages()[1].bearings(), testing::ElementsAre(-1.0F, -0.5F, 0.0F, 0.5F, 1.0F));
  ASSERT_TRUE(status.wait_for("front", [](const auto& s) {
    return s.published() == 6 && !diagnostic(s, "angle_min is no number").empty();
  })) << ros.errors();
  const msg::ServiceStatus& latest = status.latest("front");
  EXPECT_EQ(diagnostic(latest, "another than the deployment names"), "1 scans, last 1");
  EXPECT_EQ(diagnostic(latest, "taken from angle_max"), "1 scans, last 2");
  EXPECT_EQ(diagnostic(latest, "wrong sign"), "1 scans, last 3");
  EXPECT_EQ(diagnostic(latest, "number of ranges has changed"), "2 scans, last 6");
  EXPECT_EQ(diagnostic(latest, "angle_min is no number"), "1 scans, last 5");
  EXPECT_EQ(diagnostic(latest, "leave no range"), "1 scans, last 6");
  EXPECT_EQ(diagnostic(latest, "time_increment"), "1 scans, last 6");
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// A topic that is read by ros2_peer, and what for.
struct Topic {
  std::string name;
  std::string type;
  std::string qos;
};

/// A stranger that reads them all.
Process reader_of(const std::vector<Topic>& topics, const TestDeployment& deployment) {
  std::vector<std::string> arguments{"read", domain_of(deployment)};
  for (const Topic& topic : topics) {
    arguments.insert(arguments.end(), {topic.name, topic.type, topic.qos});
  }
  return {"ros2_peer", arguments, deployment.directory().path()};
}

/// What the peer read of each topic, decoded by the definitions of a distribution.
std::map<std::string, std::vector<json>> decoded(const std::string& printed,
                                                 const std::string& distro,
                                                 const std::vector<Topic>& topics,
                                                 const TestDeployment& deployment) {
  const auto file = deployment.directory().path() / "printed";
  std::ofstream(file) << printed;
  std::vector<std::string> arguments{QUOIN_MSGS_DIR, file, distro};
  for (const Topic& topic : topics) arguments.push_back(topic.name + "=" + topic.type);
  std::istringstream lines(run_script("decode.mjs", arguments, deployment));
  std::map<std::string, std::vector<json>> messages;
  for (std::string line; std::getline(lines, line);) {
    const json each = json::parse(line);
    messages[each.at("topic")].push_back(each.at("message"));
  }
  return messages;
}

std::int64_t stamp_of(const json& header) {
  return header.at("stamp").at("sec").get<std::int64_t>() * 1'000'000'000 +
         header.at("stamp").at("nsec").get<std::int64_t>();
}

/// Our messages by their stamps.
template <class T>
std::map<std::int64_t, T> by_stamp(const std::vector<T>& messages) {
  std::map<std::int64_t, T> all;
  for (const T& message : messages) all[message.header().stamp()] = message;
  return all;
}

/// The same fields with the same values; numbers as near as single precision prints them.
void expect_same(const json& theirs, const json& ours, const std::string& path) {
  if (ours.is_object()) {
    ASSERT_TRUE(theirs.is_object()) << path;
    EXPECT_EQ(theirs.size(), ours.size()) << path;
    for (const auto& [key, value] : ours.items()) {
      ASSERT_TRUE(theirs.contains(key)) << path << "." << key;
      expect_same(theirs.at(key), value, path + "." + key);
    }
  } else if (ours.is_array()) {
    ASSERT_EQ(theirs.size(), ours.size()) << path;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      expect_same(theirs[i], ours[i], path + "[" + std::to_string(i) + "]");
    }
  } else if (ours.is_number_float()) {
    ASSERT_TRUE(theirs.is_number()) << path;
    EXPECT_NEAR(theirs.get<double>(), ours.get<double>(),
                1e-6 * (1.0 + std::abs(ours.get<double>())))
        << path;
  } else {
    EXPECT_EQ(theirs, ours) << path;
  }
}

TEST_F(Ros2, EveryMessageIsReadByItsNameTypeAndQosAndDecodesToWhatTheServicesGave) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 20, frame: laser}})" +
                                  chain_of_scans + R"(
  - {name: columns, kind: circle_fitting, input: walls}
  - {name: ros, kind: ros2_output, inputs: all, parameters: {prefix: robot, base_frame: base_link, mounting_x: 0.2}}
)");
  const std::vector<Topic> topics{
      {"/robot/front/scan", "sensor_msgs/msg/LaserScan", "best_effort"},
      {"/robot/markers", "visualization_msgs/msg/MarkerArray", "reliable"},
      {"/tf_static", "tf2_msgs/msg/TFMessage", "latched"},
      {"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", "reliable"},
      {"/robot/front/numbers/scan", "quoin_msgs/msg/Scan", "best_effort"},
      {"/robot/walls/numbers/segments", "quoin_msgs/msg/Segments", "reliable"},
      {"/robot/lines/numbers/lines", "quoin_msgs/msg/Lines", "reliable"},
      {"/robot/corners/numbers/corners", "quoin_msgs/msg/Corners", "reliable"},
      {"/robot/columns/numbers/circles", "quoin_msgs/msg/Circles", "reliable"}};
  runtime::Participant participant(deployment.participant("test"));
  Recorder<msg::Scan> scans(participant, deployment, "front");
  Recorder<msg::Lines> lines(participant, deployment, "lines");
  Recorder<msg::Corners> corners(participant, deployment, "corners");
  const Process peer = reader_of(topics, deployment);
  const Up up(deployment);
  const auto enough = [&] {
    return std::ranges::all_of(topics, [&](const Topic& topic) {
      return count_of(peer.output(), "sample " + topic.name + " ") >=
             (topic.qos == "latched" ? 1U : 2U);
    });
  };
  const auto all = [&] {
    scans.poll();
    lines.poll();
    corners.poll();
    return enough();
  };
  ASSERT_TRUE(tests::eventually(all, 60s)) << up.errors() << peer.errors();
  std::string printed = peer.output();
  printed.resize(printed.rfind('\n') + 1);  // it goes on printing
  // What came last is known to the recorders, too, soon.
  const std::size_t last = corners.messages().size() + 2;
  ASSERT_TRUE(corners.poll_until([&] {
    scans.poll();
    lines.poll();
    return corners.messages().size() >= last;
  }));

  for (const Topic& topic : topics) {
    const std::string announced = "writer " + topic.name + " " + ros2::dds_type_name(topic.type) +
                                  " typehash=RIHS01_" +
                                  std::string(ros2::topic_type(topic.type).hash) + ";";
    EXPECT_THAT(printed, HasSubstr(announced));
  }
  const auto our_scans = by_stamp(scans.messages());
  const auto our_lines = by_stamp(lines.messages());
  const auto our_corners = by_stamp(corners.messages());
  for (const std::string distro : {"jazzy", "humble"}) {
    auto messages = decoded(printed, distro, topics, deployment);
    for (const Topic& topic : topics) EXPECT_FALSE(messages[topic.name].empty()) << topic.name;

    // All fields of our own messages.
    std::size_t compared = 0;
    for (const json& theirs : messages["/robot/lines/numbers/lines"]) {
      const auto ours = our_lines.find(theirs.at("header").at("stamp").get<std::int64_t>());
      if (ours == our_lines.end()) continue;
      expect_same(theirs, topics::to_json(ours->second), "lines");
      ++compared;
    }
    EXPECT_GE(compared, 2U);
    compared = 0;
    for (const json& theirs : messages["/robot/corners/numbers/corners"]) {
      const auto ours = our_corners.find(theirs.at("header").at("stamp").get<std::int64_t>());
      if (ours == our_corners.end()) continue;
      expect_same(theirs, topics::to_json(ours->second), "corners");
      ++compared;
    }
    EXPECT_GE(compared, 2U);

    // Scans have the same beams, and only ranges that were measured.
    std::set<std::size_t> beams;
    for (const json& theirs : messages["/robot/front/scan"]) {
      EXPECT_EQ(theirs.at("header").at("frame_id"), "laser");
      beams.insert(theirs.at("ranges").size());
      const auto ours = our_scans.find(stamp_of(theirs.at("header")));
      if (ours == our_scans.end()) continue;
      std::set<float> measured(ours->second.ranges().begin(), ours->second.ranges().end());
      for (const json& range : theirs.at("ranges")) {
        EXPECT_TRUE(!range.is_number() || measured.contains(range.get<float>())) << range;
      }
    }
    EXPECT_EQ(beams.size(), 1U);

    // Markers are where the lines and corners are, one namespace a service.
    std::set<std::string> namespaces;
    for (const json& array : messages["/robot/markers"]) {
      for (const json& marker : array.at("markers")) {
        namespaces.insert(marker.at("ns"));
        const auto ours = our_lines.find(stamp_of(marker.at("header")));
        if (marker.at("ns") != "lines" || ours == our_lines.end()) continue;
        const auto& segments = ours->second.lines();
        ASSERT_EQ(marker.at("points").size(), 2 * segments.size());
        for (std::size_t i = 0; i < segments.size(); ++i) {
          EXPECT_DOUBLE_EQ(marker.at("points")[2 * i].at("x"), segments[i].start().x());
          EXPECT_DOUBLE_EQ(marker.at("points")[2 * i].at("y"), segments[i].start().y());
          EXPECT_DOUBLE_EQ(marker.at("points")[2 * i + 1].at("x"), segments[i].end().x());
        }
        EXPECT_EQ(marker.at("type"), 5);
        EXPECT_EQ(marker.at("lifetime").at("sec"), 1);
        EXPECT_EQ(marker.at("pose").at("orientation").at("w"), 1.0);
      }
    }
    EXPECT_THAT(namespaces, testing::IsSupersetOf({"walls", "lines", "corners"}));

    const json& mounting = messages["/tf_static"].front().at("transforms")[0];
    EXPECT_EQ(mounting.at("header").at("frame_id"), "base_link");
    EXPECT_EQ(mounting.at("child_frame_id"), "laser");
    EXPECT_EQ(mounting.at("transform").at("translation").at("x"), 0.2);
    EXPECT_EQ(mounting.at("transform").at("rotation").at("w"), 1.0);

    std::set<std::string> reported;
    for (const json& status : messages["/diagnostics"].back().at("status")) {
      reported.insert(status.at("name"));
      EXPECT_EQ(status.at("level"), 0) << status;
    }
    EXPECT_EQ(reported.size(), 6U);
  }
}

void expect_estimate(const json& theirs, const msg::PoseEstimate& ours) {
  const json& pose = theirs.at("pose");
  EXPECT_EQ(pose.at("position"), (json{{"x", ours.x()}, {"y", ours.y()}, {"z", 0.0}}));
  EXPECT_EQ(pose.at("orientation").at("x"), 0.0);
  EXPECT_EQ(pose.at("orientation").at("y"), 0.0);
  EXPECT_NEAR(2.0 * std::atan2(pose.at("orientation").at("z").get<double>(),
                               pose.at("orientation").at("w").get<double>()),
              ours.theta(), 1e-12);
  std::vector<double> expected(36, 0.0);
  const auto at = [&](std::size_t row, std::size_t column, double value) {
    expected[6 * row + column] = expected[6 * column + row] = value;
  };
  at(0, 0, ours.covariance_xx());
  at(0, 1, ours.covariance_xy());
  at(1, 1, ours.covariance_yy());
  at(0, 5, ours.covariance_x_theta());
  at(1, 5, ours.covariance_y_theta());
  at(5, 5, ours.covariance_theta());
  EXPECT_EQ(theirs.at("covariance").get<std::vector<double>>(), expected);
}

msg::LineMap map_of(std::int64_t stamp, const std::vector<std::array<double, 4>>& walls) {
  msg::LineMap map;
  map.header().stamp(stamp);
  map.header().frame("map");
  map.parts(1);
  map.begun(1);
  map.version(1);
  for (const auto& [x1, y1, x2, y2] : walls) {
    msg::MapLine& wall = map.lines().emplace_back();
    wall.id(map.lines().size() - 1);
    wall.start().x(x1);
    wall.start().y(y1);
    wall.end().x(x2);
    wall.end().y(y2);
  }
  return map;
}

TEST_F(Ros2, PosesOdometryTransformsAndMapsGoOutAndDecodeFieldByField) {
  const std::string own = tests::test_namespace();
  const TestDeployment deployment(
      "\n  - {name: wheels, kind: external, type: odometry, topic: " + own +
      "/wheels}\n  - {name: where, kind: external, type: pose, topic: " + own +
      "/where}\n  - {name: house, kind: external, type: line_map, topic: " + own + "/house}\n" + R"(
  - {name: ros, kind: ros2_output, inputs: [wheels, where, house],
     parameters: {prefix: robot, odometry_tf: true, transform_tolerance: 0.25 s, grid_resolution: 0.1 m, marker_width: 0.05 m}}
)");
  const std::vector<Topic> topics{
      {"/robot/wheels/odom", "nav_msgs/msg/Odometry", "reliable"},
      {"/robot/where/pose", "geometry_msgs/msg/PoseWithCovarianceStamped", "reliable"},
      {"/tf", "tf2_msgs/msg/TFMessage", "reliable"},
      {"/robot/house/markers", "visualization_msgs/msg/MarkerArray", "latched"},
      {"/robot/house/grid", "nav_msgs/msg/OccupancyGrid", "latched"},
      {"/robot/wheels/numbers/odometry", "quoin_msgs/msg/Odometry", "reliable"},
      {"/robot/where/numbers/pose", "quoin_msgs/msg/Pose", "reliable"},
      {"/robot/house/numbers/line_map", "quoin_msgs/msg/LineMap", "reliable"}};
  runtime::Participant participant(deployment.participant("test"));
  const auto qos = [&](const std::string& name) {
    return runtime::output_qos(deployment.deployment().service(name), deployment.output(name));
  };
  runtime::Writer<msg::Odometry> wheels(participant, deployment.topic("wheels"), qos("wheels"));
  runtime::Writer<msg::Pose> where(participant, deployment.topic("where"), qos("where"));
  runtime::Writer<msg::LineMap> house(participant, deployment.topic("house"), qos("house"));
  const Process peer = reader_of(topics, deployment);
  const Up up(deployment);
  const auto matched = [&] {
    return std::ranges::all_of(topics, [&](const Topic& topic) {
      return count_of(peer.output(), "writer " + topic.name + " ") > 0;
    });
  };
  ASSERT_TRUE(tests::eventually(matched, 60s)) << up.errors() << peer.errors();
  for (runtime::WriterBase* writer :
       {static_cast<runtime::WriterBase*>(&wheels), static_cast<runtime::WriterBase*>(&where),
        static_cast<runtime::WriterBase*>(&house)}) {
    ASSERT_TRUE(writer->wait_for_readers(1, 30s)) << up.errors();
  }

  constexpr std::int64_t stamp = 1'700'000'000'250'000'000;
  msg::Odometry moved;
  moved.header().stamp(stamp);
  moved.header().frame("odom");
  moved.child_frame("base_link");
  moved.pose(estimate(1.0, 2.0, 0.5));
  moved.velocity_known(true);
  moved.velocity_x(0.5);
  moved.velocity_y(-0.25);
  moved.velocity_theta(0.125);
  msg::Pose found;
  found.header().stamp(stamp);
  found.header().frame("map");
  found.child_frame("base_link");
  found.pose(estimate(4.0, -3.0, 0.5 + 1.5707963267948966));
  found.weak_direction(std::nan(""));
  found.lines(7);
  found.matched(6);
  msg::Pose lost = found;
  lost.header().stamp(stamp + 1);
  lost.status(msg::PoseStatus::POSE_LOST);
  const msg::LineMap walls = map_of(stamp, {{0.05, 0.05, 2.05, 0.05}, {2.05, 0.05, 2.05, 1.05}});
  // Again and again: a reader that has just been matched may miss the first messages.
  const auto arrived = [&] {
    EXPECT_TRUE(wheels.write(moved) && where.write(lost) && where.write(found) &&
                house.write(walls));
    std::this_thread::sleep_for(50ms);
    return std::ranges::all_of(topics, [&](const Topic& topic) {
      return count_of(peer.output(), "sample " + topic.name + " ") >= 4;
    });
  };
  ASSERT_TRUE(tests::eventually(arrived, 30s)) << up.errors() << peer.output();
  std::string printed = peer.output();
  printed.resize(printed.rfind('\n') + 1);

  const json same_stamp{{"sec", 1'700'000'000}, {"nsec", 250'000'000}};
  for (const std::string distro : {"jazzy", "humble"}) {
    auto messages = decoded(printed, distro, topics, deployment);
    for (const Topic& topic : topics) ASSERT_FALSE(messages[topic.name].empty()) << topic.name;

    const json& odometry = messages["/robot/wheels/odom"][0];
    EXPECT_EQ(odometry.at("header"), (json{{"stamp", same_stamp}, {"frame_id", "odom"}}));
    EXPECT_EQ(odometry.at("child_frame_id"), "base_link");
    expect_estimate(odometry.at("pose"), moved.pose());
    EXPECT_EQ(odometry.at("twist").at("twist"),
              (json{{"linear", {{"x", 0.5}, {"y", -0.25}, {"z", 0.0}}},
                    {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", 0.125}}}}));
    EXPECT_EQ(odometry.at("twist").at("covariance").get<std::vector<double>>(),
              std::vector<double>(36, 0.0));

    // A lost pose is none.
    for (const json& pose : messages["/robot/where/pose"]) {
      EXPECT_EQ(pose.at("header"), (json{{"stamp", same_stamp}, {"frame_id", "map"}}));
      expect_estimate(pose.at("pose"), found.pose());
    }

    std::map<std::string, json> transforms;  // by child
    for (const json& message : messages["/tf"]) {
      for (const json& each : message.at("transforms"))
        transforms[each.at("child_frame_id")] = each;
    }
    ASSERT_EQ(transforms.size(), 2U);
    const json& base = transforms.at("base_link");
    EXPECT_EQ(base.at("header"), (json{{"stamp", same_stamp}, {"frame_id", "odom"}}));
    EXPECT_EQ(base.at("transform").at("translation"), (json{{"x", 1.0}, {"y", 2.0}, {"z", 0.0}}));
    EXPECT_NEAR(base.at("transform").at("rotation").at("z").get<double>(), std::sin(0.25), 1e-12);
    EXPECT_NEAR(base.at("transform").at("rotation").at("w").get<double>(), std::cos(0.25), 1e-12);
    // A quarter of a turn, that takes (1, 2) to (-2, 1), and then to (4, -3); dated later by the
    // tolerance.
    const json& odom = transforms.at("odom");
    EXPECT_EQ(odom.at("header"), (json{{"stamp", {{"sec", 1'700'000'000}, {"nsec", 500'000'000}}},
                                       {"frame_id", "map"}}));
    const json& translation = odom.at("transform").at("translation");
    EXPECT_NEAR(translation.at("x").get<double>(), 6.0, 1e-12);
    EXPECT_NEAR(translation.at("y").get<double>(), -4.0, 1e-12);
    EXPECT_EQ(translation.at("z"), 0.0);
    const json& rotation = odom.at("transform").at("rotation");
    EXPECT_EQ(rotation.at("x"), 0.0);
    EXPECT_EQ(rotation.at("y"), 0.0);
    EXPECT_NEAR(rotation.at("z").get<double>(), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(rotation.at("w").get<double>(), std::sqrt(0.5), 1e-12);

    ASSERT_EQ(messages["/robot/house/markers"].back().at("markers").size(), 1U);
    const json& marker = messages["/robot/house/markers"].back().at("markers")[0];
    EXPECT_EQ(marker.at("header"), (json{{"stamp", same_stamp}, {"frame_id", "map"}}));
    EXPECT_EQ(marker.at("ns"), "house");
    EXPECT_EQ(marker.at("type"), 5);    // LINE_LIST
    EXPECT_EQ(marker.at("action"), 0);  // ADD
    EXPECT_EQ(marker.at("lifetime").at("sec"), 0);
    EXPECT_EQ(marker.at("scale").at("x"), 0.05);
    EXPECT_EQ(marker.at("color").at("a"), 1.0);
    const auto point = [](double x, double y) { return json{{"x", x}, {"y", y}, {"z", 0.0}}; };
    EXPECT_EQ(marker.at("points"),
              (json{point(0.05, 0.05), point(2.05, 0.05), point(2.05, 0.05), point(2.05, 1.05)}));

    // The walls with a metre around them and the origin: 40 by 30 cells and a bit.
    const json& grid = messages["/robot/house/grid"].back();
    EXPECT_EQ(grid.at("header"), (json{{"stamp", same_stamp}, {"frame_id", "map"}}));
    const json& info = grid.at("info");
    EXPECT_EQ(info.at("map_load_time"), same_stamp);
    EXPECT_FLOAT_EQ(info.at("resolution").get<float>(), 0.1F);
    EXPECT_EQ(info.at("origin").at("position"), point(-1.0, -1.0));
    EXPECT_EQ(info.at("origin").at("orientation").at("w"), 1.0);
    const auto width = info.at("width").get<std::size_t>();
    const auto height = info.at("height").get<std::size_t>();
    EXPECT_EQ(width, 41U);
    EXPECT_EQ(height, 31U);
    const auto cells = grid.at("data").get<std::vector<int>>();
    ASSERT_EQ(cells.size(), width * height);
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        const bool wall =
            (row == 10 && column >= 10 && column <= 30) || (column == 30 && row >= 10 && row <= 20);
        EXPECT_EQ(cells[row * width + column], wall ? 100 : -1) << row << " " << column;
      }
    }

    expect_same(messages["/robot/wheels/numbers/odometry"][0], topics::to_json(moved), "odometry");
    expect_same(messages["/robot/house/numbers/line_map"][0], topics::to_json(walls), "map");
    json ours = topics::to_json(found);
    const auto& poses = messages["/robot/where/numbers/pose"];
    const auto same = std::ranges::find_if(poses, [&](const json& each) {
      return each.at("header").at("stamp").get<std::int64_t>() == stamp;
    });
    ASSERT_NE(same, poses.end());
    json theirs = *same;
    for (const char* other :
         {"weak_direction", "status"}) {  // NaN and a name have no number in JSON
      ours.erase(other);
      theirs.erase(other);
    }
    expect_same(theirs, ours, "pose");
  }
}

TEST_F(Ros2, StampsOfZeroOrOfAnotherClockAreCountedAndNamedAndTheStreamGoesOn) {
  const TestDeployment deployment(
      "\n  - {name: front, kind: ros2_scan, parameters: {topic: /scan, reliability: reliable}}" +
      chain_of_scans);
  {
    std::ofstream file(deployment.directory().path() / "scans");
    const std::string rest = " -1 1 0.5 0 0 0.1 10 5 1 2 3 4 5\n";
    file << "laser@0:0" << rest << "laser@12:500000000" << rest << "laser@12:500000000" << rest
         << "-@13:0" << rest
         << "rear@14:0 -1 1 0.5 0 0 0.1 10 5 1 2 3 4 5 47 48\n";  // two intensities
  }
  runtime::Participant participant(deployment.participant("test"));
  Recorder<msg::Scan> scans(participant, deployment, "front");
  StatusRecorder status(participant, deployment);
  const Up up(deployment);
  ASSERT_TRUE(scans.wait_for_writer()) << up.errors();
  Process ros("ros2_peer",
              {"write", domain_of(deployment), "/scan", "reliable", "1", "20", "5",
               deployment.directory().path() / "scans"},
              deployment.directory().path());
  ASSERT_TRUE(scans.wait_for(5)) << up.errors() << ros.errors();
  const auto& messages = scans.messages();
  EXPECT_GT(messages[0].header().stamp(), 1'700'000'000'000'000'000) << "when it came";
  EXPECT_EQ(messages[1].header().stamp(), 12'500'000'000) << "simulated time stays";
  EXPECT_EQ(messages[3].header().frame(), "");
  EXPECT_EQ(messages[4].header().frame(), "rear");
  ASSERT_TRUE(status.wait_for("front", [](const auto& s) {
    return s.published() == 5 && !diagnostic(s, "differ in length").empty();
  })) << ros.errors();
  const msg::ServiceStatus& latest = status.latest("front");
  EXPECT_EQ(diagnostic(latest, "stamp is 0"), "1 scans, last 0");
  EXPECT_EQ(diagnostic(latest, "an hour"), "4 scans, last 4");
  EXPECT_EQ(diagnostic(latest, "not later"), "2 scans, last 2");
  EXPECT_EQ(diagnostic(latest, "no frame_id"), "1 scans, last 3");
  EXPECT_EQ(diagnostic(latest, "differ in length"), "1 scans, last 4");
}

TEST_F(Ros2, OdometryComesInAndWhatIsOddOfItIsCountedAndNamed) {
  const TestDeployment deployment(
      "\n  - {name: wheels, kind: ros2_odometry, parameters: {topic: /odom}}\n");
  {
    std::ofstream file(deployment.directory().path() / "odometry");
    const std::string rest = " 0.01 0.002 0.03 0.004 -0.005 0.06 0.5 0.1 0.2 0.04\n";
    const std::string turned = " 0 0 0.6 0.8";  // by 2 atan2(0.6, 0.8)
    file << "odom@1700000000:5 base_link 1.5 -2" << turned << rest
         << "odom@1700000001:0 base_link 1 2 0 0 0 0" << rest                  // no rotation
         << "odom@1700000002:0 base_link nan 2" << turned << rest              // no number
         << "odom@1700000003:0 base_link 1 2 0.6 0 0 0.8" << rest              // rolls by 74 deg
         << "-@1700000004:0 - 1 2" << turned << rest                           // no frames
         << "odom@0:0 base_link 1 2" << turned << rest                         // no stamp
         << "odom@1700000006:0 base_link 3 4 0 0 0 1 -1 0 0 0 0 0 1 2 3 -1\n"  // nothing known
         << "odom@1700000007:0 base_link 5 6" << turned << rest;
  }
  runtime::Participant participant(deployment.participant("test"));
  Recorder<msg::Odometry> odometry(participant, deployment, "wheels");
  StatusRecorder status(participant, deployment);
  const Up up(deployment);
  ASSERT_TRUE(odometry.wait_for_writer()) << up.errors();
  Process ros("ros2_peer",
              {"odometry", domain_of(deployment), "/odom", "1", "20",
               deployment.directory().path() / "odometry"},
              deployment.directory().path());
  ASSERT_TRUE(odometry.wait_for(6)) << up.errors() << ros.errors();
  const msg::Odometry& first = odometry.messages().front();
  EXPECT_EQ(first.header().stamp(), 1'700'000'000'000'000'005);
  EXPECT_EQ(first.header().frame(), "odom");
  EXPECT_EQ(topics::source(first.header()), "wheels");
  EXPECT_EQ(first.child_frame(), "base_link");
  EXPECT_EQ(first.pose().x(), 1.5);
  EXPECT_EQ(first.pose().y(), -2.0);
  EXPECT_NEAR(first.pose().theta(), 2.0 * std::atan2(0.6, 0.8), 1e-12);
  EXPECT_EQ(first.pose().covariance_xx(), 0.01);
  EXPECT_EQ(first.pose().covariance_xy(), 0.002);
  EXPECT_EQ(first.pose().covariance_yy(), 0.03);
  EXPECT_EQ(first.pose().covariance_x_theta(), 0.004);
  EXPECT_EQ(first.pose().covariance_y_theta(), -0.005);
  EXPECT_EQ(first.pose().covariance_theta(), 0.06);
  EXPECT_TRUE(first.velocity_known());
  EXPECT_EQ(first.velocity_x(), 0.5);
  EXPECT_EQ(first.velocity_y(), 0.1);
  EXPECT_EQ(first.velocity_theta(), 0.2);
  const msg::Odometry& unknown = odometry.messages()[4];
  EXPECT_EQ(unknown.pose().x(), 3.0);
  EXPECT_EQ(unknown.pose().covariance_xx(), 0.0);
  EXPECT_FALSE(unknown.velocity_known());
  EXPECT_EQ(odometry.messages()[5].pose().x(), 5.0);
  ASSERT_TRUE(status.wait_for("wheels", [](const auto& s) {
    return s.published() == 6 && !diagnostic(s, "stamp is 0").empty();
  })) << ros.errors();
  const msg::ServiceStatus& latest = status.latest("wheels");
  for (const std::string fault : {"no rotation", "that is no number", "roll or pitch",
                                  "no frame_id or child_frame_id", "stamp is 0"}) {
    EXPECT_EQ(diagnostic(latest, fault), "1 messages") << fault;
  }
}

TEST_F(Ros2, TheScansOfTwoRecordedSensorsBecomeCornersAndMarkersAndNoneIsLost) {
  const char* folder = std::getenv("QUOIN_DATA_DIR");
  const std::filesystem::path bag =
      std::filesystem::path(folder != nullptr ? folder : QUOIN_DEFAULT_DATA_DIR) /
      "rosbag1/obstacle_detector_scans_demo.bag";
  if (!std::filesystem::exists(bag)) {
    GTEST_SKIP() << "no recording " << bag << "; set QUOIN_DATA_DIR to run this test";
  }
  const std::map<std::string, std::size_t> sensors{{"front", 331}, {"rear", 330}};
  std::string services;
  for (const auto& [name, scans] : sensors) {
    services += "\n  - {name: " + name + ", kind: ros2_scan, parameters: {topic: /" + name +
                "_scan, reliability: reliable}}\n  - {name: " + name +
                "_walls, kind: segmentation, input: " + name + "}\n  - {name: " + name +
                "_lines, kind: line_fitting, input: " + name + "_walls}\n  - {name: " + name +
                "_corners, kind: corner_estimation, input: " + name + "_lines}";
  }
  const TestDeployment deployment(
      services + "\n  - {name: ros, kind: ros2_output, inputs: [front_corners, rear_corners]}\n",
      "qos: lossless\n");
  for (const auto& [name, scans] : sensors) {
    std::ofstream(deployment.directory().path() / name)
        << run_script("bag_scans.mjs", {bag, "/" + name + "_scan"}, deployment);
  }
  runtime::Participant participant(deployment.participant("test"));
  CornerRecorder front(participant, deployment, "front_corners");
  CornerRecorder rear(participant, deployment, "rear_corners");
  const std::string markers = "/" + deployment.deployment().name_space + "/markers";
  const Process peer(
      "ros2_peer",
      {"read", domain_of(deployment), markers, "visualization_msgs/msg/MarkerArray", "reliable"},
      deployment.directory().path());
  const Up up(deployment);
  ASSERT_TRUE(front.wait_for_writer() && rear.wait_for_writer()) << up.errors();
  ASSERT_TRUE(tests::eventually([&] { return count_of(peer.output(), "writer") > 0; }));
  std::vector<Process> drivers;
  for (const auto& [name, scans] : sensors) {
    drivers.emplace_back("ros2_peer",
                         std::vector<std::string>{
                             "write", domain_of(deployment), "/" + name + "_scan", "reliable", "1",
                             "30", std::to_string(scans), deployment.directory().path() / name},
                         deployment.directory().path());
  }
  ASSERT_TRUE(front.poll_until(
      [&] {
        rear.poll();
        return front.messages().size() >= 331 && rear.messages().size() >= 330;
      },
      60s))
      << front.messages().size() << " " << rear.messages().size() << up.errors();
  EXPECT_EQ(front.accounting().lost() + rear.accounting().lost(), 0U);
  EXPECT_EQ(front.messages().front().header().frame(), "front_scanner");
  EXPECT_TRUE(tests::eventually([&] { return count_of(peer.output(), "sample") >= 661; }));
  EXPECT_EQ(count_of(peer.output(), "sample"), 661U);
}

TEST_F(Ros2, ARecordingOfTheTopicsOfRos2OpensElsewhereWithTheSchemasOfRos2) {
  const TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 20, frame: laser}})" +
                                  chain_of_scans + R"(
  - {name: ros, kind: ros2_output, inputs: all, parameters: {prefix: robot, base_frame: base_link}}
)");
  const auto file = deployment.directory().path() / "ros.mcap";
  const Up up(deployment);
  Process recording(deployment.quoin({"record", "FILE", "--ros", "-o", file, "--json"}));
  // What stands for a driver, whose scans are recorded, too.
  Process driver("ros2_peer",
                 {"write", domain_of(deployment), "/scan", "best_effort", "1", "20", "40"},
                 deployment.directory().path());
  ASSERT_EQ(driver.wait(60s), 0) << driver.errors() << recording.errors();
  recording.signal(SIGINT);
  ASSERT_EQ(recording.wait(20s), 0) << recording.errors();
  const json summary = json::parse(recording.output());
  EXPECT_EQ(summary.at("files"), json{file.string()});

  const std::map<std::string, std::string> expected{
      {"/scan", "sensor_msgs/msg/LaserScan"},
      {"/robot/front/scan", "sensor_msgs/msg/LaserScan"},
      {"/robot/markers", "visualization_msgs/msg/MarkerArray"},
      {"/tf_static", "tf2_msgs/msg/TFMessage"},
      {"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"},
      {"/robot/front/numbers/scan", "quoin_msgs/msg/Scan"},
      {"/robot/walls/numbers/segments", "quoin_msgs/msg/Segments"},
      {"/robot/lines/numbers/lines", "quoin_msgs/msg/Lines"},
      {"/robot/corners/numbers/corners", "quoin_msgs/msg/Corners"}};
  for (const std::string distro : {"jazzy", "humble"}) {
    std::istringstream lines(
        run_script("mcap_messages.mjs", {QUOIN_MSGS_DIR, file, distro}, deployment));
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(json::parse(line), (json{{"profile", "ros2"}}));
    std::map<std::string, std::string> types;
    std::map<std::string, std::size_t> counts;
    std::set<std::size_t> beams;
    while (std::getline(lines, line)) {
      const json each = json::parse(line);
      const std::string topic = each.at("topic");
      types[topic] = each.at("type");
      ++counts[topic];
      const json& message = each.at("message");
      if (topic == "/robot/front/scan") {
        EXPECT_EQ(message.at("header").at("frame_id"), "laser");
        beams.insert(message.at("ranges").size());
      }
      if (topic == "/tf_static") {
        EXPECT_EQ(message.at("transforms")[0].at("child_frame_id"), "laser");
      }
      if (topic == "/robot/corners/numbers/corners") {
        EXPECT_EQ(message.at("header").at("origins")[0].at("source"), "front");
      }
    }
    EXPECT_EQ(types, expected);
    EXPECT_EQ(beams, std::set<std::size_t>{920});
    EXPECT_EQ(counts["/scan"], 40U);
    for (const auto& [topic, count] : counts) {
      EXPECT_EQ(summary.at("topics").at(topic).at("recorded"), count) << topic;
      EXPECT_EQ(summary.at("topics").at(topic).at("missed"), 0) << topic;
    }
  }
}

/// What ros2_graph_peer printed.
struct Discovered {
  struct Node {
    std::set<std::string> readers;  // GUIDs
    std::set<std::string> writers;
    friend bool operator==(const Node&, const Node&) = default;
  };
  std::map<std::string, std::string> participants;            // user data by GUID
  std::map<std::string, std::map<std::string, Node>> graphs;  // by participant, by name: newest
  std::map<std::string, std::string> readers, writers;        // topic by GUID
  std::set<std::string> hashes;                               // of ros_discovery_info

  explicit Discovered(const std::string& printed) {
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) take(line);
  }

  void take(const std::string& line) {
    std::istringstream words(line);
    std::string word, guid, name;
    words >> word >> guid >> name;
    if (word == "participant") participants[guid] = name;
    if (word == "gone") readers.erase(guid), writers.erase(guid);
    if (word == "graph") graphs[guid].clear();
    if (word == "reader" && name.starts_with("rt/")) readers[guid] = name;
    if (word == "writer" && name.starts_with("rt/")) writers[guid] = name;
    if (word == "writer" && name == "ros_discovery_info") {
      std::string user_data;
      words >> user_data;
      hashes.insert(user_data);
    }
    if (word != "node") return;
    Node& node = graphs[guid][name];
    std::set<std::string>* gids = nullptr;
    while (words >> word) {
      if (word == "reads" || word == "writes") {
        gids = word == "reads" ? &node.readers : &node.writers;
      } else {
        gids->insert(word.substr(0, 32));
        EXPECT_EQ(word.find_first_not_of('0', 32), std::string::npos) << word;
      }
    }
  }

  /// The node of that name, in whichever participant.
  [[nodiscard]] Node node(const std::string& name) const {
    for (const auto& [participant, nodes] : graphs) {
      if (const auto found = nodes.find(name); found != nodes.end()) return found->second;
    }
    return {};
  }
};

template <class Map>
std::set<std::string> keys_of(const Map& map) {
  std::set<std::string> keys;
  for (const auto& [key, value] : map) keys.insert(key);
  return keys;
}

class Ros2Graph : public Ros2, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Distro, Ros2Graph, testing::Values("humble", "iron", "jazzy"),
                         [](const auto& distro) { return distro.param; });

TEST_P(Ros2Graph, ServicesAreNodesWithTheReadersAndWritersThatDdsDiscovers) {
  const bool humble = GetParam() == "humble";
  const TestDeployment deployment(
      R"(
  - {name: front, kind: ros2_scan, parameters: {topic: /scan}}
  - {name: walls, kind: segmentation, input: front}
  - {name: ros, kind: ros2_output, inputs: [front, walls]}
)",
      "ros: {distro: " + GetParam() + "}\nprocesses: {bridge: [front, ros]}\n");
  const Process peer("ros2_graph_peer", {domain_of(deployment), humble ? "humble" : "iron"},
                     deployment.directory().path());
  const std::string name_space = "/" + deployment.deployment().name_space + "/";
  {
    const Up up(deployment);
    // scan, markers, diagnostics, and the numbers of scans and segments; and the reader of /scan.
    const auto complete = [&] {
      const Discovered now(peer.output());
      return now.readers.size() == 1 && now.writers.size() == 5 && now.graphs.size() == 2 &&
             now.node(name_space + "front").readers == keys_of(now.readers) &&
             now.node(name_space + "ros").writers == keys_of(now.writers);
    };
    EXPECT_TRUE(tests::eventually(complete, 30s)) << peer.output() << up.errors();
    const Discovered found(peer.output());
    EXPECT_EQ(found.readers.begin()->second, "rt/scan");
    EXPECT_EQ(found.node(name_space + "front").writers.size(), 0U);
    EXPECT_EQ(found.node(name_space + "ros").readers.size(), 0U);
    EXPECT_EQ(found.node(name_space + "walls"), Discovered::Node{});
    std::set<std::string> names;
    for (const auto& [participant, nodes] : found.graphs) {
      for (const auto& [name, node] : nodes) {
        names.insert(name);
        const auto theirs = [&, prefix = participant.substr(0, 24)](const std::string& gid) {
          return gid.starts_with(prefix);
        };
        EXPECT_TRUE(std::ranges::all_of(node.readers, theirs)) << name;
        EXPECT_TRUE(std::ranges::all_of(node.writers, theirs)) << name;
      }
      // The Gid is that of the participant, which says that it is one of ROS 2.
      const std::string guid = participant.substr(0, 32);
      ASSERT_TRUE(found.participants.contains(guid)) << guid;
      EXPECT_EQ(found.participants.at(guid), "enclave=/;");
      EXPECT_EQ(participant.size(), humble ? 48U : 32U);
    }
    EXPECT_EQ(names, (std::set{name_space + "front", name_space + "ros", name_space + "walls"}));
    EXPECT_EQ(
        found.hashes,
        std::set<std::string>{
            humble ? ""
                   : "typehash=RIHS01_" +
                         std::string(
                             ros2::topic_type("rmw_dds_common/msg/ParticipantEntitiesInfo").hash) +
                         ";"});
  }
  EXPECT_TRUE(tests::eventually([&] {
    const Discovered after(peer.output());
    return after.readers.empty() && after.writers.empty();
  })) << peer.output();
}

TEST_F(Ros2, WithoutADistributionNothingIsAnnounced) {
  const TestDeployment deployment(R"(
  - {name: front, kind: ros2_scan, parameters: {topic: /scan}}
  - {name: ros, kind: ros2_output, inputs: [front]}
)");
  const Process peer("ros2_graph_peer", {domain_of(deployment), "iron"},
                     deployment.directory().path());
  const Up up(deployment);
  ASSERT_TRUE(tests::eventually([&] { return Discovered(peer.output()).writers.size() == 3; }, 30s))
      << peer.output();
  EXPECT_THAT(peer.output(), testing::Not(HasSubstr("graph ")));
  EXPECT_THAT(peer.output(), testing::Not(HasSubstr("enclave")));
  EXPECT_TRUE(Discovered(peer.output()).hashes.empty());
}

TEST_F(Ros2, HashesOfTypesAreThoseOfTheDefinitions) {
  const TestDeployment deployment("\n  - {name: front, kind: simulated}\n");
  std::vector<std::string> arguments{QUOIN_MSGS_DIR};
  std::vector<std::string> expected;
  for (const ros2::TopicType& type : ros2::topic_types()) {
    arguments.emplace_back(type.name);
    expected.push_back(std::string(type.name) + " " + std::string(type.hash));
  }
  std::istringstream printed(run_script("type_hash.mjs", arguments, deployment));
  std::vector<std::string> computed;
  for (std::string line; std::getline(printed, line);) computed.push_back(line);
  EXPECT_THAT(computed, UnorderedElementsAreArray(expected));
}

}  // namespace
}  // namespace quoin
