// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/breezyslam.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using testing::HasSubstr;

/// A line with these encoder counts, 682 ranges of `millimetres` and one column more, as the logs
/// have it.
std::string line(const std::string& stamp, const std::string& left, const std::string& right,
                 const std::string& millimetres) {
  std::string text = stamp + " 7 " + left + " " + right;
  for (int i = 0; i < 20; ++i) text += " 0";
  for (int i = 0; i < 682; ++i) text += " " + millimetres;
  return text + " 0 \n";
}

TEST(BreezySlam, HasRangesAndOdometry) {
  const TemporaryFolder folder;
  // Each wheel turns once, then the right one half a turn more.
  LineReader lines(folder.write("a.dat", line("2500000", "100", "50", "1234") + "\n" +
                                             line("2600000", "2100", "2050", "0") +
                                             line("2700000", "2100", "3050", "0")));
  BreezySlamScans read;
  RecordedScan scan;
  ASSERT_TRUE(read(lines, scan));
  EXPECT_EQ(scan.stamp, 2.5);
  ASSERT_EQ(scan.ranges.size(), 682U);
  EXPECT_FLOAT_EQ(scan.ranges[0], 1.234F);
  EXPECT_NEAR(scan.bearings[340], 0.0, 1e-7) << "step 384";
  EXPECT_NEAR(scan.bearings[341], 2.0 * std::numbers::pi / 1024.0, 1e-7);
  EXPECT_NEAR(scan.time_offsets.back(), 681 * 0.1 / 1024.0, 1e-7);
  ASSERT_EQ(scan.odometry.size(), 1U);
  EXPECT_EQ(scan.odometry[0].pose.x, 0.0);
  ASSERT_TRUE(read(lines, scan));
  const double turn = 2.0 * std::numbers::pi * 0.077;
  EXPECT_NEAR(scan.odometry[0].pose.x, turn, 1e-12);
  EXPECT_NEAR(scan.odometry[0].pose.theta, 0.0, 1e-12);
  ASSERT_TRUE(read(lines, scan));
  EXPECT_NEAR(scan.odometry[0].pose.theta, 0.5 * turn / 0.33, 1e-12);
  EXPECT_FALSE(read(lines, scan));
}

TEST(BreezySlam, SaysWhereALineIsWrong) {
  const TemporaryFolder folder;
  RecordedScan scan;
  const auto error = [&](const std::string& content) {
    LineReader lines(folder.write("a.dat", content));
    return error_of<ScanFileError>([&] { (void)BreezySlamScans()(lines, scan); });
  };
  EXPECT_THAT(error("1 2 3\n"), HasSubstr("a.dat:1:6: the line ends after 3 numbers"));
  EXPECT_THAT(error("1 two 3\n"), HasSubstr("a.dat:1:3: 'two' is not a number"));
  EXPECT_THAT(error("1 nan\n"), HasSubstr("a.dat:1:3: 'nan' is not a number"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
