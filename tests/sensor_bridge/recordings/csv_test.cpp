// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/csv.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using ::testing::ElementsAre;

std::string csv_error(const TemporaryFolder& folder, const std::string& content) {
  const auto scans = open_csv_scans(folder.write("scan.csv", content), "");
  RecordedScan scan;
  const std::string error = error_of<ScanFileError>([&] { (void)scans->next(scan); });
  const std::string file = (folder.path() / "scan.csv").string();
  return error.starts_with(file) ? error.substr(file.size()) : error;
}

TEST(Csv, ReadsOneRevolution) {
  const TemporaryFolder folder;
  for (const char* content :
       {"# a comment\nangle_rad,range_m\n0,1.5\n\n# another\n0.5,2\n6.283185,+3e0\n",
        "0,1.5\r\n0.5,2\r\n6.283185,3\r\n", " 0 ,\t1.5\n0.5, 2\n6.283185,3"}) {
    const auto scans = open_csv_scans(folder.write("scan.csv", content), "");
    RecordedScan scan;
    ASSERT_TRUE(scans->next(scan)) << content;
    EXPECT_THAT(scan.bearings, ElementsAre(0.0F, 0.5F, 6.283185F));
    EXPECT_THAT(scan.ranges, ElementsAre(1.5F, 2.0F, 3.0F));
    EXPECT_FALSE(scan.stamp);
    EXPECT_FALSE(scans->next(scan));
  }
}

TEST(Csv, AcceptsRangesThatAreNotFinite) {
  const TemporaryFolder folder;
  const auto scans =
      open_csv_scans(folder.write("scan.csv", "0,nan\n0.1,inf\n0.2,-inf\n0.3,NaN\n"), "");
  RecordedScan scan;
  ASSERT_TRUE(scans->next(scan));
  EXPECT_TRUE(std::isnan(scan.ranges[0]));
  EXPECT_EQ(scan.ranges[1], INFINITY);
  EXPECT_EQ(scan.ranges[2], -INFINITY);
  EXPECT_TRUE(std::isnan(scan.ranges[3]));
}

TEST(Csv, HoldsNoScanWithoutRays) {
  const TemporaryFolder folder;
  for (const char* content : {"", "\n\n", "# only a comment\n"}) {
    const auto scans = open_csv_scans(folder.write("scan.csv", content), "");
    RecordedScan scan;
    EXPECT_FALSE(scans->next(scan)) << content;
  }
}

TEST(Csv, NamesPlaceAndReasonOfWhatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_EQ(csv_error(folder, "0,1\n0.1,1.x\n"), ":2:5: '1.x' is not a number");
  EXPECT_EQ(csv_error(folder, "0.1x,2\n"), ":1:1: '0.1x' is not a number");
  EXPECT_EQ(csv_error(folder, "0,1\nbearing,range\n"), ":2:1: 'bearing' is not a number");
  EXPECT_EQ(csv_error(folder, "0,1\n0.1,,\n"), ":2:5: '' is not a number");
  EXPECT_EQ(csv_error(folder, "0,1\n0.1 2\n"), ":2:1: a line of 1 columns; the others have 2");
  EXPECT_EQ(csv_error(folder, "bearing_rad,range\n45,1\n"),
            ":2:1: a bearing beyond two turns; 'columns' says what the columns hold and in which "
            "units, such as angle_deg,distance_mm");
}

TEST(Csv, RefusesMoreRaysThanASensorHas) {
  const TemporaryFolder folder;
  std::string content = "bearing,range\n";
  for (std::size_t i = 0; i < RecordedScan::max_points; ++i) content += "0,1\n";
  EXPECT_EQ(csv_error(folder, content), "no error");
  EXPECT_EQ(csv_error(folder, content + "0,1\n"),
            ":100002:1: more than 100000 rays that never come round; are the columns right?");
}

}  // namespace
}  // namespace quoin::sensor_bridge
