// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_codec.hpp"

#include <cmath>
#include <idl/Circles.h>
#include <idl/Control.h>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "services/topics/header.hpp"
#include "services/topics/message_json.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {
namespace {

using Json = nlohmann::ordered_json;

void fill(msg::Header& header) {
  set_origin(header, "front", 5, 42);
  header.stamp(-7);
  header.frame("laser");
  header.trace().resize(1);
  header.trace()[0].service("front");
  header.trace()[0].input("in");
  header.trace()[0].method("none");
  header.trace()[0].incarnation(5);
  header.trace()[0].index(std::numeric_limits<std::uint64_t>::max());
  header.trace()[0].received(3);
  header.trace()[0].published(4);
}

const char* const header_json =
    R"("header":{"origins":[{"source":"front","incarnation":5,"sequence_number":42,"part":0,)"
    R"("parts":1}],"stamp":-7,"frame":"laser","trace":[{"service":"front","input":"in",)"
    R"("method":"none","incarnation":5,"index":18446744073709551615,"received":3,"published":4}]})";

const char* const model_json =
    R"("sensor_model":{"range_stddev":0.01,"bearing_stddev":0.002,"range_bias_stddev":0.0,)"
    R"("range_stddev_per_metre":0.0125,"flatness_stddev":0.0,"estimated":false})";

void fill(msg::SensorModel& model) {
  model.range_stddev(0.01);
  model.bearing_stddev(0.002);
  model.range_stddev_per_metre(0.0125);
}

msg::Scan a_scan() {
  msg::Scan scan;
  fill(scan.header());
  fill(scan.sensor_model());
  scan.range_min(0.1F);
  scan.range_max(40.0F);
  scan.bearings({-0.2F, 0.3F, 1e-7F});
  scan.ranges({INFINITY, NAN, 1.7F});
  return scan;
}

/// With a header that somebody can have sent.
msg::Scan a_sent_scan() {
  msg::Scan scan = a_scan();
  scan.header().stamp(7);
  scan.header().trace()[0].index(42);
  return scan;
}

TEST(CdrCodec, JsonOfAScan) {
  EXPECT_EQ(to_json(a_scan()).dump(),
            std::string("{") + header_json + "," + model_json +
                R"(,"range_min":0.1,"range_max":40.0,"duration":0.0,"bearings":[-0.2,0.3,1e-07],)"
                R"("ranges":[null,null,1.7],"qualities":[],"time_offsets":[]})");
}

TEST(CdrCodec, JsonOfSegments) {
  msg::Segments segments;
  fill(segments.header());
  fill(segments.sensor_model());
  segments.scan_points(720);
  segments.bearings({0.5F});
  segments.ranges({2.5F});
  segments.segments().resize(1);
  segments.segments()[0].end(1);
  EXPECT_EQ(to_json(segments).dump(),
            std::string("{") + header_json + "," + model_json +
                R"(,"scan_points":720,"bearings":[0.5],"ranges":[2.5],)"
                R"("segments":[{"begin":0,"end":1}],"arcs":[],"set_aside":0,"no_return":0})");
}

TEST(CdrCodec, JsonOfLines) {
  msg::Lines lines;
  fill(lines.header());
  fill(lines.sensor_model());
  lines.covariance_mode("propagated");
  lines.lines().resize(1);
  lines.lines()[0].alpha(0.25);
  lines.lines()[0].r(2.0);
  lines.lines()[0].start().x(1.0);
  lines.lines()[0].end().y(-1.0);
  lines.lines()[0].points(9);
  lines.lines()[0].chi_square(NAN);
  lines.failures().resize(1);
  lines.failures()[0].segment(1);
  lines.failures()[0].reason("too_few_points");
  EXPECT_EQ(to_json(lines).dump(),
            std::string("{") + header_json + "," + model_json +
                R"(,"covariance_mode":"propagated","lines":[{"alpha":0.25,"r":2.0,)"
                R"("covariance_direction":0.0,"covariance_direction_offset":0.0,)"
                R"("covariance_offset":0.0,)"
                R"("covariance_alpha":0.0,"covariance_alpha_r":0.0,"covariance_r":0.0,)"
                R"("gaussian":false,)"
                R"("start":{"x":1.0,"y":0.0},"end":{"x":0.0,"y":-1.0},"points":9,)"
                R"("chi_square":null,"segment":0}],)"
                R"("failures":[{"segment":1,"reason":"too_few_points"}]})");
}

TEST(CdrCodec, JsonOfCorners) {
  msg::Corners corners;
  fill(corners.header());
  corners.covariance_mode("as_published");
  corners.corners().resize(1);
  corners.corners()[0].x(1.5);
  corners.corners()[0].extrapolation(0.125);
  corners.corners()[0].second_line(1);
  EXPECT_EQ(to_json(corners).dump(),
            std::string("{") + header_json +
                R"(,"covariance_mode":"as_published","corners":[{"x":1.5,"y":0.0,)"
                R"("covariance_xx":0.0,"covariance_xy":0.0,"covariance_yy":0.0,"ellipse_area":0.0,)"
                R"("ellipse95_major":0.0,"ellipse95_minor":0.0,"ellipse95_direction":0.0,)"
                R"("angle":0.0,"opening":0.0,"gap":0.0,"extrapolation":0.125,"seen":false,)"
                R"("first_line":0,"second_line":1}],"without":[]})");
}

TEST(CdrCodec, JsonOfCircles) {
  msg::Circles circles;
  fill(circles.header());
  fill(circles.sensor_model());
  circles.circles().resize(1);
  circles.circles()[0].x(1.5);
  circles.circles()[0].radius(0.25);
  circles.circles()[0].covariance_y_radius(-0.5);
  circles.circles()[0].concave(true);
  circles.circles()[0].points(12);
  circles.circles()[0].arc(2);
  circles.failures().resize(1);
  circles.failures()[0].arc(1);
  circles.failures()[0].reason("not_determined");
  EXPECT_EQ(to_json(circles).dump(),
            std::string("{") + header_json + "," + model_json +
                R"(,"circles":[{"x":1.5,"y":0.0,"radius":0.25,"covariance_xx":0.0,)"
                R"("covariance_xy":0.0,"covariance_yy":0.0,"covariance_x_radius":0.0,)"
                R"("covariance_y_radius":-0.5,"covariance_radius":0.0,"arc_start":0.0,)"
                R"("arc_end":0.0,"concave":true,"points":12,"chi_square":0.0,)"
                R"("nonlinearity":0.0,"arc":2}],)"
                R"("failures":[{"arc":1,"reason":"not_determined"}]})");
}

const char* const zero_covariance_json =
    R"("covariance_xx":0.0,"covariance_xy":0.0,"covariance_yy":0.0,)"
    R"("covariance_x_theta":0.0,"covariance_y_theta":0.0,"covariance_theta":0.0)";

TEST(CdrCodec, JsonOfOdometry) {
  msg::Odometry odometry;
  fill(odometry.header());
  odometry.child_frame("base_link");
  odometry.pose().x(1.5);
  odometry.pose().theta(-0.25);
  odometry.velocity_known(true);
  odometry.velocity_theta(2.0);
  EXPECT_EQ(to_json(odometry).dump(),
            std::string("{") + header_json +
                R"(,"child_frame":"base_link","pose":{"x":1.5,"y":0.0,"theta":-0.25,)" +
                zero_covariance_json +
                R"(},"velocity_known":true,"velocity_x":0.0,"velocity_y":0.0,)"
                R"("velocity_theta":2.0})");
}

TEST(CdrCodec, JsonOfAPose) {
  msg::Pose pose;
  fill(pose.header());
  pose.child_frame("base_link");
  pose.pose().y(2.5);
  pose.status(msg::PoseStatus::POSE_LOST);
  pose.weak_direction(NAN);
  pose.lines(7);
  pose.matched(3);
  EXPECT_EQ(to_json(pose).dump(),
            std::string("{") + header_json +
                R"(,"child_frame":"base_link","pose":{"x":0.0,"y":2.5,"theta":0.0,)" +
                zero_covariance_json +
                R"(},"status":"POSE_LOST","weak_direction":null,"odometry":false,)"
                R"("lines":7,"matched":3})");
}

TEST(CdrCodec, JsonOfALineMap) {
  msg::LineMap map;
  fill(map.header());
  map.part(1);
  map.parts(2);
  map.begun(9);
  map.version(4);
  map.lines().resize(1);
  map.lines()[0].id(130);
  map.lines()[0].end().x(2.0);
  map.lines()[0].covariance_offset(0.5);
  map.lines()[0].observations(6);
  EXPECT_EQ(to_json(map).dump(),
            std::string("{") + header_json +
                R"(,"part":1,"parts":2,"begun":9,"version":4,"lines":[{"id":130,)"
                R"("start":{"x":0.0,"y":0.0},"end":{"x":2.0,"y":0.0},"covariance_direction":0.0,)"
                R"("covariance_direction_offset":0.0,"covariance_offset":0.5,)"
                R"("observations":6}]})");
}

TEST(CdrCodec, JsonOfTypesOutsideTheTable) {
  msg::ServiceStatus status;
  status.state(msg::STATE_ACTIVE);
  status.incompatible_qos({"a", ""});
  EXPECT_EQ(to_json(status)["state"], "STATE_ACTIVE");
  EXPECT_EQ(to_json(status)["incompatible_qos"], Json({"a", ""}));
  msg::ControlRequest request;
  request.state({0, 255});
  request.drop_state(true);
  EXPECT_EQ(to_json(request)["state"], Json({0, 255}));
  EXPECT_EQ(to_json(request)["drop_state"], true);
}

TEST(CdrCodec, TypesHaveTheNamesThatTheTableHas) {
  EXPECT_EQ(type_name<msg::Scan>(), find_topic_type("scan")->dds_type);
  EXPECT_EQ(type_name<msg::Segments>(), find_topic_type("segments")->dds_type);
  EXPECT_EQ(type_name<msg::Lines>(), find_topic_type("lines")->dds_type);
  EXPECT_EQ(type_name<msg::Corners>(), find_topic_type("corners")->dds_type);
  EXPECT_EQ(type_name<msg::Circles>(), find_topic_type("circles")->dds_type);
  EXPECT_EQ(type_name<msg::Odometry>(), find_topic_type("odometry")->dds_type);
  EXPECT_EQ(type_name<msg::Pose>(), find_topic_type("pose")->dds_type);
  EXPECT_EQ(type_name<msg::LineMap>(), find_topic_type("line_map")->dds_type);
  EXPECT_EQ(cdr_codec<msg::Scan>().type_name, "quoin::msg::Scan");
  EXPECT_FALSE(cdr_codec<msg::Scan>().keyed);
  EXPECT_TRUE(cdr_codec<msg::ServiceStatus>().keyed);
  EXPECT_TRUE(cdr_codec<msg::LineMap>().keyed);
}

TEST(CdrCodec, BytesAreThoseOfTheStandard) {
  msg::Failure failure;
  failure.segment(7);
  failure.reason("few");
  RawMessage raw;
  encode(failure, raw);
  const std::vector<int> expected{0, 1, 0, 0, 7, 0, 0, 0, 4, 0, 0, 0, 'f', 'e', 'w', 0};
  ASSERT_EQ(raw.cdr.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::to_integer<int>(raw.cdr[i]), expected[i]) << i;
  }
  failure.reason("");
  encode(failure, raw);
  EXPECT_EQ(raw.cdr.size(), 16U) << "13 bytes, filled up";
}

