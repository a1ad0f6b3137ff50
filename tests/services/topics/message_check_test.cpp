// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/header.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
std::string refusal_of(const T& message) {
  RawMessage raw;
  encode(message, raw);
  return message_check(type_name<T>())->refusal(raw.cdr).value_or("");
}

msg::Header header() {
  msg::Header header;
  set_origin(header, "front", 1'700'000'000'000'000'000, 7);
  header.frame("laser");
  header.stamp(1'700'000'001'000'000'000);
  msg::StageTrace& trace = header.trace().emplace_back();
  trace.service("front");
  trace.incarnation(1'700'000'000'000'000'000);
  trace.index(7);
  return header;
}

msg::Scan scan() {
  msg::Scan scan;
  scan.header(header());
  scan.sensor_model().range_stddev(0.01);
  scan.range_max(30.0F);
  scan.bearings({0.0F, 0.1F, 0.2F});
  scan.ranges({1.0F, std::numeric_limits<float>::infinity(), std::nanf("")});
  return scan;
}

msg::Segments segments() {
  msg::Segments segments;
  segments.header(header());
  segments.scan_points(10);
  segments.bearings().assign(10, 0.5F);
  segments.ranges().assign(10, 2.0F);
  segments.segments().resize(2);
  segments.segments()[0].end(4);
  segments.segments()[1].begin(4);
  segments.segments()[1].end(8);
  segments.arcs().resize(1);
  segments.arcs()[0].begin(8);
  segments.arcs()[0].end(10);
  return segments;
}

msg::Lines lines() {
  msg::Lines lines;
  lines.header(header());
  lines.covariance_mode("propagated");
  msg::Line& line = lines.lines().emplace_back();
  line.alpha(0.5);
  line.r(2.0);
  line.covariance_direction(1e-6);
  line.covariance_direction_offset(1e-6);
  line.covariance_offset(1e-4);
  line.covariance_alpha(1e-6);
  line.covariance_alpha_r(-1e-5);
  line.covariance_r(1.01e-4);
  line.points(50);
  return lines;
}

// The covariances of a type cannot be forgotten.
TEST(MessageCheck, EveryTopicTypeIsCheckedAndSoIsEachOfItsCovariances) {
  for (const TopicType& row : topic_types()) {
    SCOPED_TRACE(row.name);
    EXPECT_NE(message_check(row.dds_type), nullptr);
    for (const IdlType& type : parse_idl(idl_text(row.idl)).types) {
      std::set<std::string> checked;
      for (const IdlField& field : type.fields) {
        for (const IdlLimit& limit : field.limits) {
          if (limit.name != "covariance" && limit.name != "semidefinite") continue;
          checked.insert(limit.arguments.begin(), limit.arguments.end());
        }
      }
      for (const IdlField& field : type.fields) {
        if (!field.name.starts_with("covariance_") || field.name == "covariance_mode") continue;
        EXPECT_TRUE(checked.contains(field.name))
            << type.name << "." << field.name << " is in no //@covariance(...) or "
            << "//@semidefinite(...) of " << row.idl;
      }
    }
  }
  EXPECT_NE(message_check("quoin::msg::ServiceStatus"), nullptr);
  EXPECT_EQ(message_check("quoin::msg::Nothing"), nullptr);
}

TEST(MessageCheck, TakesWhatServicesSend) {
  EXPECT_EQ(refusal_of(scan()), "");
  EXPECT_EQ(refusal_of(segments()), "");
  EXPECT_EQ(refusal_of(lines()), "");
  EXPECT_EQ(refusal_of(msg::Corners()), "");
  EXPECT_EQ(refusal_of(msg::Circles()), "");
  EXPECT_EQ(refusal_of(msg::ServiceStatus()), "");
}

