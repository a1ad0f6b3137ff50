// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/carmen.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sensor_bridge/compressed.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::sensor_bridge {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using quoin::tests::write_compressed;
using ::testing::ElementsAre;

constexpr double pi = std::numbers::pi;

struct Result {
  std::vector<RecordedScan> scans;
  std::string error = "no error";
};

Result read(const std::filesystem::path& file) {
  Result result;
  LineReader lines(file);
  RecordedScan scan;
  result.error = error_of<ScanFileError>([&] {
    CarmenScans read_scan{ScanGeometry{}};
    while (read_scan(lines, scan)) result.scans.push_back(scan);
  });
  return result;
}

std::string flaser(int count) {
  std::string line = "FLASER " + std::to_string(count);
  for (int i = 0; i < count; ++i) line.append(" ").append(std::to_string(1 + i % 7));
  return line + " 1 2 0.5 3 4 0.25 12.5 host 13\n";
}

const std::string good = "FLASER 4 1.5 2 +2.5 81.91 1 2 0.5 3 4 0.25 12.5 host 13\n";

TEST(Carmen, ReadsRangesPosesAndStamp) {
  const TemporaryFolder folder;
  const Result result = read(folder.write("a.log", good));
  EXPECT_EQ(result.error, "no error");
  ASSERT_EQ(result.scans.size(), 1U);
  const RecordedScan& scan = result.scans[0];
  EXPECT_THAT(scan.ranges, ElementsAre(1.5F, 2.0F, 2.5F, 81.91F));
  EXPECT_EQ(scan.stamp, 12.5);
  ASSERT_TRUE(scan.pose);
  ASSERT_EQ(scan.odometry.size(), 1U);
  EXPECT_FALSE(scan.odometry[0].stamp) << "that of the scan";
  EXPECT_EQ(scan.pose->x, 1.0);
  EXPECT_EQ(scan.pose->y, 2.0);
  EXPECT_EQ(scan.pose->theta, 0.5);
  EXPECT_EQ(scan.odometry[0].pose.x, 3.0);
  EXPECT_EQ(scan.odometry[0].pose.y, 4.0);
  EXPECT_EQ(scan.odometry[0].pose.theta, 0.25);
}

TEST(Carmen, SpreadsBearingsOverTheFieldOfView) {
  const TemporaryFolder folder;
  const double degree = pi / 180.0;
  struct Sweep {
    int count;
    double step;
    double last;
  };
  for (const Sweep& sweep :
       {Sweep{180, degree, 89.0 * degree}, Sweep{360, 0.5 * degree, 89.5 * degree},
        Sweep{181, degree, 0.5 * pi}, Sweep{361, 0.5 * degree, 0.5 * pi}}) {
    const Result result = read(folder.write("a.log", flaser(sweep.count)));
    ASSERT_EQ(result.scans.size(), 1U);
    const std::vector<float>& bearings = result.scans[0].bearings;
    ASSERT_EQ(bearings.size(), static_cast<std::size_t>(sweep.count));
    EXPECT_FLOAT_EQ(bearings.front(), static_cast<float>(-0.5 * pi));
    EXPECT_NEAR(bearings[1] - bearings[0], sweep.step, 1e-6);
    EXPECT_FLOAT_EQ(bearings.back(), static_cast<float>(sweep.last));
  }
  EXPECT_FLOAT_EQ(read(folder.write("a.log", flaser(1))).scans.at(0).bearings.at(0),
                  static_cast<float>(-0.5 * pi));
}

TEST(Carmen, SkipsOtherMessagesAndComments) {
  const TemporaryFolder folder;
  const std::string rear = std::string("R").append(good, 1);
  const Result result = read(folder.write(
      "a.log", "# FLASER 1\n\nPARAM robot_length 0.47 1 host 1\nODOM 0 0 0 0 0 0 1 host 1\n" +
                   rear + good + "  \nNEFF 10\nFLASER_OTHER 7\n" + good));
  EXPECT_EQ(result.error, "no error");
  EXPECT_EQ(result.scans.size(), 2U);
}

TEST(Carmen, ReadsCompressedLogsWindowsLineEndsAndAMissingLastLineEnd) {
  const TemporaryFolder folder;
  const std::string bare = good.substr(0, good.size() - 1);
  for (const auto& file :
       {write_compressed(folder, "a.log.gz", good + good), folder.write("a.log", good + bare),
        folder.write("b.log", bare + "\r\n" + bare + "\r\n")}) {
    const Result result = read(file);
    EXPECT_EQ(result.error, "no error") << file;
    ASSERT_EQ(result.scans.size(), 2U) << file;
    EXPECT_EQ(result.scans[1].ranges.size(), 4U) << file;
  }
}

TEST(Carmen, AcceptsNumbersThatAreNotFinite) {
  const TemporaryFolder folder;
  const Result result =
      read(folder.write("a.log", "FLASER 2 nan inf nan 2 0.5 3 4 0.25 inf host 13\n"));
  EXPECT_EQ(result.error, "no error");
  ASSERT_EQ(result.scans.size(), 1U);
  EXPECT_TRUE(std::isnan(result.scans[0].ranges[0]));
  EXPECT_TRUE(std::isinf(result.scans[0].ranges[1]));
  EXPECT_FALSE(result.scans[0].pose);
  EXPECT_EQ(result.scans[0].odometry.size(), 1U);
  EXPECT_FALSE(result.scans[0].stamp);
}