TEST(CdrCodec, AMessageComesBackAsItWas) {
  msg::Scan scan = a_sent_scan();
  scan.ranges({1.0F});  // NaN would not be equal to itself
  RawMessage raw;
  encode(scan, raw);
  msg::Scan back;
  ASSERT_TRUE(decode(raw, back));
  EXPECT_TRUE(back == scan);
  msg::Header header;
  ASSERT_TRUE(read_header(raw, header));
  EXPECT_TRUE(header == scan.header());
}

TEST(CdrCodec, TooFewBytesAreNoMessageAndNoHeader) {
  RawMessage whole;
  encode(a_sent_scan(), whole);
  RawMessage headers;
  encode(a_sent_scan().header(), headers);
  RawMessage cut;
  msg::Scan scan;
  msg::Header header;
  // What is left out at the end may be padding, of a sequence without elements.
  for (std::size_t size = 0; size < whole.cdr.size(); ++size) {
    cut.cdr.assign(whole.cdr.begin(), whole.cdr.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(decode(cut, scan)) << size;
    EXPECT_EQ(read_header(cut, header), size >= headers.cdr.size()) << size;
  }
}

TEST(CdrCodec, BytesOfStrangersDoNoHarm) {
  RawMessage whole;
  encode(a_scan(), whole);
  std::mt19937 random(3);
  msg::Scan scan;
  msg::Header header;
  for (int round = 0; round < 20'000; ++round) {
    RawMessage raw = whole;
    for (int change = 0; change < 4; ++change) {
      raw.cdr[random() % raw.cdr.size()] = static_cast<std::byte>(random());
    }
    (void)decode(raw, scan);
    (void)read_header(raw, header);
  }
  RawMessage other_representation = whole;
  other_representation.cdr[1] = std::byte{7};
  EXPECT_FALSE(decode(other_representation, scan));
  EXPECT_FALSE(read_header(other_representation, header));
}

}  // namespace
}  // namespace quoin::topics
