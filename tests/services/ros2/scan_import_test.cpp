// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/scan_import.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::ros2 {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;
using testing::IsNan;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t now = 1'700'000'000 * second;

/// Five rays from -1 rad on, half a radian apart, at `now`.
LaserScan five_rays() {
  LaserScan scan;
  set_header(scan.header(), now, "laser");
  scan.angle_min(-1.0F);
  scan.angle_max(1.0F);
  scan.angle_increment(0.5F);
  scan.range_min(0.1F);
  scan.range_max(10.0F);
  scan.ranges({1.0F, 2.0F, 3.0F, 4.0F, 5.0F});
  return scan;
}

class ScanImportTest : public testing::Test {
 protected:
  bool convert(const LaserScan& in) { return scans.convert(in, now + second / 10, out); }
  /// The scan is used, and that fault and no other is found in it.
  void expect_used(const LaserScan& in, ScanFault fault) {
    const std::uint64_t before = scans.faults();
    EXPECT_TRUE(convert(in));
    EXPECT_EQ(scans.tally(fault).count, 1U) << text_of(fault);
    EXPECT_EQ(scans.faults(), before + 1);
  }
  void expect_left_out(const LaserScan& in, ScanFault fault) {
    EXPECT_FALSE(convert(in));
    EXPECT_EQ(scans.tally(fault).count, 1U) << text_of(fault);
    EXPECT_EQ(scans.left_out(), 1U);
    // The stream goes on.
    EXPECT_TRUE(convert(five_rays()));
    EXPECT_EQ(scans.left_out(), 1U);
    EXPECT_EQ(scans.taken(), 2U);
  }

  ScanImport scans{{}};
  msg::Scan out;
};

TEST_F(ScanImportTest, TakesRaysFrameAndStampOfAGoodScanWithoutAFault) {
  ASSERT_TRUE(convert(five_rays()));
  EXPECT_THAT(out.bearings(), ElementsAre(-1.0F, -0.5F, 0.0F, 0.5F, 1.0F));
  EXPECT_THAT(out.ranges(), ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, 5.0F));
  EXPECT_EQ(out.header().frame(), "laser");
  EXPECT_EQ(out.header().stamp(), now);
  EXPECT_FLOAT_EQ(out.range_min(), 0.1F);
  EXPECT_FLOAT_EQ(out.range_max(), 10.0F);
  EXPECT_THAT(out.time_offsets(), testing::IsEmpty());
  EXPECT_EQ(scans.faults(), 0U);
}

TEST_F(ScanImportTest, ClockwiseScansKeepTheirOrder) {
  LaserScan in = five_rays();
  in.angle_min(1.0F);
  in.angle_max(-1.0F);
  in.angle_increment(-0.5F);
  ASSERT_TRUE(convert(in));
  EXPECT_THAT(out.bearings(), ElementsAre(1.0F, 0.5F, 0.0F, -0.5F, -1.0F));
  EXPECT_EQ(scans.faults(), 0U);
}

TEST_F(ScanImportTest, RangesBecomeWhatRep117Says) {
  LaserScan in = five_rays();
  in.ranges({inf, -inf, nan, 0.0F, 11.0F, 10.0F, 0.1F, 0.05F, -3.0F});
  in.angle_max(3.0F);
  ASSERT_TRUE(convert(in));
  EXPECT_THAT(out.ranges(),
              ElementsAre(inf, -inf, IsNan(), IsNan(), inf, 10.0F, 0.1F, -inf, IsNan()));
}

TEST_F(ScanImportTest, TheDeploymentNarrowsTheLimits) {
  ScanImport narrow({.range_min = 1.5, .range_max = 4.5});
  ASSERT_TRUE(narrow.convert(five_rays(), now, out));
  EXPECT_THAT(out.ranges(), ElementsAre(-inf, 2.0F, 3.0F, 4.0F, inf));
  EXPECT_FLOAT_EQ(out.range_min(), 1.5F);
  EXPECT_FLOAT_EQ(out.range_max(), 4.5F);
}

