// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Quoin beside programs of ROS 2. What stands for them: Cyclone DDS with types made by ROS 2's own
// tool (tests/interoperability/ros2), and another implementation of its serialization.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/ros2/topics.hpp"
#include "services/topics/header.hpp"
#include "services/topics/message_json.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;
using tests::CornerRecorder;
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
  std::vector<std::string> arguments{"read", domain_of(deployment)};
  for (const Topic& topic : topics) {
    arguments.insert(arguments.end(), {topic.name, topic.type, topic.qos});
  }
  const Process peer("ros2_peer", arguments, deployment.directory().path());
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