TEST(Carmen, OdometryLinesComeBetweenTheScans) {
  const TemporaryFolder folder;
  const auto odom = [](const char* stamp) {
    return std::string("ODOM 1 2 0.5 0.75 0.125 0 ") + stamp + " host 11\n";
  };
  const auto scan = [](const char* stamp) {
    return std::string("FLASER 1 1 1 2 0.5 3 4 0.25 ") + stamp + " host 13\n";
  };
  const std::string file = folder.write(
      "a.log", odom("11.5") + scan("12") + odom("0") + odom("12.5") + "ODOM x\n" + odom("12.25") +
                   odom("13") + scan("13") + "RAWLASER1 0 0 1 1 9 0 0 1 2 0 14 host 14\n");
  const Result result = read(file);
  EXPECT_EQ(result.error, "no error");
  ASSERT_EQ(result.scans.size(), 3U);
  const auto& first = result.scans[0].odometry;
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].stamp, 11.5);
  EXPECT_EQ(first[0].pose.y, 2.0);
  EXPECT_EQ(first[0].velocity, Eigen::Vector3d(0.75, 0.0, 0.125));
  EXPECT_EQ(first[1].pose.y, 4.0) << "that of the scan";
  const auto& second = result.scans[1].odometry;
  ASSERT_EQ(second.size(), 2U) << "stamps that jump back, or are that of the scan, are left out";
  EXPECT_EQ(second[0].stamp, 12.5);
  EXPECT_THAT(result.scans[1].notes, ::testing::Contains(::testing::HasSubstr(file + ":5:6: ")));
  EXPECT_TRUE(result.scans[2].odometry.empty());
}

struct BadLine {
  const char* name;
  const char* line;
  const char* error;
};

class CarmenError : public ::testing::TestWithParam<BadLine> {};

TEST_P(CarmenError, ComesAfterTheGoodScansWithPlaceAndReason) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bad.log", "# comment\n" + good + GetParam().line);
  const Result result = read(file);
  EXPECT_EQ(result.scans.size(), 1U);
  EXPECT_EQ(result.error, file + GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    All, CarmenError,
    ::testing::Values(
        BadLine{"cut_in_the_ranges",
                "FLASER 180 1.5 2.5\n"
                "ODOM 1\n",
                ":3:19: FLASER announces 180 ranges, but the line ends early; the file is cut off "
                "or damaged here"},
        BadLine{"cut_in_the_poses", "FLASER 2 1.5 2.5 1 2",
                ":3:21: FLASER announces 2 ranges, but the line ends early; the file is cut off or "
                "damaged here"},
        BadLine{"cut_before_the_host", "FLASER 2 1.5 2.5 1 2 3 4 5 6 12.5\r\n",
                ":3:34: FLASER announces 2 ranges, but the line ends early; the file is cut off or "
                "damaged here"},
        BadLine{"cut_behind_the_host", "FLASER 2 1.5 2.5 1 2 3 4 5 6 12.5 host",
                ":3:39: FLASER announces 2 ranges, but the line ends early; the file is cut off or "
                "damaged here"},
        BadLine{"malformed_range", "FLASER 2 1.5 2.x5 1 2 3 4 5 6 12.5 host 13\n",
                ":3:14: '2.x5' is not a number"},
        BadLine{"malformed_pose", "FLASER 2 1.5 2.5 1 2 - 4 5 6 12.5 host 13\n",
                ":3:22: '-' is not a number"},
        BadLine{"two_signs", "FLASER 2 1.5 +-2.5 1 2 3 4 5 6 12.5 host 13\n",
                ":3:14: '+-2.5' is not a number"},
        BadLine{"no_count", "FLASER\n",
                ":3:7: FLASER without a number of ranges; the file is cut off here"},
        BadLine{"malformed_count", "FLASER 2.5 1 2\n", ":3:8: '2.5' is not a number of ranges"},
        BadLine{"negative_count", "FLASER -2 1 2\n", ":3:8: '-2' is not a number of ranges"},
        BadLine{"too_many_ranges", "FLASER 100001 1 2\n",
                ":3:8: FLASER announces 100001 ranges; at most 100000 are possible"},
        BadLine{"absurd_count", "FLASER 99999999999999999999999 1 2\n",
                ":3:8: '99999999999999999999999' is not a number of ranges"},
        BadLine{"surplus", "FLASER 2 1.5 2.5 1 2 3 4 5 6 12.5 host 13 14\n",
                ":3:43: '14' is one value too many for a FLASER line of 2 ranges; is their number "
                "right?"}),
    [](const auto& test) { return test.param.name; });

TEST(CarmenFile, GivesAllWholeScansOfACompressedLogThatIsCutOff) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 200; ++i) content += flaser(180 + i % 3);
  const auto file = write_compressed(folder, "cut.log.gz", content);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 20);
  const Result result = read(file);
  EXPECT_GE(result.scans.size(), 100U);
  EXPECT_LT(result.scans.size(), 200U);
  EXPECT_THAT(result.error, ::testing::StartsWith(file.string() + ":" +
                                                  std::to_string(result.scans.size() + 1) + ":"));
  EXPECT_THAT(result.error,
              ::testing::HasSubstr(
                  "the compressed file ends in the middle; it was cut off, copy it again"));
}

}  // namespace
}  // namespace quoin::sensor_bridge