TEST_F(ScanImportTest, TimeIncrementGivesEachRayItsTime) {
  LaserScan in = five_rays();
  in.time_increment(0.01F);
  ASSERT_TRUE(convert(in));
  EXPECT_THAT(out.time_offsets(), ElementsAre(FloatEq(0.0F), FloatEq(0.01F), FloatEq(0.02F),
                                              FloatNear(0.03F, 1e-6F), FloatEq(0.04F)));
  EXPECT_FLOAT_EQ(out.duration(), 0.04F);
  EXPECT_EQ(out.header().stamp(), now);
}

TEST_F(ScanImportTest, AStampOfTheLastRayIsTakenBackToTheFirst) {
  ScanImport last({.stamped = StampedRay::last});
  LaserScan in = five_rays();
  in.time_increment(0.025F);
  ASSERT_TRUE(last.convert(in, now, out));
  EXPECT_NEAR(static_cast<double>(now - out.header().stamp()), 0.1e9, 10.0);
  // Without times of rays by the time that the driver gives for the whole scan.
  in.time_increment(0.0F);
  in.scan_time(0.05F);
  ASSERT_TRUE(last.convert(in, now, out));
  EXPECT_NEAR(static_cast<double>(now - out.header().stamp()), 0.05e9, 10.0);
}

TEST_F(ScanImportTest, AnIncrementOfZeroIsTakenFromAngleMax) {
  for (const float increment : {0.0F, nan, inf}) {
    ScanImport fresh{{}};
    LaserScan in = five_rays();
    in.angle_increment(increment);
    ASSERT_TRUE(fresh.convert(in, now, out));
    EXPECT_THAT(out.bearings(), ElementsAre(-1.0F, -0.5F, 0.0F, 0.5F, 1.0F));
    EXPECT_EQ(fresh.tally(ScanFault::increment_from_angle_max).count, 1U);
    EXPECT_EQ(fresh.faults(), 1U);
  }
}

TEST_F(ScanImportTest, AnIncrementOfTheWrongSignCountsAsOtherProgramsReadIt) {
  LaserScan in = five_rays();
  in.angle_increment(-0.5F);
  expect_used(in, ScanFault::increment_against_angle_max);
  EXPECT_THAT(out.bearings(), ElementsAre(-1.0F, -1.5F, -2.0F, -2.5F, -3.0F));
}

TEST_F(ScanImportTest, AngleMaxMayBeOneStepBeyondTheLastRayAndNoMore) {
  LaserScan in = five_rays();
  in.angle_max(1.5F);
  ASSERT_TRUE(convert(in));
  EXPECT_EQ(scans.faults(), 0U);
  in.ranges().resize(3);
  ASSERT_TRUE(convert(in));
  EXPECT_EQ(scans.tally(ScanFault::angle_max_elsewhere).count, 1U);
  EXPECT_THAT(out.bearings(), ElementsAre(-1.0F, -0.5F, 0.0F));
}

TEST_F(ScanImportTest, WhatHasNoDirectionIsLeftOut) {
  LaserScan in = five_rays();
  in.angle_increment(0.0F);
  in.angle_max(nan);
  expect_left_out(in, ScanFault::no_increment);
}

TEST_F(ScanImportTest, WhatHasNoFirstAngleIsLeftOut) {
  LaserScan in = five_rays();
  in.angle_min(nan);
  expect_left_out(in, ScanFault::no_angle_min);
}

TEST_F(ScanImportTest, WhatIsTooLargeIsLeftOut) {
  LaserScan in = five_rays();
  in.ranges().assign(ScanImport::most_rays + 1, 1.0F);
  expect_left_out(in, ScanFault::too_many_rays);
}

TEST_F(ScanImportTest, AChangedNumberOfRaysIsNamedOnceAChange) {
  ASSERT_TRUE(convert(five_rays()));
  LaserScan in = five_rays();
  in.ranges().push_back(6.0F);
  in.angle_max(1.5F);
  set_header(in.header(), now + second, "laser");
  expect_used(in, ScanFault::ray_count_changed);
  EXPECT_EQ(out.bearings().size(), 6U);
  EXPECT_EQ(scans.tally(ScanFault::ray_count_changed).last, 1U);
  set_header(in.header(), now + 2 * second, "laser");
  ASSERT_TRUE(convert(in));
  EXPECT_EQ(scans.faults(), 1U);
}

