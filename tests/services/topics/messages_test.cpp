// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "services/topics/corners.hpp"
#include "services/topics/lines.hpp"
#include "services/topics/poses.hpp"
#include "services/topics/segments.hpp"

namespace quoin::topics {
namespace {

TEST(Messages, SensorModelGoesThereAndBack) {
  const SensorModel model{0.01, 0.002, 0.05, 0.008, 0.003};
  const SensorModel back = sensor_model(sensor_model_message(model));
  EXPECT_EQ(back.range_stddev, 0.01);
  EXPECT_EQ(back.bearing_stddev, 0.002);
  EXPECT_EQ(back.range_bias_stddev, 0.05);
  EXPECT_EQ(back.range_stddev_per_metre, 0.008);
  EXPECT_EQ(back.flatness_stddev, 0.003);
}

TEST(Messages, ASensorHasTheNoiseOfItsWireAtLeast) {
  const SensorModel model = sensor_model(msg::SensorModel());
  EXPECT_GT(model.range_stddev_per_metre, 0.0);
  EXPECT_LT(model.range_stddev_per_metre, 1e-7);
}

TEST(Messages, SegmentsWithRangesOutsideThePointsAreInvalid) {
  msg::Segments message;
  message.bearings().resize(10);
  message.ranges().resize(10);
  message.segments().resize(1);
  message.segments()[0].begin(2);
  message.segments()[0].end(10);
  EXPECT_TRUE(valid(message));
  message.segments()[0].end(11);
  EXPECT_FALSE(valid(message));
  message.segments()[0].begin(9);
  message.segments()[0].end(8);
  EXPECT_FALSE(valid(message));
  message.segments().clear();
  message.arcs().resize(1);
  message.arcs()[0].end(11);
  EXPECT_FALSE(valid(message));
  message.arcs().clear();
  message.set_aside(11);
  EXPECT_FALSE(valid(message));
  message.set_aside(0);
  message.ranges().resize(9);
  EXPECT_FALSE(valid(message));
}

TEST(Messages, LinesGoThereAndBack) {
  // The wall x = 2 seen at y = -1 and y = 1.
  const std::vector<double> range{std::sqrt(5.0), std::sqrt(5.0)};
  const std::vector<double> bearing{std::atan2(-1.0, 2.0), std::atan2(1.0, 2.0)};
  const std::vector<double> inverse_range{1.0 / range[0], 1.0 / range[1]};
  const std::vector<double> cosine{2.0 / range[0], 2.0 / range[1]};
  const std::vector<double> sine{-1.0 / range[0], 1.0 / range[1]};
  const std::vector<double> x{2.0, 2.0};
  const std::vector<double> y{-1.0, 1.0};
  const PointsView points{range, bearing, inverse_range, cosine, sine, x, y};
  LineEstimate estimate{{0.0, 2.0}, Eigen::Matrix2d::Zero()};
  estimate.covariance << 1e-4, 2e-5, 2e-5, 3e-4;

  msg::Lines message;
  append_line(line_segment(estimate, points), chi_square(estimate.line, points, SensorModel{}), 7,
              message);
  append_failure(FitFailure::through_sensor, 8, message);
  ASSERT_EQ(message.lines().size(), 1U);
  EXPECT_EQ(message.lines()[0].segment(), 7U);
  EXPECT_EQ(message.lines()[0].points(), 2U);
  EXPECT_NEAR(message.lines()[0].chi_square(), 0.0, 1e-12);
  ASSERT_EQ(message.failures().size(), 1U);
  EXPECT_EQ(message.failures()[0].reason(), "through_sensor");

  std::vector<LineSegment> lines;
  line_segments(message, lines);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].estimate.line.r, 2.0);
  EXPECT_EQ(lines[0].estimate.covariance, estimate.covariance);  // seen about the foot
  EXPECT_EQ(lines[0].estimate.along, 0.0);
  EXPECT_NEAR(lines[0].start.y(), -1.0, 1e-12);
  EXPECT_NEAR(lines[0].end.y(), 1.0, 1e-12);
  EXPECT_EQ(lines[0].points, 2U);
}

