// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/scan_conversion.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::sensor_bridge::rplidar {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;
using testing::NanSensitiveFloatEq;

constexpr float pi = std::numbers::pi_v<float>;
constexpr float infinity = std::numeric_limits<float>::infinity();

constexpr std::uint32_t q16(std::uint32_t degrees) { return degrees << 16U; }

/// Clockwise from the front: ahead, right, behind, left.
Revolution four_samples() {
  Revolution revolution;
  revolution.angle_q16 = {q16(0), q16(90), q16(180), q16(270)};
  revolution.distance_q2 = {4000, 8000, 0, 2};
  revolution.quality = {255, 51, 0, 188};
  revolution.time_offset = {0.0F, 0.025F, 0.05F, 0.075F};
  return revolution;
}

TEST(ScanConversion, TurnsClockwiseDegreesIntoCounterClockwiseRadians) {
  msg::Scan scan;
  fill_rays(four_samples(), {}, scan);
  EXPECT_THAT(scan.bearings(),
              ElementsAre(FloatEq(0.0F), FloatEq(-pi / 2), FloatEq(pi), FloatEq(pi / 2)));
  EXPECT_THAT(scan.ranges(), ElementsAre(1.0F, 2.0F, infinity, FloatEq(0.0005F)));
  EXPECT_THAT(scan.qualities(), ElementsAre(1.0F, FloatEq(0.2F), 0.0F, FloatNear(0.737F, 0.001F)));
  EXPECT_THAT(scan.time_offsets(), ElementsAre(0.0F, 0.025F, 0.05F, 0.075F));
  EXPECT_FLOAT_EQ(scan.duration(), 0.075F);
}

TEST(ScanConversion, ADeviceUpsideDownTurnsTheOtherWay) {
  RplidarParameters parameters;
  parameters.inverted = true;
  msg::Scan scan;
  fill_rays(four_samples(), parameters, scan);
  EXPECT_THAT(scan.bearings(),
              ElementsAre(FloatEq(0.0F), FloatEq(pi / 2), FloatEq(pi), FloatEq(-pi / 2)));
}

TEST(ScanConversion, TheDevicesZeroIsWhereTheOffsetPutsIt) {
  RplidarParameters parameters;
  parameters.angle_offset = std::numbers::pi;
  msg::Scan scan;
  fill_rays(four_samples(), parameters, scan);
  EXPECT_THAT(scan.bearings(), ElementsAre(FloatNear(pi, 1e-6F), FloatNear(pi / 2, 1e-6F),
                                           FloatNear(0.0F, 1e-6F), FloatNear(-pi / 2, 1e-6F)));
  parameters.inverted = true;
  parameters.angle_offset = 1.0;
  fill_rays(four_samples(), parameters, scan);
  EXPECT_THAT(scan.bearings(),
              ElementsAre(FloatNear(1.0F, 1e-6F), FloatNear(1.0F + pi / 2, 1e-6F),
                          FloatNear(1.0F - pi, 1e-6F), FloatNear(1.0F - pi / 2, 1e-6F)));
}

TEST(ScanConversion, BearingsStayWithinHalfATurnEitherWay) {
  Revolution revolution;
  revolution.angle_q16 = {1, q16(180) - 1, q16(180), q16(180) + 1, full_circle_q16 - 1};
  revolution.distance_q2.assign(5, 4000);
  revolution.quality.assign(5, 0);
  revolution.time_offset.assign(5, 0.0F);
  msg::Scan scan;
  for (const bool inverted : {false, true}) {
    RplidarParameters parameters;
    parameters.inverted = inverted;
    fill_rays(revolution, parameters, scan);
    for (const float bearing : scan.bearings()) {
      EXPECT_GT(bearing, -pi);
      EXPECT_LE(bearing, pi);
    }
    EXPECT_NEAR(std::abs(scan.bearings()[1]), pi, 1e-6);
    EXPECT_NEAR(scan.bearings()[4], 0.0F, 1e-6);
  }
}

TEST(ScanConversion, SortsIntoBinsOnlyWhenAskedAndKeepsTheNearest) {
  Revolution revolution;
  // 359.9 deg belongs to the bin of 0 deg.
  revolution.angle_q16 = {q16(1), q16(2), q16(89), full_circle_q16 - 6554};
  revolution.distance_q2 = {8000, 4000, 0, 12000};
  revolution.quality = {10, 255, 0, 30};
  revolution.time_offset = {0.001F, 0.002F, 0.02F, 0.09F};
  RplidarParameters parameters;
  parameters.bins = 4;
  msg::Scan scan;
  fill_rays(revolution, parameters, scan);
  EXPECT_THAT(scan.bearings(),
              ElementsAre(FloatEq(0.0F), FloatEq(-pi / 2), FloatEq(pi), FloatEq(pi / 2)));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(scan.ranges(),
              ElementsAre(1.0F, infinity, NanSensitiveFloatEq(nan), NanSensitiveFloatEq(nan)));
  EXPECT_FLOAT_EQ(scan.qualities()[0], 1.0F);
  EXPECT_FLOAT_EQ(scan.time_offsets()[0], 0.002F);
  EXPECT_FLOAT_EQ(scan.time_offsets()[1], 0.02F);
}

TEST(ScanConversion, DeclaresWhatTheDeviceSaysUnlessTold) {
  const ScanMode mode{.id = 1,
                      .name = "DenseBoost",
                      .sample_period = 108e-6,
                      .range_max = 40.0,
                      .format = SampleFormat::dense};
  RplidarParameters parameters;
  EXPECT_FLOAT_EQ(declared_scan(parameters, mode).range_max(), 40.0F);
  parameters.range_max = 12.0;
  parameters.range_stddev = 0.02;
  parameters.frame = "lidar_link";
  const msg::Scan scan = declared_scan(parameters, mode);
  EXPECT_FLOAT_EQ(scan.range_max(), 12.0F);
  EXPECT_DOUBLE_EQ(scan.sensor_model().range_stddev(), 0.02);
  EXPECT_EQ(scan.header().frame(), "lidar_link");
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