TEST(MessageCheck, TakesEitherByteOrder) {
  msg::Lines message = lines();
  for (double& variance : {std::ref(message.lines()[0].covariance_r())}) {
    for (const double value : {1.01e-4, -1.0}) {
      variance = value;
      // A structure of doubles and 64-bit numbers alone would do; here each field is turned round.
      RawMessage raw;
      encode(message, raw);
      EXPECT_EQ(message_check("quoin::msg::Lines")->refusal(raw.cdr).has_value(), value < 0.0);
      raw.cdr[1] ^= std::byte{1};  // says that it is of the other order, which it is not
      EXPECT_TRUE(message_check("quoin::msg::Lines")->refusal(raw.cdr).has_value());
    }
  }
  // A header of the other order: no origins, the stamp 1, frame "a", no trace.
  const std::vector<unsigned char> big{0, 0, 0, 0, 0, 0, 0, 0, 0,   0, 0, 0, 0, 0, 0, 0,
                                       0, 0, 0, 1, 0, 0, 0, 2, 'a', 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(message_check("quoin::msg::Header")->refusal(std::as_bytes(std::span(big))),
            std::nullopt);
}

TEST(MessageCheck, RefusesNumbersOutsideTheirLimitsByName) {
  msg::Scan message = scan();
  message.sensor_model().range_bias_stddev(1e300);
  EXPECT_EQ(refusal_of(message), "sensor_model.range_bias_stddev: out of range");
  message = scan();
  message.sensor_model().range_stddev(std::nan(""));
  EXPECT_EQ(refusal_of(message), "sensor_model.range_stddev: not finite");
  message = scan();
  message.bearings()[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal_of(message), "bearings: not finite");
  message = scan();
  topics::set_origin(message.header(), "front", 1, std::uint64_t{1} << 60U);
  EXPECT_EQ(refusal_of(message), "header.origins.sequence_number: out of range");
  message = scan();
  message.header().trace()[0].published(std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(refusal_of(message), "header.trace.published: out of range");
}

TEST(MessageCheck, RefusesWhatIsMoreThanAnySensorGives) {
  msg::Scan message = scan();
  message.bearings().resize(1'000'000);
  message.ranges().resize(1'000'000);
  EXPECT_EQ(refusal_of(message), "bearings: too long");
  message = scan();
  message.header().trace().resize(60'000);
  EXPECT_EQ(refusal_of(message), "header.trace: too long");
}

TEST(MessageCheck, RefusesFieldsThatDoNotFitEachOther) {
  msg::Scan message = scan();
  message.ranges().pop_back();
  EXPECT_EQ(refusal_of(message), "ranges: of another length");
  message = scan();
  message.qualities({1.0F});
  EXPECT_EQ(refusal_of(message), "qualities: of another length");
  message.qualities({1.0F, 0.5F, 0.0F});
  EXPECT_EQ(refusal_of(message), "");
}

TEST(MessageCheck, RefusesSegmentsThatOverlapOrLieOutsideThePoints) {
  msg::Segments message = segments();
  message.segments()[1].begin(3);
  EXPECT_EQ(refusal_of(message), "segments: not ascending");
  message = segments();
  message.segments()[0].begin(5);
  EXPECT_EQ(refusal_of(message), "segments: not ascending");
  message = segments();
  message.arcs()[0].end(11);
  EXPECT_EQ(refusal_of(message), "arcs: out of range");
  message = segments();
  message.arcs()[0].begin(7);
  EXPECT_EQ(refusal_of(message), "arcs: not apart");
  message = segments();
  message.set_aside(11);
  EXPECT_EQ(refusal_of(message), "set_aside: out of range");
}

TEST(MessageCheck, RefusesWhatIsNoCovariance) {
  for (const double variance : {-1.0, 0.0, infinity}) {
    msg::Lines message = lines();
    message.lines()[0].covariance_r(variance);
    EXPECT_NE(refusal_of(message), "") << variance;
  }
  msg::Lines message = lines();
  message.lines()[0].covariance_direction_offset(2e-5);
  EXPECT_EQ(refusal_of(message), "lines.covariance_direction: no covariance");
  // As good as determined by each other, but for the last digits.
  message = lines();
  message.lines()[0].covariance_direction(1e-6 / 3.0);
  message.lines()[0].covariance_offset(3e-6);
  message.lines()[0].covariance_direction_offset(1e-6 * (1.0 + 1e-14));
  EXPECT_EQ(refusal_of(message), "");
  // Each pair of these three may be, all together cannot.
  msg::Circles circles;
  msg::Circle& circle = circles.circles().emplace_back();
  circle.covariance_xx(1.0);
  circle.covariance_yy(1.0);
  circle.covariance_radius(1.0);
  circle.covariance_xy(0.9);
  circle.covariance_x_radius(0.9);
  circle.covariance_y_radius(-0.9);
  EXPECT_EQ(refusal_of(circles), "circles.covariance_xx: no covariance");
  circle.covariance_y_radius(0.9);
  EXPECT_EQ(refusal_of(circles), "");
}

TEST(MessageCheck, ZeroMayMeanThatNothingIsKnown) {
  msg::Odometry odometry;
  EXPECT_EQ(refusal_of(odometry), "");
  odometry.pose().covariance_xx(1.0);
  odometry.pose().covariance_theta(1e-4);
  odometry.pose().covariance_x_theta(1e-3);
  EXPECT_EQ(refusal_of(odometry), "");
  odometry.pose().covariance_y_theta(1e-3);  // of y nothing is known
  EXPECT_EQ(refusal_of(odometry), "pose.covariance_xx: no covariance");
  odometry.pose().covariance_y_theta(0.0);
  odometry.pose().covariance_yy(-1e-9);
  EXPECT_EQ(refusal_of(odometry), "pose.covariance_xx: no covariance");
}

TEST(MessageCheck, RefusesTextThatDoesMoreThanShow) {
  for (const std::string text : {"front\nerror: all is lost", "\x1b[2J", "\xc3(",
                                 "\xc2\x9b"
                                 "2J",
                                 "\xe2\x80\xae"
                                 "reversed",
                                 "\xed\xa0\x80"}) {
    msg::Scan message = scan();
    message.header().trace()[0].service(text);
    EXPECT_EQ(refusal_of(message), "header.trace.service: not printable") << text;
  }
  msg::Scan message = scan();
  message.header().frame("l\xc3\xa4ser");
  EXPECT_EQ(refusal_of(message), "");
  message.header().frame(std::string(5000, 'x'));
  EXPECT_EQ(refusal_of(message), "header.frame: too long");
  msg::ServiceStatus status;
  status.detail("robot.yaml:1:1: first\nrobot.yaml:2:1: second");
  EXPECT_EQ(refusal_of(status), "");
  status.detail("\x1b]0;title\x07");
  EXPECT_EQ(refusal_of(status), "detail: not printable");
}

TEST(MessageCheck, RefusesEveryBeginningAndWhatGoesOn) {
  RawMessage raw;
  encode(segments(), raw);
  const MessageCheck& check = *message_check("quoin::msg::Segments");
  ASSERT_EQ(check.refusal(raw.cdr), std::nullopt);
  const std::span<const std::byte> bytes(raw.cdr);
  for (std::size_t size = 0; size + 4 < bytes.size(); ++size) {
    EXPECT_TRUE(check.refusal(bytes.first(size)).has_value()) << size;
  }
  raw.cdr.resize(raw.cdr.size() + 4);
  EXPECT_EQ(check.refusal(raw.cdr), "bytes left over");
  EXPECT_EQ(message_check("quoin::msg::Header")->refusal_of_beginning(raw.cdr), std::nullopt);
}

TEST(MessageCheck, WhatIsTakenCanBeRead) {
  RawMessage raw;
  encode(segments(), raw);
  const MessageCheck& check = *message_check("quoin::msg::Segments");
  std::size_t taken = 0;
  for (std::size_t i = 4; i < raw.cdr.size(); ++i) {
    for (const int bit : {0, 3, 6, 7}) {
      RawMessage changed = raw;
      changed.cdr[i] ^= static_cast<std::byte>(1 << bit);
      if (check.refusal(changed.cdr)) continue;
      ++taken;
      msg::Segments message;
      ASSERT_TRUE(decode(changed, message)) << i;
      ASSERT_EQ(message.bearings().size(), message.ranges().size());
      for (const msg::IndexRange& range : message.segments()) {
        ASSERT_LE(range.begin(), range.end());
        ASSERT_LE(range.end(), message.ranges().size());
      }
    }
  }
  EXPECT_GT(taken, 100U);
}

TEST(MessageCheck, AnIdlThatContradictsItselfIsAnError) {
  const auto check = [](const std::string& field) {
    MessageCheck(parse_idl("struct T { sequence<float> x; double y; " + field + "\n };"), "T");
  };
  EXPECT_NO_THROW(check("sequence<float> z; //@same_length(x) [m]"));
  EXPECT_THROW(check("sequence<float> z; //@same_length(w)"), std::logic_error);
  EXPECT_THROW(check("sequence<float> z; //@same_length(y)"), std::logic_error);
  EXPECT_THROW(check("sequence<float> z; //@index_ranges(x)"), std::logic_error);
  EXPECT_THROW(check("double z; //@range(0)"), std::logic_error);
  EXPECT_THROW(check("double z; //@ragne(0, 1)"), std::logic_error);
  EXPECT_THROW(check("string z; //@range(0, 1)"), std::logic_error);
  EXPECT_THROW(check("double z; //@covariance(y, z)"), std::logic_error);
}

}  // namespace
}  // namespace quoin::topics