// A wall off to one side: its middle is 3 m from the foot of the perpendicular.
TEST(Messages, LinesCarryTheirCovarianceAboutTheMiddle) {
  LineSegment line;
  line.estimate = {{0.0, 2.0}, Eigen::Matrix2d{{4e-4, 1e-5}, {1e-5, 1e-4}}, 3.0};
  line.start = {2.0, 2.5};
  line.end = {2.0, 3.5};
  msg::Lines message;
  message.covariance_mode("propagated");
  append_line(line, 0.0, 0, message);
  message.covariance_mode("as_published");
  append_line(line, 0.0, 1, message);
  const msg::Line& first = message.lines()[0];
  EXPECT_DOUBLE_EQ(first.covariance_direction(), 4e-4);
  EXPECT_DOUBLE_EQ(first.covariance_direction_offset(), 1e-5);
  EXPECT_DOUBLE_EQ(first.covariance_offset(), 1e-4);
  // dr = d(offset) + 3 dalpha, and r / 2 dalpha^2 besides.
  EXPECT_DOUBLE_EQ(first.covariance_alpha(), 4e-4);
  EXPECT_DOUBLE_EQ(first.covariance_alpha_r(), 1e-5 + 3.0 * 4e-4);
  const double first_order = 1e-4 + 6.0 * 1e-5 + 9.0 * 4e-4;
  EXPECT_DOUBLE_EQ(first.covariance_r(), first_order + 0.75 * 4.0 * 4e-4 * 4e-4);
  EXPECT_DOUBLE_EQ(message.lines()[1].covariance_r(), first_order);
  EXPECT_TRUE(first.gaussian());

  std::vector<LineSegment> lines;
  line_segments(message, lines);
  EXPECT_EQ(lines[0].estimate.covariance, line.estimate.covariance);
  EXPECT_DOUBLE_EQ(lines[0].estimate.along, 3.0);
}

TEST(Messages, CornersCarryTheirEllipses) {
  Corner corner;
  corner.estimate.position = {1.0, 2.0};
  corner.estimate.covariance << 4e-4, 0.0, 0.0, 1e-4;
  corner.first_line = 3;
  corner.second_line = 4;
  corner.seen = true;
  msg::Corners message;
  fill_corners({{corner}, {{4, 5, NoCornerReason::wide_gap}}}, "propagated", message);
  ASSERT_EQ(message.corners().size(), 1U);
  const msg::Corner& out = message.corners()[0];
  EXPECT_NEAR(out.ellipse_area(), 3.14159265358979 * 0.02 * 0.01, 1e-12);
  EXPECT_NEAR(out.ellipse95_major(), 0.02 * 2.447746830680816, 1e-9);
  EXPECT_NEAR(out.ellipse95_minor(), 0.01 * 2.447746830680816, 1e-9);
  EXPECT_NEAR(out.ellipse95_direction(), 0.0, 1e-9);
  EXPECT_EQ(out.second_line(), 4U);
  EXPECT_TRUE(out.seen());
  ASSERT_EQ(message.without().size(), 1U);
  EXPECT_EQ(message.without()[0].first_line(), 4U);
  EXPECT_EQ(message.without()[0].reason(), "wide_gap");
}

TEST(Messages, PosesGoThereAndBack) {
  PoseEstimate estimate{{1.0, -2.0, 0.5}, {}};
  estimate.covariance << 4.0, 0.5, 0.1, 0.5, 3.0, 0.2, 0.1, 0.2, 1.0;
  const msg::PoseEstimate message = pose_message(estimate);
  const PoseEstimate back = pose_estimate(message);
  EXPECT_EQ(back.pose.x, 1.0);
  EXPECT_EQ(back.pose.y, -2.0);
  EXPECT_EQ(back.pose.theta, 0.5);
  EXPECT_EQ(back.covariance, estimate.covariance);
  EXPECT_TRUE(valid(message));
}

TEST(Messages, PosesThatAreNoneAreInvalid) {
  msg::PoseEstimate message;
  EXPECT_TRUE(valid(message));
  message.x(std::nan(""));
  EXPECT_FALSE(valid(message));
  message.x(1e300);
  EXPECT_FALSE(valid(message));
  message.x(0.0);
  message.covariance_yy(-1.0);
  EXPECT_FALSE(valid(message));
  message.covariance_yy(INFINITY);
  EXPECT_FALSE(valid(message));
}

}  // namespace
}  // namespace quoin::topics
