// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quoin::topics {
namespace {

using Json = nlohmann::ordered_json;

const Json header = Json::parse(R"({
  "origins": [{"source": "front", "incarnation": 1, "sequence_number": 42, "part": 0, "parts": 1}],
  "stamp": 1500000000, "frame": "laser",
  "trace": [{"published": 1000000000}, {"published": 1001250000}]})");

Json with_header(const char* fields) {
  Json message = Json::parse(fields);
  message["header"] = header;
  return message;
}

TEST(MessageText, ScanCountsItsValidRanges) {
  EXPECT_EQ(to_text("quoin::msg::Scan",
                    with_header(R"({"range_min": 0.1, "range_max": 40.0, "duration": 0.1,
                                    "ranges": [0.0, 0.1, 1.0, 40.0, 41.0, null]})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 6 rays, 3 valid, in 0.100 s");
}

TEST(MessageText, SegmentsLinesAndCorners) {
  EXPECT_EQ(to_text("quoin::msg::Segments",
                    with_header(R"({"ranges": [1, 1, 1], "segments": [{"begin": 0, "end": 3}]})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 1 segments of 3 points: 0..3");
  EXPECT_EQ(to_text("quoin::msg::Segments",
                    with_header(R"({"ranges": [1, 1, 1, 1], "segments": [{"begin": 0, "end": 2}],
                                    "arcs": [{"begin": 2, "end": 3}], "no_return": 1})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 1 segments of 4 points, 1 of them no return: "
            "0..2; 1 arcs: 2..3");
  EXPECT_EQ(to_text("quoin::msg::Lines",
                    with_header(R"({"lines": [{"alpha": 1.5707963267948966, "r": 2.0, "points": 9}],
                                    "failures": [{"segment": 1, "reason": "too_few_points"}]})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 1 lines: alpha 90.00 deg r 2.000 m "
            "(9 points); segment 1 too_few_points;");
  EXPECT_EQ(to_text("quoin::msg::Corners",
                    with_header(R"({"corners": [{"x": 1.0, "y": -2.0, "covariance_xx": 1e-6,
                                                 "covariance_yy": 1e-6}]})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 1 corners: (1.000, -2.000) m sigma 1.00 mm;");
}

TEST(MessageText, CirclesAndArcsWithoutOne) {
  EXPECT_EQ(to_text("quoin::msg::Circles",
                    with_header(R"({"circles": [{"x": 1.0, "y": -2.0, "radius": 0.25, "points": 12,
                                                 "covariance_xx": 1e-6, "covariance_yy": 1e-6}],
                                    "failures": [{"arc": 1, "reason": "not_determined"}]})")),
            "front #42 stamp 1.500000 laser +1.25 ms: 1 circles: (1.000, -2.000) m radius 0.250 m "
            "sigma 1.00 mm (12 points); arc 1 not_determined;");
}

TEST(MessageText, OdometryAndPoses) {
  const char* const estimate = R"("pose": {"x": 1.0, "y": -2.0, "theta": 1.5707963267948966,
      "covariance_xx": 1e-6, "covariance_yy": 1e-6, "covariance_theta": 0.0})";
  const std::string known = "(1.000, -2.000) m 90.00 deg sigma 1.0 mm 0.000 deg";
  const auto fields = [&](const char* more) {
    return with_header(("{" + std::string(estimate) + ", " + more + "}").c_str());
  };
  EXPECT_EQ(to_text("quoin::msg::Odometry",
                    fields(R"("velocity_known": true, "velocity_x": 0.3, "velocity_y": 0.4,
                              "velocity_theta": 0.0)")),
            "front #42 stamp 1.500000 laser +1.25 ms: " + known + ", 0.500 m/s 0.00 deg/s");
  EXPECT_EQ(to_text("quoin::msg::Odometry", fields(R"("velocity_known": false)")),
            "front #42 stamp 1.500000 laser +1.25 ms: " + known);
  EXPECT_EQ(
      to_text("quoin::msg::Pose", fields(R"("status": "POSE_TRACKING", "lines": 7,
                                                  "matched": 5, "weak_direction": null)")),
      "front #42 stamp 1.500000 laser +1.25 ms: " + known + ", tracking, 5 of 7 lines in the map");
  EXPECT_EQ(to_text("quoin::msg::Pose", fields(R"("status": "POSE_AMBIGUOUS", "lines": 2,
                                                  "matched": 2, "weak_direction": 0.0)")),
            "front #42 stamp 1.500000 laser +1.25 ms: " + known +
                ", ambiguous along 0.0 deg, 2 of 2 lines in the map");
}

TEST(MessageText, PartsOfALineMap) {
  EXPECT_EQ(
      to_text("quoin::msg::LineMap", with_header(R"({"part": 0, "parts": 2, "version": 9, "lines": [
                        {"start": {"x": 0, "y": 0}, "end": {"x": 3, "y": 4}}]})")),
      "front #42 stamp 1.500000 laser +1.25 ms: version 9, part 1 of 2: 1 walls of 5.0 m");
}

TEST(MessageText, AnyOtherTypeShowsItsValues) {
  EXPECT_EQ(to_text("quoin::msg::New", with_header(R"({"pose": {"x": 1.5, "frame": "map"},
                                                       "points": [1, 2, 3], "valid": true})")),
            "front #42 stamp 1.500000 laser +1.25 ms: pose.x 1.5, pose.frame map, points[3], "
            "valid true");
  EXPECT_EQ(to_text("sensor_msgs::msg::dds_::Range_",
                    Json::parse(R"({"header": {"frame_id": "a"}, "range": null})")),
            "header.frame_id a, range null");
}

TEST(MessageText, AnotherVersionOfATypeShowsItsValues) {
  EXPECT_EQ(to_text("quoin::msg::Scan", Json::parse(R"({"header": {"sensor": "front"}})")),
            "header.sensor front");
  EXPECT_EQ(to_text("quoin::msg::Scan", with_header(R"({"ranges": 5})")).substr(0, 8), "ranges 5");
}

TEST(MessageText, ControlCharactersDoNotReachTheTerminal) {
  Json message{{"header", header}};
  message["header"]["frame"] = "\x1b[2J\n";
  EXPECT_EQ(to_text("quoin::msg::New", message),
            "front #42 stamp 1.500000 \\x1B[2J\\x0A +1.25 ms:");
}

}  // namespace
}  // namespace quoin::topics