TEST_F(ScanImportTest, AnEmptyScanIsAScan) {
  LaserScan in = five_rays();
  in.ranges().clear();
  expect_used(in, ScanFault::no_rays);
  EXPECT_THAT(out.ranges(), testing::IsEmpty());
}

TEST_F(ScanImportTest, IntensitiesOfAnotherLengthAreNamed) {
  LaserScan in = five_rays();
  in.intensities({1.0F, 2.0F});
  expect_used(in, ScanFault::intensities_of_other_length);
}

TEST_F(ScanImportTest, LimitsThatLeaveNothingAreThoseOfTheDeployment) {
  LaserScan in = five_rays();
  in.range_min(0.0F);
  in.range_max(0.0F);
  expect_used(in, ScanFault::no_range_limits);
  EXPECT_THAT(out.ranges(), ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, 5.0F));
}

TEST_F(ScanImportTest, ATimeIncrementThatCannotBeIsNotUsed) {
  for (const float step : {-0.001F, nan, inf, 5.0F}) {
    ScanImport fresh{{}};
    LaserScan in = five_rays();
    in.time_increment(step);
    ASSERT_TRUE(fresh.convert(in, now, out));
    EXPECT_EQ(fresh.tally(ScanFault::no_time_increment).count, 1U) << step;
    EXPECT_THAT(out.time_offsets(), testing::IsEmpty());
    EXPECT_EQ(out.duration(), 0.0F);
  }
}

TEST_F(ScanImportTest, AStampOfZeroBecomesTheTimeOfTheFirstRayBeforeTheArrival) {
  LaserScan in = five_rays();
  set_header(in.header(), 0, "laser");
  in.time_increment(0.01F);
  expect_used(in, ScanFault::stamp_zero);
  EXPECT_NEAR(static_cast<double>(out.header().stamp() - now), 0.06e9, 10.0);
}

TEST_F(ScanImportTest, SimulatedTimeIsKept) {
  LaserScan in = five_rays();
  set_header(in.header(), 12 * second, "laser");
  expect_used(in, ScanFault::stamp_of_another_clock);
  EXPECT_EQ(out.header().stamp(), 12 * second);
}

TEST_F(ScanImportTest, AStampThatGoesBackIsNamed) {
  ASSERT_TRUE(convert(five_rays()));
  LaserScan in = five_rays();
  set_header(in.header(), now - second, "laser");
  expect_used(in, ScanFault::stamp_not_later);
}

TEST_F(ScanImportTest, FramesAreTakenAsTheyComeAndTheirChangesNamed) {
  ASSERT_TRUE(convert(five_rays()));
  LaserScan in = five_rays();
  set_header(in.header(), now + second, "/base_scan");
  expect_used(in, ScanFault::frame_changed);
  EXPECT_EQ(out.header().frame(), "base_scan");
}

TEST_F(ScanImportTest, AScanWithoutFrameIsNamed) {
  LaserScan in = five_rays();
  in.header().frame_id("");
  expect_used(in, ScanFault::no_frame);
}

TEST_F(ScanImportTest, AFrameOfTheDeploymentLeavesOutOtherSensors) {
  ScanImport of_laser({.frame = "laser"});
  LaserScan in = five_rays();
  in.header().frame_id("rear");
  EXPECT_FALSE(of_laser.convert(in, now, out));
  EXPECT_EQ(of_laser.tally(ScanFault::other_frame).count, 1U);
  in.header().frame_id("");
  EXPECT_TRUE(of_laser.convert(in, now, out));
  EXPECT_EQ(out.header().frame(), "laser");
  EXPECT_TRUE(of_laser.convert(five_rays(), now, out));
}

TEST(ScanFault, EachHasATextOfItsOwn) {
  std::set<std::string_view> texts;
  for (std::size_t i = 0; i < scan_fault_count; ++i) {
    const auto fault = static_cast<ScanFault>(i);
    EXPECT_TRUE(texts.insert(text_of(fault)).second) << i;
    EXPECT_EQ(fatal(fault), text_of(fault).ends_with("left out")) << text_of(fault);
  }
  EXPECT_EQ(text_of(static_cast<ScanFault>(scan_fault_count)), "");
}

}  // namespace
}  // namespace quoin::ros2
